// expected: with gas and several particles, [run] gravity must not be zero
#include "base.hpp"

namespace fixdem::compile_fail {
struct Refused : Base {
  static constexpr bool has_gas = true;
  static constexpr double gas_velocity = 2.4, gas_density = 1.2, gas_viscosity = 1.5e-5, gas_bed_diameter = 0.01;
  static constexpr double gravity[3] = {0, 0, 0};
};
template int use<Refused>();
}  // namespace fixdem::compile_fail
