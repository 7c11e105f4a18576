// Kernel against reference, the gas: full and partly filled pipes, bed heights, floaters, intervals.
#include "small_gas_scene.hpp"

namespace fixdem::tests {
namespace {

struct hard_height : thin_gas {
  static constexpr BedHeight gas_bed_height = BedHeight::hard;
};
struct strict_height : thin_gas {
  static constexpr BedHeight gas_bed_height = BedHeight::strict;
};
struct intervals : thin_gas {
  static constexpr int gas_update_interval = 5, gas_floater_interval = 25;
};
struct odd_intervals : thin_gas {  // floaters change between two updates of the gas
  static constexpr int gas_update_interval = 7, gas_floater_interval = 4;
};
struct closed_gas : small_gas {
  static constexpr Ends ends = Ends::closed;
};

TEST_CASE("agreement: gas through a full pipe") {
  check_dense<small_gas>("gas, dense");
  check_dense<closed_gas>("gas, dense, closed");
}

TEST_CASE("agreement: gas above a layer, bed heights") {
  check_dilute<thin_gas>("gas, continuous height");
  check_dilute<hard_height>("gas, hard height");
  check_dilute<strict_height>("gas, strict height");
}

TEST_CASE("agreement: gas, floaters are among the particles compared") {
  check_dilute<thin_gas>("gas, floaters");
  reference::Reference<thin_gas> program;
  start_from(program, hand_over_from(kernel<thin_gas>(), thin_gas::particle_count));
  run(program, 1);
  int floaters = 0;
  for (int i = 0; i < thin_gas::particle_count; ++i) floaters += program.floats(i);
  CHECK(floaters > 0);
  CHECK(floaters < thin_gas::particle_count);
}

TEST_CASE("agreement: gas, intervals") {
  check_dilute<intervals>("gas every 5 steps, floaters every 25");
  check_dilute<odd_intervals>("gas every 7 steps, floaters every 4");
}

}  // namespace
}  // namespace fixdem::tests
