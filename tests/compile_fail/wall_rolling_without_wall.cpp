// expected: fixdem: [material] wall_rolling_friction needs a wall
#include "base.hpp"

namespace fixdem::compile_fail {
struct Refused : Base {
  static constexpr double wall_rolling_friction = 0.05;
  static constexpr bool has_wall = false;
  static constexpr auto ends = Ends::periodic;
};
template int use<Refused>();
}  // namespace fixdem::compile_fail
