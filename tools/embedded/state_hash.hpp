// A hash of a simulation's state that needs no library: to compare, on any machine, bits of the same run.
//
// FNV-1a of 64 bits over position, velocity and angular velocity of every particle by input number, then the energies.
// Bytes are taken as they lie in memory; all machines in question are little-endian.
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
  for (int id = 0; id < Simulation::count; ++id) hash.add(simulation.particle(id));
  hash.add(simulation.energy());
  return hash.value();
}

}  // namespace fixdem
