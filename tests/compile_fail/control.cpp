// The control: the base case itself, its linear twin, one with gas, one particle in gas in a vertical pipe, one in
// mixed precision, two with rolling resistance, two with several sizes, one with gas on a slope and four open lines
// must compile.
#include "base.hpp"

namespace fixdem::compile_fail {
struct Linear : Base {
  static constexpr auto normal = NormalLaw::linear;
  static constexpr auto damping = Damping::critical;
  static constexpr double normal_stiffness = 1e4, tangential_stiffness = 1e4;
};
struct Gas : Base {
  static constexpr bool has_gas = true;
  static constexpr double gas_velocity = 2.4, gas_density = 1.2, gas_viscosity = 1.5e-5, gas_bed_diameter = 0.01;
};
struct GrainInGas : Gas {
  static constexpr int particle_count = 1;
  static constexpr double gravity[3] = {0, 0, -9.81};
};
struct Mixed : Base {
  static constexpr auto precision = Precision::mixed_precision;
};
struct Rolling : Base {
  static constexpr double rolling_friction = 0.05;
};
struct RollingOnWalls : Base {
  static constexpr double friction = 0, wall_friction = 0.3, wall_rolling_friction = 0.05;
};
struct SizesInGas : Sizes {
  static constexpr bool has_gas = true;
  static constexpr double gas_velocity = 2.4, gas_density = 1.2, gas_viscosity = 1.5e-5;  // Ergun's d: of each slice
};
struct GasOnSlope : Gas {
  static constexpr double gravity[3] = {1, -8, -5};
};
struct LineInGas : Open<Gas> {
  static constexpr double gravity[3] = {0, 0, -9.81};
};
template int use<Base>();
template int use<Linear>();
template int use<Gas>();
template int use<GrainInGas>();
template int use<Mixed>();
template int use<Rolling>();
template int use<RollingOnWalls>();
template int use<Sizes>();
template int use<SizesInGas>();
template int use<GasOnSlope>();
template int use<Line>();
template int use<LineInGas>();
template int use<LineOfSizes>();
template int use<AirLine>();
}  // namespace fixdem::compile_fail
