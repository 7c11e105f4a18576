// How densely particles of one size and of two pack when they are poured into a standing tube, against another program.
#include <algorithm>
#include <numbers>

#include "sizes_scenes.hpp"

namespace fixdem::tests {

struct large_and_small {
  static constexpr const char* name = "280 of 10 mm and 960 of 5 mm";
  static constexpr int species_count = 2;
  static constexpr const char* species_names[] = {"large", "small"};
  static constexpr SizeRun sizes[] = {{280, 0.010, 1000, 0}, {960, 0.005, 1000, 1}};
};

namespace {

/// Soft, so that the step may be long: overlaps under the weight are some 0.1 %.
struct tube : short_pipe {
  static constexpr double youngs_modulus = 1e7, wall_youngs_modulus = 1e7;
  static constexpr Ends ends = Ends::closed;
  static constexpr double pipe_length = 0.8, time_step = 4e-5;
  static constexpr double gravity[3] = {0, 0, -9.81};
  static constexpr Integrator integrator = Integrator::impulse;
  static constexpr Slider slider = Slider::exact;
  static constexpr bool energy_ledger = false;
};
struct one_size : tube {
  static constexpr const char* name = "400 of 10 mm";
  static constexpr int particle_count = 400, neighbour_capacity = 14;
  static constexpr double diameter = 0.010, density = 1000;
};
/// Volume of a sphere below a plane `above` (m) its centre.
double volume_below(double r, double above) {
  const double x = std::clamp(above, -r, r);
  return std::numbers::pi * (r * r * x - x * x * x / 3 + 2 * r * r * r / 3);
}

/// Of the bed after 1 s, from 20 mm above the floor to 20 mm below its top: volume of solids over that of the tube. A
/// few particles on top may still hop: the top is where 98 % of them are.
template <class Case>
double solids_fraction() {
  enter({Case::name, seed()});
  static Simulation<Case> simulation;
  place_all(simulation, random_spheres<Case>(0, Random(seed())));
  start(simulation);
  run(simulation, 25000);
  std::vector<double> tops;
  for (int i = 0; i < Case::particle_count; ++i)
    tops.push_back(simulation.particle(i).position[2] + radius_of<Case>(i));
  std::sort(tops.begin(), tops.end());
  const double low = 0.02, high = tops[tops.size() * 98 / 100] - 0.02;
  double solids = 0;
  for (int i = 0; i < Case::particle_count; ++i) {
    const double z = simulation.particle(i).position[2], r = radius_of<Case>(i);
    solids += volume_below(r, high - z) - volume_below(r, low - z);
  }
  return solids / (std::numbers::pi / 4 * Case::pipe_diameter * Case::pipe_diameter * (high - low));
}

TEST_CASE("packing: one size and two, poured into a tube") {
  CHECK(std::abs(solids_fraction<one_size>() - 0.5624) < 0.02);
  CHECK(std::abs(solids_fraction<sized<large_and_small, tube>>() - 0.6086) < 0.02);
}

}  // namespace
}  // namespace fixdem::tests
