// expected: fixdem: [material] restitution must be above 0 and at most 1
#include "base.hpp"

namespace fixdem::compile_fail {
struct Refused : Base {
  static constexpr double restitution = 0;
};
template int use<Refused>();
}  // namespace fixdem::compile_fail
