// The scenes that are timed: shipped cases, scaled along the pipe to any number of particles.
//
// `bed`: the settled bed of pipe_bed, its final state repeated along the pipe (N a multiple of 1000) with all contact
// histories, so that every contact rests as it did. `drum`: settle carried on until it rests, the paper's 150 particles
// in a closed drum, because 150 particles of the bed would not fill a pipe of their own. `agitated`: the random start
// of pipe_bed, repeated in the same way, where particles fly and few touch. `plug`: plug_u24 from its final state on,
// where the plug moves. Without energy ledger, as a scene that only wants speed would be compiled; `bed_with_ledger`
// shows what the ledger costs, `bed_rolling` what rolling resistance does, `bed_two_sizes` what sizes do. Every scene
// is a template over the precision of the case.
#pragma once

#include <vector>

#include "cases/pipe_bed.hpp"
#include "cases/plug_u24.hpp"
#include "cases/settle.hpp"
#include "stored_start.hpp"
#include "tools/run/arrangement.hpp"

namespace fixdem::bench {

template <int N, Precision P>
struct bed : cases::pipe_bed {
  static_assert(N % cases::pipe_bed::particle_count == 0, "the bed is repeated whole");
  static constexpr int particle_count = N;
  static constexpr double pipe_length = cases::pipe_bed::pipe_length * N / cases::pipe_bed::particle_count;
  static constexpr bool energy_ledger = false;
  static constexpr Precision precision = P;
};
template <Precision P>
struct bed_with_ledger : bed<1000, P> {
  static constexpr bool energy_ledger = true;
};
template <Precision P>
struct bed_rolling : bed<1000, P> {
  static constexpr double rolling_friction = 0.1;
};
/// Half of the particles of another size; these do not fit together as the bed's do, and settle anew.
template <Precision P>
struct bed_two_sizes : bed<1000, P> {
  using one_size = bed<1000, P>;
  static constexpr double largest_diameter = one_size::diameter, smallest_diameter = 0.8 * one_size::diameter;
  static constexpr double reference_density = one_size::density;
  static constexpr double mean_volume = 0.5 * (1 + 0.8 * 0.8 * 0.8) * Derived<one_size>::volume;
  static constexpr int species_count = 2, neighbour_capacity = 20;
  static constexpr SizeRun sizes[] = {{500, largest_diameter, one_size::density, 0},
                                      {500, smallest_diameter, one_size::density, 1}};
};
template <int N, Precision P>
struct agitated : bed<N, P> {};
template <Precision P>
struct drum : cases::settle {
  static constexpr bool energy_ledger = false;
  static constexpr Precision precision = P;
};
template <Precision P>
struct plug : cases::plug_u24 {
  static constexpr bool energy_ledger = false;
  static constexpr Precision precision = P;
};

/// Final states that scenes start from.
struct States {
  program::StoredState bed, drum, plug;
};
inline States states;

/// Puts particles, repeated along the pipe as often as they fit, into the simulation, and starts it.
template <class Simulation>
void start_repeated(Simulation& simulation, const std::vector<Particle>& particles, double length) {
  const int unit = static_cast<int>(particles.size());
  for (int id = 0; id < Simulation::count; ++id) {
    Particle p = particles[static_cast<std::size_t>(id % unit)];
    p.position[2] += id / unit * length;
    simulation.place(id, p);
  }
  require(simulation.start());
}

template <class Simulation>
void start_bed(Simulation& simulation) {
  constexpr double length = cases::pipe_bed::pipe_length;
  const program::StoredState& stored = states.bed;
  start_repeated(simulation, stored.particles, length);
  const int unit = static_cast<int>(stored.particles.size());
  const int repeats = Simulation::count / unit;
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

/// The drum, after the 0.2 s of its case another 0.4 s: then it is at rest.
template <class Simulation>
void start_drum(Simulation& simulation) {
  start_stored(simulation, states.drum);
  require(simulation.run(200000));
}

/// The bed of two sizes after 0.4 s: every other particle of the bed is one of the small ones.
template <class Simulation>
void start_two_sizes(Simulation& simulation) {
  const auto& particles = states.bed.particles;
  const int half = Simulation::count / 2;
  for (int id = 0; id < Simulation::count; ++id)
    simulation.place(id, particles[static_cast<std::size_t>(id < half ? 2 * id : 2 * (id - half) + 1)]);
  require(simulation.start());
  require(simulation.run(200000));
}

/// The random start of pipe_bed, seed 1.
template <class Simulation>
void start_agitated(Simulation& simulation) {
  using Case = cases::pipe_bed;
  static const std::vector<Particle> particles = program::arrange_moving(
      {Case::pipe_diameter, Case::pipe_length, true}, Case::particle_count, Case::diameter, Case::start_velocity, 1);
  start_repeated(simulation, particles, Case::pipe_length);
}

}  // namespace fixdem::bench
