// expected: fixdem: friction_limit = "elastic" needs slider = "clip" or "exact"
#include "base.hpp"

namespace fixdem::compile_fail {
struct Refused : Base {
  static constexpr auto friction_limit = FrictionLimit::elastic;
  static constexpr auto slider = Slider::paper;
};
template int use<Refused>();
}  // namespace fixdem::compile_fail
