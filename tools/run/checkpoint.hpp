// checkpoint-STEP.fixdem: everything that a run needs to go on as if it had never stopped.
//
// Layout: "FIXDEMCP", byte-order mark and version (binary_file.hpp), then in this order
//   identity   pairs of texts: what must be the same in the program that reads it (case, the values of its keys,
//              precision, kernel, capacities, size of the simulation, ...), so that a refusal can say what differs
//   options    duration in s, that of the case, seed, whether frames are written, XXH64 of the state that it started
//   from (0: of none) moment     step, time in s outputs    size and XXH64 of log, dump and each frame at that moment
//   simulation the bytes of the object Simulation<Case>: it has no pointers and one layout for every lane width
//   program    what the program itself keeps: schedules, start energy, plug samples, collision, warnings given
// and the checksum. What is damaged or differs is refused with exit code 3. A file whose checksum has been made to fit
// its changes is looked through as well: no index of the simulation may lead outside its array
// (kernel/consistency.hpp).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "case_facts.hpp"
#include "outputs.hpp"
#include "simulation_view.hpp"

namespace fixdem::program {

/// Name and value of each thing that must be the same.
using Identity = std::vector<std::pair<std::string, std::string>>;

struct Checkpoint {
  Identity identity;
  double duration = 0, case_duration = 0;
  std::uint64_t seed = 0;
  bool frames = true;
  std::uint64_t start = 0;
  std::int64_t step = 0;
  double time = 0;
  OutputPosition outputs;
  std::string simulation, program;
};

/// Of this program: the values of its keys, and with several sizes a hash of what each particle is. Keys of the case
/// that a run may change on the way are left out: title, duration, reference_speed, checkpoint_interval,
/// statistics_from.
Identity identity(const CaseFacts&, SimulationView&);
/// What of that summary.json says, too: the case by its file's hash.
Identity brief_identity(const CaseFacts&);
/// What differs, one line each: "precision: mixed there, double here"; empty when nothing does.
std::string differences(const Identity& there, const Identity& here);

std::string encode_checkpoint(Checkpoint&);
/// `name` is what messages call the file.
Checkpoint decode_checkpoint(std::string_view bytes, const std::string& name);

/// Reads a checkpoint that this program can continue: every promise is checked that the program relies on.
Checkpoint read_checkpoint(const std::filesystem::path&, const Identity& here);

}  // namespace fixdem::program
