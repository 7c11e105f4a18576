// The time loop: blocks of steps between outputs, and the outputs themselves.
//
// A block ends at the next due output, and after about a tenth of a second of wall time, so that signals are answered
// and progress is shown; results do not depend on where blocks end. Scenes of one or two particles are followed step
// by step for their collision. At every row of the log the time step is compared with what the contacts of that moment
// allow (stability_watch.hpp). After a fault, or where the step is far too large, the log, a last frame and the summary
// are still written, the final state is not; after a signal everything is.
#pragma once

#include <chrono>
#include <optional>

#include "collision_tracker.hpp"
#include "frames_vtp.hpp"
#include "log.hpp"
#include "options.hpp"
#include "output_file.hpp"
#include "plug_analysis.hpp"
#include "progress.hpp"
#include "schedule.hpp"
#include "stability_watch.hpp"

namespace fixdem::program {

class TimeLoop {
 public:
  /// The simulation has been started; the folder exists.
  TimeLoop(SimulationView&, const CaseFacts&, const Options&);

  /// Runs to the end and returns the exit code; throws Failure if a file cannot be written.
  int run();

 private:
  Status advance(long long steps);
  void output(long long step, bool is_last);
  void log(const Snapshot&);
  PlugSample plug_sample(const Snapshot&) const;
  int finish(const Status&, int signal);

  SimulationView& view_;
  const CaseFacts& facts_;
  const Options& options_;
  long long total_steps_;
  Energy start_energy_;
  double greatest_speed_ = 0;  ///< at outputs, m/s

  LogFile log_file_;
  std::optional<FrameWriter> frames_;
  std::optional<AppendedFile> dump_;
  std::optional<CollisionTracker> collision_;
  StabilityWatch watch_;
  bool step_is_too_large_ = false;
  PlugRecord plugs_;
  Progress progress_;
  Schedule log_schedule_, frame_schedule_, sample_schedule_;

  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  double kernel_time_ = 0;   ///< s
  double block_steps_ = 16;  ///< of the next block
};

}  // namespace fixdem::program
