// expected: bulk_velocity excludes inlet_pressure and a blower
#include "base.hpp"

namespace fixdem::compile_fail {
struct Refused : AirLine {
  static constexpr TimeValue gas_velocity_in_time[] = {{0, 10}, {1, 20}};
  static constexpr double gas_blower_flow = 0.01, gas_blower_pressure = 1e4;
};
template int use<Refused>();
}  // namespace fixdem::compile_fail
