// The end of the time loop: what is written then, and what is said of a run that could not go on.
#include <fmt/format.h>

#include <cmath>
#include <cstdio>

#include "failure.hpp"
#include "fault_report.hpp"
#include "frames_vtp.hpp"
#include "neighbourhood.hpp"
#include "output_file.hpp"
#include "state_file.hpp"
#include "summary.hpp"
#include "time_loop.hpp"

namespace fixdem::program {
namespace {

/// 41213 -> "41 213"
std::string grouped(long long number) {
  std::string digits = std::to_string(number);
  for (int place = static_cast<int>(digits.size()) - 3; place > 0; place -= 3)
    digits.insert(static_cast<std::size_t>(place), " ");
  return digits;
}

}  // namespace

void TimeLoop::write_stopped_state(const Status& status) {
  if (!state_is_good_) return;
  write_checkpoint();
  if (status.ok() && !step_is_too_large_) return;
  // Always appended: as text, VTK could not read values that are not finite.
  const Snapshot snapshot = this->snapshot();
  const int particle = snapshot.find(status.ok() ? watch_.particle() : faulty_.serial);
  write_file(options_.out / "fault.vtp",
             encode_vtp(snapshot, facts_, VtpData::appended, neighbourhood(facts_, snapshot, particle)),
             Durability::fast);
  write_state(options_.out / "stopped.fixdem", stored_state(facts_, snapshot, false, options_.duration));
}

void TimeLoop::write_end(const Status& status, int signal) {
  progress_.clear();
  const bool is_sound = status.ok() && !step_is_too_large_;
  const bool is_done = is_sound && signal == 0;
  if (!is_done || options_.keeps_checkpoint) write_stopped_state(status);
  if (is_done && options_.keeps_checkpoint) checkpoints_.remove_all_but(checkpoints_.last());
  output(view_.step(), true);
  if (line_) line_->end(line_files());
  const std::string damage = outputs_.damage();
  if (is_done && !damage.empty()) throw Failure(exit_input_output, damage);
  Outcome outcome;
  outcome.status = !status.ok()         ? fault_name(status.fault)
                   : step_is_too_large_ ? "time_step_too_large"
                   : signal != 0        ? "interrupted"
                                        : "done";
  outcome.snapshot = snapshot();
  outcome.observation = view_.observe();
  outcome.start_energy = start_energy_;
  outcome.energy = view_.energy();
  outcome.maximum_step_ratio = watch_.maximum_ratio();
  outcome.steps_per_contact = contact_time_of(facts_, view_.deepest_overlap()) / facts_.time_step;
  outcome.frames = outputs_.writes_frames() ? outputs_.frame_count() : -1;
  outcome.capacities = view_.capacities();
  outcome.particle_steps = particle_steps_;
  outcome.wall_time = wall_time_before_ + seconds_since(begin_);
  outcome.kernel_time = kernel_time_;
  if (line_) {
    outcome.line = line_->result(view_.line(), options_.duration);
  } else if (facts_.has_gas) {
    const double g = std::hypot(facts_.gravity[0], facts_.gravity[1], facts_.gravity[2]);
    outcome.plug = plugs_.result(options_.duration, g, facts_.pipe_diameter);
  }
  if (collision_) outcome.collision = collision_->result();

  if (is_sound)
    write_state(options_.out / "final.fixdem", stored_state(facts_, outcome.snapshot, signal == 0, options_.duration));
  write_file(options_.out / "summary.json", encode_summary(facts_, options_, outcome), Durability::durable);
  if (is_done && !options_.keeps_checkpoint) checkpoints_.remove_all_but("");
  if (!damage.empty()) throw Failure(exit_input_output, damage);
  if (options_.quiet) return;
  std::string text = describe_outcome(facts_, outcome);
  text += fmt::format("results in {}: summary.json, log.csv", options_.out.string());
  for (const auto& [name, header] : LineRecord::files(facts_)) text += ", " + name;
  if (is_sound) text += ", final.fixdem";
  if (outputs_.frame_count() > 0) text += fmt::format(", frames.pvd ({} frames)", outputs_.frame_count());
  std::fputs((text + "\n").c_str(), stdout);
}

void TimeLoop::report_stop(const Status& status, const std::string& trouble) const {
  std::string end = fmt::format("\n  log and summary are in {}", options_.out.string());
  if (state_is_good_)
    end += fmt::format(
        "; the last good step is {}: what was around the particle then is in fault.vtp,\n  the whole state is in "
        "stopped.fixdem, for [start] from or --start-state of a changed case",
        grouped(view_.step()));
  if (state_is_good_ && !checkpoints_.last().empty())
    end += fmt::format("\n  last good state: {} (--resume meets the same fault again)", checkpoints_.last().string());
  if (!trouble.empty()) end = "\n  and then the files could not be written: " + trouble;
  if (status.ok())
    throw Failure(exit_unstable,
                  fmt::format("stopped at step {}: {}{}", grouped(view_.step()), watch_.stop_message(), end));
  throw Failure(
      fault_exit_code(status.fault),
      fmt::format("stopped at step {} ({:.6g} s): {}\n  {}{}", grouped(status.step),
                  static_cast<double>(status.step) * facts_.time_step, fault_sentence(facts_, status, faulty_),
                  fault_advice(facts_, status, maximum_speed_), end));
}

std::string TimeLoop::how_to_go_on() const {
  return fmt::format("last good state: {}; to go on from it: --resume (with make: RESUME=1), else the same command",
                     checkpoints_.last().string());
}

}  // namespace fixdem::program
