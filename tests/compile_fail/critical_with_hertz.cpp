// expected: fixdem: damping = "critical" belongs to normal = "linear"
#include "base.hpp"

namespace fixdem::compile_fail {
struct Refused : Base {
  static constexpr auto damping = Damping::critical;
};
template int use<Refused>();
}  // namespace fixdem::compile_fail
