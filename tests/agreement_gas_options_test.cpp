// Kernel against reference, the gas with other options: integrator, friction, flow direction, diameter, slices.
#include "small_gas_scene.hpp"

namespace fixdem::tests {
namespace {

struct leapfrog_gas : thin_gas {
  static constexpr Integrator integrator = Integrator::leapfrog;
};
struct small_bed_diameter : thin_gas {
  static constexpr double gas_bed_diameter = 0.003;
};
struct frictionless_gas : thin_gas {
  static constexpr double friction = 0;
};
struct reversed_gas : thin_gas {
  static constexpr double gas_velocity = -1.7;
};
struct still_gas : thin_gas {
  static constexpr double gas_velocity = 0;
};
struct long_slices : thin_gas {
  static constexpr int slice_count = 4;
};

TEST_CASE("agreement: gas with other options") {
  check_dilute<leapfrog_gas>("gas, leapfrog");
  check_dilute<small_bed_diameter>("gas, bed diameter 3 mm");
  check_dilute<frictionless_gas>("gas, frictionless");
  check_dilute<reversed_gas>("gas, reversed");
  check_dilute<still_gas>("gas at rest");
  check_dilute<long_slices>("gas, slices of six diameters");
}

}  // namespace
}  // namespace fixdem::tests
