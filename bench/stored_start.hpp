// Starting a simulation from a stored state, with its velocities, spins and contact histories.
#pragma once

#include <stdexcept>
#include <string>

#include "kernel/fixdem.hpp"
#include "tools/run/state_file.hpp"

namespace fixdem::bench {

inline void require(const Status& status) {
  if (!status.ok()) throw std::runtime_error(describe(status.fault));
}

template <class Simulation>
void start_stored(Simulation& simulation, const program::StoredState& stored) {
  if (static_cast<int>(stored.particles.size()) != Simulation::count)
    throw std::runtime_error("a state of the wrong number of particles: " + stored.case_name);
  for (int id = 0; id < Simulation::count; ++id) simulation.place(id, stored.particles[static_cast<std::size_t>(id)]);
  require(simulation.start());
  for (const program::StoredHistory& h : stored.histories) simulation.restore_history(h.owner, h.partner, h.history);
}

/// The last part of a benchmark's name.
inline std::string precision_name(Precision precision) {
  return precision == Precision::double_precision ? "double" : "mixed";
}

}  // namespace fixdem::bench
