// expected: fixdem: the gas model needs the pipe wall: set [pipe] wall = true
#include "base.hpp"

namespace fixdem::compile_fail {
struct Refused : Base {
  static constexpr bool has_gas = true;
  static constexpr double gas_velocity = 2.4, gas_density = 1.2, gas_viscosity = 1.5e-5, gas_bed_diameter = 0.01;
  static constexpr bool has_wall = false;
};
template int use<Refused>();
}  // namespace fixdem::compile_fail
