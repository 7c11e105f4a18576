// expected: fixdem: normal = "linear" needs [contact] normal_stiffness and tangential_stiffness above 0
#include "base.hpp"

namespace fixdem::compile_fail {
struct Refused : Base {
  static constexpr auto normal = NormalLaw::linear;
  static constexpr double normal_stiffness = 1e4;
};
template int use<Refused>();
}  // namespace fixdem::compile_fail
