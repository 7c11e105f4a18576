// checkpoint-STEP.fixdem: everything that a run needs to go on as if it had never stopped.
//
// Layout: "FIXDEMCP", byte-order mark and version (binary_file.hpp), then in this order
//   identity   pairs of texts: what must be the same in the program that reads it (case and its file's hash, precision,
//              kernel, capacities, size of the simulation, ...), so that a refusal can say what differs
//   options    duration in s, seed, whether frames are written
//   moment     step, time in s
//   outputs    size and XXH64 of log, dump and each frame at that moment
//   simulation the bytes of the object Simulation<Case>: it has no pointers and one layout for every lane width
//   program    what the program itself keeps: schedules, start energy, plug samples, collision, warnings given
// and the checksum. The checksum guards against accidents, not against malice: like a program, a checkpoint is to be
// had from someone trusted. What is damaged or differs is refused with exit code 3.
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
  double duration = 0;
  std::uint64_t seed = 0;
  bool frames = true;
  std::int64_t step = 0;
  double time = 0;
  OutputPosition outputs;
  std::string simulation, program;
};

/// Of this program.
Identity identity(const CaseFacts&, SimulationView&);
/// What differs, one line each: "precision: mixed there, double here"; empty when nothing does.
std::string differences(const Identity& there, const Identity& here);

std::string encode_checkpoint(Checkpoint&);
/// `name` is what messages call the file.
Checkpoint decode_checkpoint(std::string_view bytes, const std::string& name);

/// Reads a checkpoint that this program can continue.
Checkpoint read_checkpoint(const std::filesystem::path&, const Identity& here);

}  // namespace fixdem::program
