// expected: fixdem: friction_limit = "elastic" needs [material] friction above 0
#include "base.hpp"

namespace fixdem::compile_fail {
struct Refused : Base {
  static constexpr auto friction_limit = FrictionLimit::elastic;
  static constexpr double friction = 0;
};
template int use<Refused>();
}  // namespace fixdem::compile_fail
