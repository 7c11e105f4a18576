// The scenes that are timed: shipped cases, scaled along the pipe to any number of particles.
//
// `bed<N>`: the settled bed of pipe_bed, its final state repeated along the pipe (N a multiple of 1000) with all
// contact histories, so that every contact rests as it did. `agitated`: the random start of pipe_bed, where particles
// fly and few touch. `plug`: plug_u24 from its final state on, where the plug moves. Without energy ledger, as a scene
// that only wants speed would be compiled; `bed_with_ledger` shows what the ledger costs.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <vector>

#include "cases/pipe_bed.hpp"
#include "cases/plug_u24.hpp"
#include "kernel/fixdem.hpp"
#include "tools/run/arrangement.hpp"
#include "tools/run/state_file.hpp"

namespace fixdem::bench {

template <int N>
struct bed : cases::pipe_bed {
  static constexpr int particle_count = N;
  static constexpr double pipe_length = cases::pipe_bed::pipe_length * N / cases::pipe_bed::particle_count;
  static constexpr bool energy_ledger = false;
};
struct bed_with_ledger : bed<1000> {
  static constexpr bool energy_ledger = true;
};
struct agitated : bed<1000> {};
struct plug : cases::plug_u24 {
  static constexpr bool energy_ledger = false;
};

inline void require(const Status& status) {
  if (!status.ok()) throw std::runtime_error(describe(status.fault));
}

/// Puts the stored bed, repeated along the pipe, into the simulation, and starts it.
template <class Simulation>
void start_bed(Simulation& simulation, const program::StoredState& stored) {
  constexpr double length = cases::pipe_bed::pipe_length;
  const int unit = static_cast<int>(stored.particles.size());
  const int repeats = Simulation::count / unit;
  for (int id = 0; id < Simulation::count; ++id) {
    Particle p = stored.particles[static_cast<std::size_t>(id % unit)];
    p.position[2] += id / unit * length;
    simulation.place(id, p);
  }
  require(simulation.start());
  for (const program::StoredHistory& h : stored.histories) {
    // A pair across the ends of the stored pipe joins one repeat with the next.
    int next = 0;
    if (h.partner >= 0) {
      const double dz = stored.particles[static_cast<std::size_t>(h.partner)].position[2] -
                        stored.particles[static_cast<std::size_t>(h.owner)].position[2];
      next = dz > length / 2 ? -1 : (dz < -length / 2 ? 1 : 0);
    }
    for (int k = 0; k < repeats; ++k) {
      const int partner = h.partner < 0 ? h.partner : (k + next + repeats) % repeats * unit + h.partner;
      simulation.restore_history(k * unit + h.owner, partner, h.history);
    }
  }
}

/// The random start of pipe_bed, seed 1.
template <class Simulation>
void start_agitated(Simulation& simulation) {
  using Case = typename Simulation::case_type;
  static const std::vector<Particle> particles = program::arrange_moving(
      {Case::pipe_diameter, Case::pipe_length, true}, Case::particle_count, Case::diameter, Case::start_velocity, 1);
  for (int id = 0; id < Simulation::count; ++id) simulation.place(id, particles[static_cast<std::size_t>(id)]);
  require(simulation.start());
}

/// A plug in motion: the final state of plug_u24 with its velocities, spins and contact histories.
template <class Simulation>
void start_plug(Simulation& simulation, const program::StoredState& stored) {
  for (int id = 0; id < Simulation::count; ++id) simulation.place(id, stored.particles[static_cast<std::size_t>(id)]);
  require(simulation.start());
  for (const program::StoredHistory& h : stored.histories) simulation.restore_history(h.owner, h.partner, h.history);
}

}  // namespace fixdem::bench
