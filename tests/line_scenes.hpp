// Scenes with an open line: short and soft, so that within some 15 ms particles are fed, collide, are blown along and
// leave.
#pragma once

#include <type_traits>

#include "listed_sizes.hpp"
#include "scenes.hpp"

namespace fixdem::tests {

/// With gas; feeding as much as the section takes.
struct short_line : short_pipe {
  static constexpr const char* name = "a short line";
  static constexpr int particle_count = 300, start_count = 120;
  static constexpr double diameter = 0.01, density = 1000;
  static constexpr double youngs_modulus = 3e7, wall_youngs_modulus = 3e7;
  static constexpr double pipe_length = 0.3;
  static constexpr Ends ends = Ends::open;
  static constexpr bool has_gas = true;
  static constexpr double gas_velocity = 2.4, gas_density = 1.2, gas_viscosity = 1.5e-5, gas_bed_diameter = 0.01;
  static constexpr int gas_update_interval = 7, gas_floater_interval = 25;
  static constexpr int slice_count = 30;
  static constexpr double time_step = 5e-6;
  static constexpr int neighbour_capacity = 14;
  static constexpr TimeValue feed_rate[] = {{0, 2}};
  static constexpr double feed_start = 0, feed_length = 0.1, feed_velocity = 0.5;
  static constexpr unsigned long long feed_seed = 1;
  static constexpr int feed_interval = 20;
};

/// Two species of 10 and 6 mm: of 60 and 90 at the start, then fed as 1 to 3.
struct kinds_of_line {
  static constexpr const char* name = "a line of two species";
  static constexpr int species_count = 2;
  static constexpr const char* species_names[] = {"large", "small"};
  static constexpr SizeRun sizes[] = {
      {60, 0.010, 1000, 0}, {90, 0.006, 1500, 1}, {250, 0.010, 1000, 0}, {750, 0.006, 1500, 1}};
};
struct sizes_of_line : sized<kinds_of_line, short_pipe> {};

template <class Base>
struct in_two_species : Base {
  static constexpr const char* name = kinds_of_line::name;
  static constexpr int species_count = kinds_of_line::species_count;
  static constexpr const char* const (&species_names)[2] = kinds_of_line::species_names;
  static constexpr const SizeRun (&sizes)[4] = kinds_of_line::sizes;
  static constexpr double largest_diameter = 0.010, smallest_diameter = 0.006, reference_density = 1000;
  static constexpr double mean_volume = sizes_of_line::mean_volume;
  static constexpr int start_count = 150, first_fed_kind = 150, particle_count = 600;
  static constexpr int neighbour_capacity = 33;
  static constexpr double gas_bed_diameter = 0;
};

template <class Base>
struct empty_at_start : Base {
  static constexpr int start_count = 0;
};

/// The particles at the start alone, in a closed pipe: for what places them.
template <class Case>
struct at_start : Case {
  static constexpr int particle_count = Case::start_count;
  static constexpr Ends ends = Ends::closed;
};

/// The case of what is placed.
template <class Case>
using Placing = std::conditional_t<is_line<Case>, at_start<Case>, Case>;

/// At random, agitated by `speed` and on their way to the outlet with `drift`, m/s.
template <class Case>
Spheres spheres_of_line(double speed, double drift, Random random) {
  Spheres spheres = random_spheres<at_start<Case>>(speed, random);
  for (Sphere& s : spheres) s.velocity[2] += drift;
  return spheres;
}

/// Layers as close as they fit, the last of them at the outlet: they leave with their contacts.
template <class Case>
Spheres plug_at_outlet(Random random) {
  constexpr double pitch = 0.0102;
  Spheres spheres = layered_spheres<at_start<Case>>(pitch, 0.3, random);
  const double end = (Case::start_count + 18) / 19 * pitch;
  for (Sphere& s : spheres) s.position[2] += Case::pipe_length - end, s.velocity[2] += 1.5;
  return spheres;
}

}  // namespace fixdem::tests
