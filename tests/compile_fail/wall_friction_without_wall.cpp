// expected: fixdem: [material] wall_friction and wall_restitution need a wall
#include "base.hpp"

namespace fixdem::compile_fail {
struct Refused : Base {
  static constexpr double wall_friction = 0.1;
  static constexpr bool has_wall = false;
  static constexpr auto ends = Ends::periodic;
};
template int use<Refused>();
}  // namespace fixdem::compile_fail
