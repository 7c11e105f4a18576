#include "time_loop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "dump.hpp"
#include "energy_balance.hpp"
#include "failure.hpp"
#include "fault_report.hpp"
#include "interrupt.hpp"
#include "state_file.hpp"
#include "summary.hpp"

namespace fixdem::program {
namespace {

constexpr double block_time = 0.1;  // s of wall time: how long a signal may wait

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// 41213 -> "41 213"
std::string grouped(long long number) {
  std::string digits = std::to_string(number);
  for (int place = static_cast<int>(digits.size()) - 3; place > 0; place -= 3)
    digits.insert(static_cast<std::size_t>(place), " ");
  return digits;
}

}  // namespace

TimeLoop::TimeLoop(SimulationView& view, const CaseFacts& facts, const Options& options)
    : view_(view),
      facts_(facts),
      options_(options),
      total_steps_(std::llround(options.duration / facts.time_step)),
      start_energy_(view.energy()),
      log_file_(options.out / "log.csv", facts),
      watch_(facts),
      plugs_(facts.pipe_length),
      progress_(facts, total_steps_, options.quiet),
      log_schedule_(facts.log_interval, facts.time_step),
      frame_schedule_(options.frames ? facts.frame_interval : 0, facts.time_step),
      sample_schedule_(facts.has_gas ? facts.sample_interval : 0, facts.time_step) {
  if (options.frames) frames_.emplace(options.out, facts.radius());
  if (options.frames && facts.dump) dump_.emplace(options.out / "dump.lammpstrj");
  if (facts.particle_count <= 2) collision_.emplace(facts);
}

int TimeLoop::run() {
  if (!options_.quiet) std::fputs(table_header(facts_).c_str(), stdout);
  if (collision_) collision_->observe(view_);
  Status status{};
  int signal = 0;
  long long step = 0;
  output(step, total_steps_ == 0);
  while (step < total_steps_ && !step_is_too_large_) {
    const long long due =
        std::min({log_schedule_.next(), frame_schedule_.next(), sample_schedule_.next(), total_steps_});
    status = advance(std::min(due - step, static_cast<long long>(block_steps_)));
    step = view_.step();
    signal = interrupt_signal();
    progress_.update(step, kernel_time_);
    const bool is_last = !status.ok() || signal != 0 || step >= total_steps_;
    output(step, is_last);
    if (!status.ok() || signal != 0) break;
  }
  return finish(status, signal);
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
  const double wanted = static_cast<double>(steps) * block_time / std::max(seconds, 1e-9);
  block_steps_ = std::clamp(wanted, 1.0, 2 * block_steps_);
  return status;
}

void TimeLoop::output(long long step, bool is_last) {
  const bool log_due = is_last || log_schedule_.is_due(step);
  const bool frame_due =
      frames_ && (frame_schedule_.is_due(step) || (is_last && (facts_.frame_interval > 0 || step < total_steps_)));
  const bool sample_due = facts_.has_gas && (is_last || sample_schedule_.is_due(step));
  if (!log_due && !frame_due && !sample_due) return;

  const Snapshot snapshot = take_snapshot(view_, facts_.particle_count);
  if (sample_due) plugs_.add(plug_sample(snapshot));
  if (log_due) log(snapshot);
  if (frame_due || (frames_ && step_is_too_large_)) {
    frames_->write(snapshot);
    if (dump_) dump_->append(encode_dump(snapshot, facts_));
  }
  log_schedule_.advance(step);
  frame_schedule_.advance(step);
  sample_schedule_.advance(step);
}

void TimeLoop::log(const Snapshot& snapshot) {
  LogRow row;
  row.time = snapshot.time;
  row.step = snapshot.step;
  row.observation = view_.observe();
  row.energy = view_.energy();
  row.balance_error = balance_error(start_energy_, row.energy);
  if (facts_.has_gas) row.plug = plug_sample(snapshot);
  if (std::isfinite(row.observation.max_speed)) greatest_speed_ = std::max(greatest_speed_, row.observation.max_speed);
  step_is_too_large_ = watch_.look(row.time, snapshot.contacts, row.observation.max_overlap);
  row.step_ratio = watch_.ratio();
  log_file_.write(row);
  if (const std::string warning = watch_.take_warning(); !warning.empty()) {
    progress_.clear();
    std::fputs(warning.c_str(), stderr);
  }
  if (options_.quiet) return;
  progress_.clear();
  std::fputs(table_row(facts_, row).c_str(), stdout);
  std::fflush(stdout);
}

PlugSample TimeLoop::plug_sample(const Snapshot& snapshot) const {
  std::vector<double> gradients(static_cast<std::size_t>(facts_.slice_count));
  for (int slice = 0; slice < facts_.slice_count; ++slice)
    gradients[static_cast<std::size_t>(slice)] = view_.pressure_gradient(slice);
  PlugSample sample = find_plug(slice_profile(facts_, snapshot, gradients), snapshot.time);
  sample.pressure_drop = view_.pressure_drop();
  return sample;
}

int TimeLoop::finish(const Status& status, int signal) {
  progress_.clear();
  Outcome outcome;
  const bool is_sound = status.ok() && !step_is_too_large_;
  outcome.status = !status.ok()         ? fault_name(status.fault)
                   : step_is_too_large_ ? "time_step_too_large"
                   : signal != 0        ? "interrupted"
                                        : "done";
  outcome.snapshot = take_snapshot(view_, facts_.particle_count);
  outcome.observation = view_.observe();
  outcome.start_energy = start_energy_;
  outcome.energy = view_.energy();
  outcome.greatest_step_ratio = watch_.greatest_ratio();
  outcome.capacities = view_.capacities();
  outcome.wall_time = seconds_since(begin_);
  outcome.kernel_time = kernel_time_;
  if (facts_.has_gas) {
    const double g = std::hypot(facts_.gravity[0], facts_.gravity[1], facts_.gravity[2]);
    outcome.plug = plugs_.result(options_.duration, g, facts_.pipe_diameter);
  }
  if (collision_) outcome.collision = collision_->result();

  if (is_sound)
    write_state(options_.out / "final.fixdem", stored_state(facts_, outcome.snapshot, signal == 0, options_.duration));
  write_file(options_.out / "summary.json", encode_summary(facts_, options_, outcome), Durability::durable);
  if (!options_.quiet) {
    std::string text = describe_outcome(facts_, outcome);
    text += fmt::format("results in {}: summary.json, log.csv", options_.out.string());
    if (is_sound) text += ", final.fixdem";
    if (frames_ && frames_->count() > 0) text += fmt::format(", frames.pvd ({} frames)", frames_->count());
    std::fputs((text + "\n").c_str(), stdout);
  }

  if (!status.ok())
    throw Failure(
        fault_exit_code(status.fault),
        fmt::format("stopped at step {} ({:.6g} s): {}\n  {}\n  log, summary and the frame of that moment are in {}",
                    grouped(status.step), static_cast<double>(status.step) * facts_.time_step,
                    fault_sentence(facts_, status), fault_advice(facts_, status, greatest_speed_),
                    options_.out.string()));
  if (step_is_too_large_)
    throw Failure(exit_unstable,
                  fmt::format("stopped at step {}: {}\n  log, summary and the frame of that moment are in {}",
                              grouped(view_.step()), watch_.stop_message(), options_.out.string()));
  if (signal != 0) {
    std::fputs(fmt::format("fixdem: interrupted by signal {} at {:.6g} s; final.fixdem holds that moment\n", signal,
                           outcome.snapshot.time)
                   .c_str(),
               stderr);
    return exit_signal_base + signal;
  }
  return exit_done;
}

}  // namespace fixdem::program
