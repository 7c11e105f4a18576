// expected: fixdem: [material] wall_restitution must be above 0 and at most 1
#include "base.hpp"

namespace fixdem::compile_fail {
struct Refused : Base {
  static constexpr double wall_restitution = 0;
};
template int use<Refused>();
}  // namespace fixdem::compile_fail
