// A hash of a simulation's state that needs no library: to compare, on any machine, bits of the same run.
//
// FNV-1a of 64 bits over position, velocity and angular velocity of every particle by number, in a line of those
// present with their serial numbers, then the energies. Bytes are taken as they lie in memory; all machines in question
// are little-endian.
#pragma once

#include "kernel/fixdem.hpp"

namespace fixdem {

class StateHash {
 public:
  template <class T>
  void add(const T& value) {
    unsigned char bytes[sizeof value];
    __builtin_memcpy(bytes, &value, sizeof value);
    for (const unsigned char byte : bytes) value_ = (value_ ^ byte) * 0x100000001b3u;
  }
  unsigned long long value() const { return value_; }

 private:
  unsigned long long value_ = 0xcbf29ce484222325u;
};

template <class Simulation>
unsigned long long state_hash(const Simulation& simulation) {
  StateHash hash;
  constexpr bool is_line = fixdem::is_line<typename Simulation::case_type>;
  for (int id = 0; id < Simulation::count; ++id) {
    if (!simulation.is_present(id)) continue;
    hash.add(simulation.particle(id));
    if constexpr (is_line) hash.add(simulation.serial(id));
  }
  const Energy e = simulation.energy();
  hash.add(e.kinetic), hash.add(e.elastic), hash.add(e.dissipated_damping), hash.add(e.dissipated_sliding);
  hash.add(e.gravity_work), hash.add(e.gas_work), hash.add(e.elastic_tangential), hash.add(e.made_by_law);
  if constexpr (Derived<typename Simulation::case_type>::has_rolling) hash.add(e.dissipated_rolling);
  if constexpr (is_line) hash.add(e.entered), hash.add(e.left_with), hash.add(simulation.line().asked);
  return hash.value();
}

}  // namespace fixdem
