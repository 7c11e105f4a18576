// Kernel against reference with several sizes and all else: rolling resistance, walls of their own, gas, mixed
// precision.
#include "mixed.hpp"
#include "sizes_scenes.hpp"

namespace fixdem::tests {
namespace {

/// Walls and rolling resistance of their own, everything at once.
template <class Particles, class Pipe, Integrator scheme>
struct everything : sized<Particles, Pipe> {
  static constexpr double wall_friction = 0.2, wall_restitution = 0.6;
  static constexpr double rolling_friction = 0.2, wall_rolling_friction = 0.1;
  static constexpr Integrator integrator = scheme;
};
template <class Base, TangentialLaw form, Slider kind>
struct with : Base {
  static constexpr TangentialLaw tangential = form;
  static constexpr Slider slider = kind;
};

using enum TangentialLaw;
using enum Slider;
using enum Integrator;

void check_rolling(const Events& events) {
  CHECK(events.rolling > 0);
  CHECK(events.held > 0);
}

TEST_CASE("agreement: sizes with rolling resistance and walls of their own") {
  check_rolling(check_sizes<everything<two_sizes, closed_pipe, euler>>("sizes, rolling, own walls, closed"));
  check_rolling(check_sizes<with<everything<two_sizes, closed_pipe, leapfrog>, force, clip>>(
      "sizes, rolling, own walls, leapfrog, force"));
  check_rolling(check_sizes<with<everything<mixed_order, short_pipe, impulse>, rescale, exact>>(
      "sizes, rolling, own walls, impulse, rescale, exact"));
}

template <class Case>
void check_mixed(const char* what, double tolerance = agitated_tolerance<in_mixed_precision<Case>>) {
  check_rolling(check_sizes<in_mixed_precision<Case>>(what, 3000, tolerance));
}

TEST_CASE("mixed agreement: sizes with rolling resistance and walls of their own") {
  check_mixed<everything<two_sizes, closed_pipe, euler>>("sizes, rolling, mixed");
  check_mixed<with<everything<two_sizes, short_pipe, leapfrog>, force, clip>>("sizes, rolling, mixed, leapfrog, force");
  check_mixed<with<everything<mixed_order, closed_pipe, impulse>, displacement, exact>>(
      "sizes, rolling, mixed, impulse");
}

struct full_gas : sized<two_sizes, gas_pipe> {};
struct thin_gas : sized<few_of_two_sizes, long_gas_pipe> {};
struct given_diameter : thin_gas {
  static constexpr double gas_bed_diameter = 0.004;
  static constexpr BedHeight gas_bed_height = BedHeight::hard;
  static constexpr int gas_update_interval = 7, gas_floater_interval = 4;
};
struct strict_gas : everything<few_of_two_sizes, long_gas_pipe, impulse> {
  static constexpr BedHeight gas_bed_height = BedHeight::strict;
};
struct long_slices : thin_gas {
  static constexpr int slice_count = 4;
};

/// After 60 ms some lie at the bottom and some still fly.
template <class Case>
void check_dilute(const char* what) {
  const Events events = check_after<Case>(random_spheres<Case>(0.5, Random(seed())), 30000, what);
  CHECK(events.begun > 0);
  CHECK(events.ended > 0);
  CHECK(events.sliding + events.sticking > 0);
  reference::Reference<Case> program;
  start_from(program, hand_over_from(kernel<Case>(), Case::particle_count));
  run(program, 1);
  int floaters = 0;
  for (int i = 0; i < Case::particle_count; ++i) floaters += program.floats(i);
  CHECK(floaters > 0);
  CHECK(floaters < Case::particle_count);
}

TEST_CASE("agreement: sizes with gas through a full pipe") { check_sizes<full_gas>("sizes, gas, dense"); }

TEST_CASE("agreement: sizes with gas above a layer") {
  check_dilute<thin_gas>("sizes, gas");
  check_dilute<given_diameter>("sizes, gas, hard height, bed diameter, intervals");
  check_dilute<strict_gas>("sizes, gas, strict height, rolling, impulse");
  check_dilute<long_slices>("sizes, gas, slices of six diameters");
}

}  // namespace
}  // namespace fixdem::tests
