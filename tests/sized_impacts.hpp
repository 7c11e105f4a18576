// The separate oblique impacts of impact_scene.hpp with particles of several sizes and densities.
#pragma once

#include "impact_scene.hpp"
#include "listed_sizes.hpp"

namespace fixdem::tests {

/// For oblique_impacts: 20 spheres that meet the wall and 20 pairs, of 10, 7, 5 and 2.5 mm and as many densities.
struct impact_sizes {
  static constexpr const char* name = "oblique impacts of several sizes";
  static constexpr int species_count = 0;
  static constexpr int count = wall_impacts + 2 * pair_impacts;
  struct List {
    SizeRun run[count];
  };
  static constexpr List list = [] {
    List made{};
    constexpr double diameters[] = {0.010, 0.005, 0.0025, 0.007, 0.0025, 0.010, 0.005};
    constexpr double densities[] = {1000, 8000, 2500, 500, 1000};
    for (int k = 0; k < count; ++k) made.run[k] = {1, diameters[k % 7], densities[k % 5], 0};
    return made;
  }();
  static constexpr const SizeRun (&sizes)[count] = list.run;
};
struct flat_walls : short_pipe {
  static constexpr bool has_wall = false;
  static constexpr Ends ends = Ends::closed;
  static constexpr double pipe_length = 0.4, time_step = 1e-7;
  static constexpr double gravity[3] = {0, 0, 0};
  static constexpr int slice_count = 40, neighbour_capacity = 130;
};
struct sized_impacts : sized<impact_sizes, flat_walls> {};

/// Follows all impacts to their end.
template <class Case>
Spheres after_impacts(const Spheres& spheres, Energy* energy = nullptr) {
  enter({Case::name, seed()});
  static Simulation<Case> simulation;
  place_all(simulation, spheres);
  start(simulation);
  run(simulation, static_cast<long long>(5e-4 / Case::time_step));
  CHECK(simulation.observe().contacts + simulation.observe().wall_contacts == 0);
  if (energy != nullptr) *energy = simulation.energy();
  return all_particles(simulation, Case::particle_count);
}

}  // namespace fixdem::tests
