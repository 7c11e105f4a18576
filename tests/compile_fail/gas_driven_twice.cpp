// expected: inlet_pressure excludes a blower
#include "base.hpp"

namespace fixdem::compile_fail {
struct Refused : AirLine {
  static constexpr double gas_inlet_pressure = 1.1e5, gas_blower_flow = 0.01, gas_blower_pressure = 1e4;
};
template int use<Refused>();
}  // namespace fixdem::compile_fail
