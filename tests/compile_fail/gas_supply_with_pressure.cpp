// expected: supply_volume says nothing with inlet_pressure
#include "base.hpp"

namespace fixdem::compile_fail {
struct Refused : AirLine {
  static constexpr double gas_supply_volume = 0.1, gas_inlet_pressure = 1.1e5;
};
template int use<Refused>();
}  // namespace fixdem::compile_fail
