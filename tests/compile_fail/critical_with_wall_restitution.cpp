// expected: fixdem: [material] wall_restitution says nothing with damping = "critical"
#include "base.hpp"

namespace fixdem::compile_fail {
struct Refused : Base {
  static constexpr auto normal = NormalLaw::linear;
  static constexpr auto damping = Damping::critical;
  static constexpr double normal_stiffness = 1e4, tangential_stiffness = 1e4;
  static constexpr double wall_restitution = 0.5;
};
template int use<Refused>();
}  // namespace fixdem::compile_fail
