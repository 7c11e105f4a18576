// Scenes with particles of several sizes: two kinds in a bed, three of very different sizes, a distribution, gas.
#pragma once

#include "agreement.hpp"
#include "listed_sizes.hpp"

namespace fixdem::tests {

/// 10 and 5 mm; a fifth of the pipe is large spheres, a twelfth small ones.
struct two_sizes {
  static constexpr const char* name = "two sizes";
  static constexpr int species_count = 2;
  static constexpr const char* species_names[] = {"large", "small"};
  static constexpr SizeRun sizes[] = {{45, 0.010, 1000, 0}, {150, 0.005, 1500, 1}};
};
/// The same, but the list begins with small ones and comes back to them; two densities of the large.
struct mixed_order {
  static constexpr const char* name = "two sizes, mixed order";
  static constexpr int species_count = 3;
  static constexpr const char* species_names[] = {"small", "light", "heavy"};
  static constexpr SizeRun sizes[] = {
      {40, 0.005, 1000, 0}, {20, 0.010, 500, 1}, {1, 0.005, 1000, 0}, {25, 0.010, 3000, 2}, {100, 0.005, 1000, 0}};
};
/// two_sizes with the numbers of the kinds exchanged.
struct exchanged : two_sizes {
  static constexpr const char* name = "two sizes, exchanged";
  static constexpr const char* species_names[] = {"small", "large"};
  static constexpr SizeRun sizes[] = {{150, 0.005, 1500, 0}, {45, 0.010, 1000, 1}};
};
/// 10, 5 and 2 mm.
struct three_sizes {
  static constexpr const char* name = "three sizes";
  static constexpr int species_count = 3;
  static constexpr const char* species_names[] = {"large", "middle", "small"};
  static constexpr SizeRun sizes[] = {{10, 0.010, 1000, 0}, {40, 0.005, 1000, 1}, {200, 0.002, 2500, 2}};
};
/// Diameters from 4 to 10 mm, no two alike; a distribution has no species.
struct many_sizes {
  static constexpr const char* name = "many sizes";
  static constexpr int species_count = 0;
  static constexpr int count = 120;
  struct List {
    SizeRun run[count];
  };
  static constexpr List list = [] {
    List made{};
    for (int k = 0; k < count; ++k) made.run[k] = {1, 0.004 + 0.006 * ((k * 37) % count + 0.5) / count, 1000, 0};
    return made;
  }();
  static constexpr const SizeRun (&sizes)[count] = list.run;
};

/// No sizes at all: 8 mm, listed three times.
struct equal_runs {
  static constexpr const char* name = "one size listed as three";
  static constexpr int species_count = 3;
  static constexpr const char* species_names[] = {"red", "green", "blue"};
  static constexpr SizeRun sizes[] = {{60, 0.008, 1200, 0}, {10, 0.008, 1200, 1}, {40, 0.008, 1200, 2}};
};

struct closed_pipe : short_pipe {
  static constexpr Ends ends = Ends::closed;
};
struct narrow_pipe : short_pipe {
  static constexpr double pipe_diameter = 0.03, pipe_length = 0.05, time_step = 5e-7;
  static constexpr int slice_count = 5, neighbour_capacity = 130;
};
/// d_g is the Sauter diameter of each slice.
struct gas_pipe : short_pipe {
  static constexpr bool has_gas = true;
  static constexpr double gas_velocity = 2.4, gas_density = 1.2, gas_viscosity = 1.5e-5;
};
/// With room above the bed: slices of every kind, and floaters.
struct long_gas_pipe : gas_pipe {
  static constexpr double pipe_length = 0.25;
  static constexpr int slice_count = 25;
};
struct few_of_two_sizes : two_sizes {
  static constexpr SizeRun sizes[] = {{25, 0.010, 1000, 0}, {75, 0.005, 1500, 1}};
};

/// From a random start, agitated (+-0.5 m/s with spins to match) and run by the kernel for a while.
template <class Case>
Events check_sizes(const char* what, long long steps_before = 3000, double tolerance = position_tolerance<Case>) {
  const Events events = check_after<Case>(random_spheres<Case>(0.5, Random(seed())), steps_before, what, tolerance);
  CHECK(events.begun > 0);
  CHECK(events.ended > 0);
  if (Derived<Case>::has_rotation) {
    CHECK(events.sliding > 0);
    CHECK(events.sticking > 0);
    CHECK(events.compared > 0);
  }
  return events;
}

}  // namespace fixdem::tests
