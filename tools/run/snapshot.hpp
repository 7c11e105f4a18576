// The state of a simulation at one moment, copied out in the order of the particles' numbers; of a line, that of those
// present, counted on from 0.
//
// Every output (frames, dump, final state, hash, plug measurement) is made from it, so they cannot disagree. Contacts
// are put into one order that does not depend on how the kernel sorts its particles: in a pair the lower number owns
// (its normal and history are those of the owner), and the list is sorted by owner and partner.
#pragma once

#include <string>
#include <vector>

#include "simulation_view.hpp"

namespace fixdem::program {

struct Snapshot {
  double time = 0;  ///< s
  long long step = 0;
  std::vector<Particle> particles;
  std::vector<int> images;  ///< periodic crossings: unwrapped z = z + image * pipe length
  std::vector<Contact> contacts;
  std::vector<double> pressure_gradients;  ///< of the gas in each slice along the pipe, Pa/m; empty without gas
  bool is_of_line = false;
  std::vector<long long> serials;  ///< of a line
  std::vector<int> kinds;          ///< of a line: numbers in the table of kinds (particle_kinds.hpp)

  int kind(int id) const { return is_of_line ? kinds[static_cast<std::size_t>(id)] : id; }
  long long serial(int id) const { return is_of_line ? serials[static_cast<std::size_t>(id)] : id; }
  /// Number here of the particle with a serial number; -1 where it is not present.
  int find(long long serial) const;
};

/// gas_slices: how many slices of gas the case has, 0 without gas.
Snapshot take_snapshot(const SimulationView&, int particle_count, int gas_slices = 0);

/// Number of contacts (pairs and walls) of each particle.
std::vector<int> contacts_per_particle(const Snapshot&);

/// XXH64, as 16 hexadecimal digits, over positions, velocities and angular velocities in order of number, then owner,
/// partner and history of every contact, and last the histories of rolling if any is not zero: equal states have equal
/// hashes, on every machine of the same byte order.
std::string state_hash(const Snapshot&);

}  // namespace fixdem::program
