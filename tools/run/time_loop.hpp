// The time loop: blocks of steps between outputs, the outputs themselves, and checkpoints.
//
// A block ends at the next due output, and after about a tenth of a second of wall time, so that signals are answered
// and progress is shown; results do not depend on where blocks end. Scenes of one or two particles are followed step
// by step for their collision. At every row of the log the time step is compared with what the contacts of that moment
// allow (stability_watch.hpp).
//
// A checkpoint is written every checkpoint_interval of simulated time or, when that is 0, every minute by the clock:
// what a crash may cost is a person's time, and so is what a checkpoint costs. When it is written has no influence on
// results. A run that stops early stops at a good step: after a fault at the last one before it (rewind.hpp). There it
// writes a checkpoint and only then the outputs of that moment, which a resumed run takes away again; after a fault,
// also the neighbourhood of the particle it names and the whole state for use as a start, but no final state. A run
// that has come to its end does the same, so that it can be extended: what it writes only because it ends is not in the
// files of a longer one. Before it says that it is done, it looks whether its files are what it has written.
#pragma once

#include <chrono>
#include <optional>

#include "checkpoint_keeper.hpp"
#include "collision_tracker.hpp"
#include "fault_report.hpp"
#include "found_run.hpp"
#include "line_record.hpp"
#include "options.hpp"
#include "outputs.hpp"
#include "plug_analysis.hpp"
#include "progress.hpp"
#include "rewind.hpp"
#include "schedule.hpp"
#include "stability_watch.hpp"
#include "watch.hpp"

namespace fixdem::program {

class TimeLoop {
 public:
  /// The simulation has been started, or is that of the checkpoint that is resumed; the folder exists.
  TimeLoop(SimulationView&, const CaseFacts&, const Options&, const Resumable* resumed = nullptr);

  /// Runs to the end and returns the exit code; throws Failure if a file cannot be written.
  int run();

 private:
  int go_on();
  Status advance(long long steps);
  Snapshot snapshot() const {
    return take_snapshot(view_, facts_.particle_count, facts_.has_gas ? facts_.slice_count : 0);
  }
  void output(long long step, bool is_last = false);
  void log(const Snapshot&);
  void show();
  void warn(const std::string&);
  void warn_of_contacts();
  PlugSample plug_sample(const Snapshot&) const;
  bool checkpoint_is_due(long long step) const;
  void write_checkpoint();
  template <class Archive>
  void transfer(Archive&);
  /// What is written when the run stops early, at the present step: see above.
  void write_stopped_state(const Status&);
  void write_end(const Status&, int signal);
  [[noreturn]] void report_stop(const Status&, const std::string& trouble) const;
  std::string how_to_go_on() const;
  LineRecord::Append line_files() {
    return [this](const std::string& file, std::string_view record) { outputs_.append(file, record); };
  }
  static double seconds_since(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }

  SimulationView& view_;
  const CaseFacts& facts_;
  const Options& options_;
  long long total_steps_;
  bool is_resumed_;
  Energy start_energy_;
  double maximum_speed_ = 0;  ///< at outputs, m/s
  bool has_warned_of_contacts_ = false;

  Outputs outputs_;
  std::optional<CollisionTracker> collision_;
  std::optional<LineRecord> line_;  ///< of a line
  StabilityWatch watch_;
  bool step_is_too_large_ = false;
  bool state_is_good_ = true;  ///< after a fault: it could be gone back to the last good step
  NamedParticle faulty_{-1, -1};
  PlugRecord plugs_;
  std::optional<Watch> picture_;  ///< with --watch
  Progress progress_;
  Schedule log_schedule_, frame_schedule_, contact_schedule_, sample_schedule_, checkpoint_schedule_;
  long long logged_step_ = -1, framed_step_ = -1, sampled_step_ = -1;  ///< of the last one written
  CheckpointKeeper checkpoints_;
  Rewind rewind_;

  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now(), checkpoint_time_ = begin_;
  double wall_time_before_ = 0, kernel_time_ = 0;  ///< s; of the runs before this one, and of all
  double particle_steps_ = 0;
  double block_steps_ = 16;  ///< of the next block
};

}  // namespace fixdem::program
