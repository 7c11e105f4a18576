// final.fixdem: the whole state of a run in one file, to look at later or to start another case from.
//
// Layout, little or big endian as the byte-order mark says, no padding:
//   8 bytes   "FIXDEM" 0x1a 0x0a
//   u32       byte order mark 0x01020304
//   u32       version: 1; 2 in a case with rolling resistance; 3 and 4 the same with particles of several sizes
//   u32, then that many bytes: name of the case
//   u64       XXH64 of the case file
//   u32       1 if the run reached its end, 0 if it was interrupted
//   u32       1 if contact histories are forces in N, 0 if displacements in m
//   u64       number of particles
//   f64 x 3   diameter (of the largest) in m, time in s, duration asked for in s
//   u64       steps
//   f64 x 3n  positions, then velocities, then angular velocities, in order of number
//   i32 x n   periodic crossings of each particle
//   f64 x 2n  in versions 3 and 4: diameters in m, then densities in kg/m3
//   u64       number of contacts, then for each: i32 owner, i32 partner (-1 pipe wall, -2 end z = 0, -3 end z = L),
//             f64 x 3 history of sliding, and in versions 2 and 4 f64 x 3 history of rolling
//   u64       XXH64 of all bytes before it
// A file that is damaged, of another version or byte order is refused with exit code 3, naming what differs; one that
// cannot be read or written at all with 6.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "case_facts.hpp"
#include "snapshot.hpp"

namespace fixdem::program {

struct StoredHistory {
  std::int32_t owner, partner;
  double history[3];
  double rolling[3] = {0, 0, 0};  ///< of the rolling displacement
};

struct StoredState {
  std::string case_name;
  std::uint64_t source_hash = 0;
  bool complete = false;
  bool histories_are_forces = false;
  bool has_rolling = false;
  double diameter = 0, time = 0, duration = 0;
  std::uint64_t step = 0;
  std::vector<Particle> particles;
  std::vector<std::int32_t> images;
  std::vector<double> diameters, densities;  ///< of each particle; empty where all are equal
  std::vector<StoredHistory> histories;
};

StoredState stored_state(const CaseFacts&, const Snapshot&, bool complete, double duration);

std::string encode_state(const StoredState&);
/// `name` is what messages call the file.
StoredState decode_state(std::string_view bytes, const std::string& name);

void write_state(const std::filesystem::path&, const StoredState&);
StoredState read_state(const std::filesystem::path&);

}  // namespace fixdem::program
