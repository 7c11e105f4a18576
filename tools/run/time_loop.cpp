#include "time_loop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <span>

#include "binary_file.hpp"
#include "energy_balance.hpp"
#include "failure.hpp"
#include "fault_report.hpp"
#include "interrupt.hpp"
#include "species_velocity.hpp"

namespace fixdem::program {
namespace {

constexpr double block_time = 0.1;         // s of wall time: how long a signal may wait
constexpr double checkpoint_seconds = 60;  // between checkpoints by the clock

}  // namespace

TimeLoop::TimeLoop(SimulationView& view, const CaseFacts& facts, const Options& options, const Resumable* resumed)
    : view_(view),
      facts_(facts),
      options_(options),
      total_steps_(steps_of(options.duration, facts.time_step)),
      is_resumed_(resumed != nullptr),
      start_energy_(view.energy()),
      outputs_(facts, options, resumed != nullptr ? &resumed->checkpoint.outputs : nullptr),
      watch_(facts),
      plugs_(facts.pipe_length),
      picture_(options.watch && !options.quiet ? Watch::on_terminal(facts, options.duration) : std::nullopt),
      progress_(facts, view.step(), total_steps_, options.quiet || picture_),
      log_schedule_(facts.log_interval, facts.time_step),
      frame_schedule_(options.frames ? facts.frame_interval : 0, facts.time_step),
      contact_schedule_(options.frames ? facts.contact_interval : 0, facts.time_step),
      sample_schedule_(facts.has_gas && !facts.line.is_open ? facts.sample_interval : 0, facts.time_step),
      checkpoint_schedule_(options.checkpoint_interval, facts.time_step),
      checkpoints_(options.out, resumed != nullptr ? resumed->path : ""),
      rewind_(view) {
  if (facts.line.is_open)
    line_.emplace(facts);
  else if (facts.particle_count <= 2)
    collision_.emplace(facts);
  checkpoint_schedule_.advance(view.step());
  if (resumed == nullptr) return;
  const std::string name = resumed->path.string(), advice = "begin anew with --fresh";
  BinaryReader reader(resumed->checkpoint.program, name, advice);
  transfer(reader);
  if (!reader.empty()) reader.refuse("is damaged: it is longer than its contents");
  if (watch_.particle() < -1 || (!line_ && watch_.particle() >= facts.particle_count))
    reader.refuse("is damaged: it names particle {} of {}", watch_.particle(), facts.particle_count);
  if (collision_ && !collision_->is_consistent()) reader.refuse("is damaged: its collision is of other particles");
  for (Schedule* schedule : {&log_schedule_, &frame_schedule_, &contact_schedule_, &sample_schedule_})
    schedule->advance(view.step());
  if (line_) line_->advance(view.step());
}

int TimeLoop::run() {
  try {
    return go_on();
  } catch (const Failure& failure) {
    if (failure.code() != exit_input_output || !std::filesystem::exists(checkpoints_.last())) throw;
    throw Failure(exit_input_output, failure.what() + ("\n  " + how_to_go_on()));
  }
}

int TimeLoop::go_on() {
  if (!options_.quiet && !picture_) std::fputs(table_header(facts_).c_str(), stdout);
  Status status{};
  int signal = 0;
  long long step = view_.step();
  warn_of_contacts();
  if (!is_resumed_) {
    if (collision_) collision_->observe(view_);
    output(step);
  }
  while (step < total_steps_ && status.ok() && signal == 0 && !step_is_too_large_) {
    long long due = std::min({log_schedule_.next(), frame_schedule_.next(), contact_schedule_.next(),
                              sample_schedule_.next(), checkpoint_schedule_.next(), total_steps_});
    if (line_) due = std::min(due, line_->next());
    rewind_.keep(kernel_time_);
    status = advance(std::min(due - step, static_cast<long long>(block_steps_)));
    if (!status.ok()) {
      if (status.particle >= 0) faulty_ = {view_.serial(status.particle), view_.kind(status.particle)};
      state_is_good_ = rewind_.go_back(status);
    }
    step = view_.step();
    progress_.update(step, particle_steps_, kernel_time_);
    output(step);
    if (picture_ && (picture_->is_due() || step >= total_steps_)) show();
    if (step < total_steps_) signal = interrupt_signal();
    if (status.ok() && checkpoint_is_due(step)) write_checkpoint();
  }

  const bool is_sound = status.ok() && !step_is_too_large_;
  std::string trouble;
  try {
    write_end(status, signal);
  } catch (const Failure& failure) {
    if (is_sound) throw;
    trouble = failure.what();  // the fault itself matters more
  }
  if (!is_sound) report_stop(status, trouble);
  if (signal == 0) return exit_done;
  std::fputs(fmt::format("fixdem: interrupted by signal {} at {:.6g} s; final.fixdem holds that moment\n  {}\n", signal,
                         view_.time(), how_to_go_on())
                 .c_str(),
             stderr);
  return exit_signal_base + signal;
}

Status TimeLoop::advance(long long steps) {
  const auto begin = std::chrono::steady_clock::now();
  Status status{};
  if (collision_) {
    for (long long k = 0; k < steps && status.ok(); ++k) {
      status = view_.run(1);
      collision_->observe(view_);
    }
  } else {
    status = view_.run(steps);
  }
  const double seconds = seconds_since(begin);
  kernel_time_ += seconds;
  particle_steps_ +=
      static_cast<double>(steps) * static_cast<double>(line_ ? view_.line().present : facts_.particle_count);
  const double wanted = static_cast<double>(steps) * block_time / std::max(seconds, 1e-9);
  block_steps_ = std::clamp(wanted, 1.0, 2 * block_steps_);
  return status;
}

void TimeLoop::output(long long step, bool is_last) {
  // A run that stops early comes here a second time with the same step.
  const bool log_due = log_schedule_.is_due(step) || (is_last && step != logged_step_);
  const bool frame_wanted = facts_.frame_interval > 0 || step < total_steps_;
  const bool frame_due =
      outputs_.writes_frames() && (frame_schedule_.is_due(step) || (is_last && frame_wanted && step != framed_step_));
  const bool contacts_due = contact_schedule_.is_due(step);
  const bool sample_due =
      facts_.has_gas && !line_ && (sample_schedule_.is_due(step) || (is_last && step != sampled_step_));
  const bool line_due = line_ && line_->is_due(step);
  if (!log_due && !frame_due && !contacts_due && !sample_due && !line_due) return;

  const Snapshot snapshot = this->snapshot();
  if (sample_due) plugs_.add(plug_sample(snapshot)), sampled_step_ = step;
  if (log_due) log(snapshot), logged_step_ = step;
  if (frame_due) outputs_.frame(snapshot), framed_step_ = step;
  if (contacts_due) outputs_.contacts(snapshot);
  if (line_due) line_->look(view_, snapshot, line_files());
  log_schedule_.advance(step);
  frame_schedule_.advance(step);
  contact_schedule_.advance(step);
  sample_schedule_.advance(step);
}

void TimeLoop::log(const Snapshot& snapshot) {
  LogRow row;
  row.time = snapshot.time;
  row.step = snapshot.step;
  row.observation = view_.observe();
  row.energy = view_.energy();
  row.balance_error = balance_error(start_energy_, row.energy);
  if (facts_.has_gas) row.plug = plug_sample(snapshot), row.species_velocity = axial_velocities(facts_, snapshot);
  if (line_) row.line = line_->row(view_, snapshot);
  if (std::isfinite(row.observation.max_speed)) maximum_speed_ = std::max(maximum_speed_, row.observation.max_speed);
  step_is_too_large_ = watch_.look(row.time, snapshot.contacts, row.observation.max_overlap, &snapshot);
  row.step_ratio = watch_.ratio();
  outputs_.log(row);
  warn(watch_.take_warning());
  warn_of_contacts();
  if (options_.quiet || picture_) return;
  progress_.clear();
  std::fputs(table_row(facts_, row).c_str(), stdout);
  std::fflush(stdout);
}

void TimeLoop::warn(const std::string& warning) {
  if (warning.empty()) return;
  progress_.clear();
  if (picture_) picture_->begin_below();
  std::fputs(warning.c_str(), stderr);
}

/// Once: before the first step by the speed that the case expects, later by the deepest overlap so far.
void TimeLoop::warn_of_contacts() {
  if (has_warned_of_contacts_) return;
  const std::string warning = contact_warning(facts_, view_.deepest_overlap());
  has_warned_of_contacts_ = !warning.empty();
  warn(warning);
}

void TimeLoop::show() {
  const Snapshot snapshot = this->snapshot();
  LogRow row;
  row.time = snapshot.time;
  row.step = snapshot.step;
  row.observation = view_.observe();
  if (facts_.has_gas) row.plug = plug_sample(snapshot);
  if (line_) row.line.totals = view_.line();
  picture_->show(snapshot, row);
}

PlugSample TimeLoop::plug_sample(const Snapshot& snapshot) const {
  PlugSample sample = find_plug(slice_profile(facts_, snapshot, snapshot.pressure_gradients), snapshot.time);
  sample.pressure_drop = view_.pressure_drop();
  return sample;
}

bool TimeLoop::checkpoint_is_due(long long step) const {
  if (step >= total_steps_) return false;  // that one belongs to the end
  if (options_.checkpoint_interval > 0) return checkpoint_schedule_.is_due(step);
  return seconds_since(checkpoint_time_) >= checkpoint_seconds;
}

void TimeLoop::write_checkpoint() {
  const std::span<char> memory = view_.memory();
  if (memory.empty()) return;
  outputs_.flush();
  Checkpoint checkpoint;
  checkpoint.identity = identity(facts_, view_);
  checkpoint.duration = options_.duration, checkpoint.case_duration = facts_.duration;
  checkpoint.seed = options_.seed, checkpoint.frames = options_.frames, checkpoint.start = options_.start_hash;
  checkpoint.step = view_.step(), checkpoint.time = view_.time();
  checkpoint.outputs = outputs_.position();
  checkpoint.simulation.assign(memory.data(), memory.size());
  BinaryWriter writer;
  const double before = wall_time_before_;
  wall_time_before_ += seconds_since(begin_);
  transfer(writer);
  wall_time_before_ = before;
  checkpoint.program = writer.text();
  checkpoints_.write(checkpoint);
  checkpoint_schedule_.advance(view_.step());
  checkpoint_time_ = std::chrono::steady_clock::now();
}

template <class Archive>
void TimeLoop::transfer(Archive& archive) {
  archive(start_energy_, maximum_speed_, watch_, step_is_too_large_, plugs_);
  if (collision_) archive(*collision_);
  if (line_) archive(*line_);
  archive(logged_step_, framed_step_, sampled_step_);
  archive(wall_time_before_, kernel_time_, particle_steps_);
}

}  // namespace fixdem::program
