// expected: fixdem: [material] wall_rolling_friction needs wall_friction above 0
#include "base.hpp"

namespace fixdem::compile_fail {
struct Refused : Base {
  static constexpr double wall_friction = 0, wall_rolling_friction = 0.05;
};
template int use<Refused>();
}  // namespace fixdem::compile_fail
