// expected: fixdem: [material] rolling_friction needs [material] friction above 0
#include "base.hpp"

namespace fixdem::compile_fail {
struct Refused : Base {
  static constexpr double friction = 0, wall_friction = 0.3;
  static constexpr double rolling_friction = 0.05;
};
template int use<Refused>();
}  // namespace fixdem::compile_fail
