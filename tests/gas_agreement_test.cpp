// Kernel against reference, the gas of a line: compressible, stored, driven by pressure or a blower, changing in time;
// a gap of its own, a slope, an upright pipe.
#include "small_gas_scene.hpp"

namespace fixdem::tests {
namespace {

struct closed_gas : thin_gas {
  static constexpr Ends ends = Ends::closed;
  static constexpr int gas_update_interval = 5;
};
/// At so low a pressure that a short pipe loses a good part of it.
struct compressible : closed_gas {
  static constexpr bool gas_compressible = true;
  static constexpr double gas_outlet_pressure = 2000;
};
struct stored : compressible {
  static constexpr bool gas_storage = true;
};
struct blown : stored {
  static constexpr double gas_supply_volume = 2e-4, gas_blower_flow = 7e-3, gas_blower_pressure = 800;
};
struct pressed : compressible {
  static constexpr double gas_inlet_pressure = 2150;
};
struct rising : stored {
  static constexpr TimeValue gas_velocity_in_time[] = {{0, 1.8}, {1e-3, 2.6}};
};
struct rising_uncompressed : closed_gas {
  static constexpr TimeValue gas_velocity_in_time[] = {{2e-4, 1.8}, {1e-3, 2.6}};
};
struct with_gap : closed_gas {
  static constexpr double gas_full_gap = 0.004;
};
struct on_a_slope : closed_gas {  // 30 degrees, gravity from the side
  static constexpr double gravity[3] = {-6.0, -6.0, -4.9};
};
struct upright : closed_gas {
  static constexpr double gravity[3] = {0, 0, -9.81};
};
struct upright_compressible : stored {
  static constexpr double gravity[3] = {0, 0, -9.81};
};

TEST_CASE("agreement: compressible gas") {
  check_dilute<compressible>("gas, compressible");
  check_dilute<pressed>("gas, inlet pressure");
}

TEST_CASE("agreement: compressible gas with storage") {
  check_dilute<stored>("gas, storage");
  check_dilute<blown>("gas, blower and supply");
  check_dilute<rising>("gas, storage, velocity in time");
}

TEST_CASE("agreement: gas in time and with a gap of its own") {
  check_dilute<rising_uncompressed>("gas, velocity in time");
  check_dilute<with_gap>("gas, gap of 4 mm");
}

TEST_CASE("agreement: gas on a slope and upright") {
  check_dilute<on_a_slope>("gas, slope");
  check_dilute<upright>("gas, upright");
  check_dilute<upright_compressible>("gas, upright, storage");
}

}  // namespace
}  // namespace fixdem::tests
