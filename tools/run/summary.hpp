// summary.json: the outcome of a run for programs to read; tools/README.md lists the keys.
//
// The keys are always the same, but for those of walls of their own, of rolling resistance, of particles of several
// sizes and of lines; null stands for what does not apply. SI units throughout; numbers read back exactly.
#pragma once

#include <optional>
#include <string>

#include "collision_tracker.hpp"
#include "line_result.hpp"
#include "options.hpp"
#include "plug_analysis.hpp"
#include "snapshot.hpp"

namespace fixdem::program {

struct Outcome {
  std::string status;  ///< "done", "interrupted", or the name of a fault
  Snapshot snapshot;
  Observation observation{};
  Energy start_energy{}, energy{};
  double maximum_step_ratio = 0;  ///< time step / stable step, of all rows of the log
  double steps_per_contact = 0;   ///< of the impact with the deepest overlap of the run; infinite without contacts
  int frames = -1;                ///< written; -1 with --no-frames
  std::vector<CapacityUse> capacities;
  double particle_steps = 0;
  double wall_time = 0;    ///< of the time loop with its outputs, s
  double kernel_time = 0;  ///< inside the kernel, s
  std::optional<PlugResult> plug;
  std::optional<LineResult> line;
  std::optional<Collision> collision;
};

/// The entry `plug` alone, as a JSON object.
std::string encode_plug(const PlugResult&);

std::string encode_summary(const CaseFacts&, const Options&, const Outcome&);

/// A few lines for a person, printed after the table.
std::string describe_outcome(const CaseFacts&, const Outcome&);

}  // namespace fixdem::program
