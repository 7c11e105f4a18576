// Pipes of any width: a unit filled to a third, repeated along the pipe to some ten thousand particles or more.
//
// `bed`: particles of 10 mm that have settled in the unit, strongly damped, before they are timed as they are in
// pipe_bed, repeated with their contact histories. `agitated`: a random start at +-0.5 m/s. `falling`: 3 m/s along the
// pipe, +-0.1 m/s about that. These two are of the paper's real particles, 3 mm at 4e-6 s. No stored state is needed.
#pragma once

#include <vector>

#include "cases/pipe_bed.hpp"
#include "stored_start.hpp"
#include "tools/run/arrangement.hpp"

namespace fixdem::bench {

/// Length of the unit in diameters, and its particles: a third of the volume.
constexpr int unit_length(int ratio) { return ratio <= 5 ? 80 : ratio <= 10 ? 20 : ratio <= 17 ? 12 : 8; }
constexpr int unit_count(int ratio) { return ratio * ratio * unit_length(ratio) / 2; }

/// `ratio`: diameter of the pipe by that of a particle.
template <int ratio, int repeats, Precision P>
struct filled : cases::pipe_bed {
  static constexpr int particle_count = unit_count(ratio) * repeats;
  static constexpr double pipe_diameter = ratio * diameter, pipe_length = repeats * unit_length(ratio) * diameter;
  static constexpr bool energy_ledger = false;
  static constexpr Precision precision = P;
};
template <int ratio, int repeats, Precision P>
struct filled_with_small : filled<ratio, repeats, P> {
  static constexpr double diameter = 0.003, time_step = 4e-6;
  static constexpr double pipe_diameter = ratio * diameter, pipe_length = repeats * unit_length(ratio) * diameter;
};
template <int ratio>
struct settling_unit : filled<ratio, 1, Precision::double_precision> {
  static constexpr double restitution = 0.2, time_step = 4e-6;
};

/// Repeats of a unit that make `particles` or so.
constexpr int repeats_for(int ratio, int particles) { return (particles + unit_count(ratio) / 2) / unit_count(ratio); }

struct StoredContact {
  int owner, partner;
  double history[3];
};
struct Unit {
  std::vector<Particle> particles;
  std::vector<StoredContact> contacts;
};

template <class Case>
Unit random_unit(double speed) {
  return {program::arrange_moving({Case::pipe_diameter, Case::pipe_length, true}, Case::particle_count, Case::diameter,
                                  speed, 1),
          {}};
}

/// A random start that has been at rest since 0.4 s or so; settled once in a run of the program.
template <int ratio>
const Unit& settled_unit() {
  using Case = settling_unit<ratio>;
  static const Unit settled = [] {
    Unit unit = random_unit<Case>(0.5);
    auto simulation = std::make_unique<Simulation<Case>>();
    for (int id = 0; id < Case::particle_count; ++id)
      simulation->place(id, unit.particles[static_cast<std::size_t>(id)]);
    require(simulation->start());
    require(simulation->run(static_cast<long long>((0.3 + 0.004 * ratio) / Case::time_step)));
    for (int id = 0; id < Case::particle_count; ++id)
      unit.particles[static_cast<std::size_t>(id)] = simulation->particle(id);
    simulation->for_each_contact([&](const Contact& c) {
      unit.contacts.push_back({c.owner, c.partner, {c.history[0], c.history[1], c.history[2]}});
    });
    return unit;
  }();
  return settled;
}

/// Puts the unit into the simulation as often as it fits, with its contacts, and starts it.
template <class Simulation>
void start_repeated(Simulation& simulation, const Unit& unit, double length) {
  const int count = static_cast<int>(unit.particles.size()), repeats = Simulation::count / count;
  for (int id = 0; id < Simulation::count; ++id) {
    Particle p = unit.particles[static_cast<std::size_t>(id % count)];
    p.position[2] += id / count * length;
    simulation.place(id, p);
  }
  require(simulation.start());
  for (const StoredContact& c : unit.contacts) {
    // A pair across the ends of the unit joins one repeat with the next.
    int next = 0;
    if (c.partner >= 0) {
      const double dz = unit.particles[static_cast<std::size_t>(c.partner)].position[2] -
                        unit.particles[static_cast<std::size_t>(c.owner)].position[2];
      next = dz > length / 2 ? -1 : (dz < -length / 2 ? 1 : 0);
    }
    for (int k = 0; k < repeats; ++k)
      simulation.restore_history(k * count + c.owner,
                                 c.partner < 0 ? c.partner : (k + next + repeats) % repeats * count + c.partner,
                                 c.history);
  }
}

template <int ratio, class Simulation>
void start_bed_of(Simulation& simulation) {
  start_repeated(simulation, settled_unit<ratio>(), settling_unit<ratio>::pipe_length);
}
template <int ratio, class Simulation>
void start_agitated_of(Simulation& simulation) {
  using Case = filled_with_small<ratio, 1, Precision::double_precision>;
  start_repeated(simulation, random_unit<Case>(0.5), Case::pipe_length);
}
template <int ratio, class Simulation>
void start_falling_of(Simulation& simulation) {
  using Case = filled_with_small<ratio, 1, Precision::double_precision>;
  Unit unit = random_unit<Case>(0.1);
  for (Particle& p : unit.particles) p.velocity[2] += 3;
  start_repeated(simulation, unit, Case::pipe_length);
}

}  // namespace fixdem::bench
