// expected: fixdem: [material] rolling_friction must not be negative
#include "base.hpp"

namespace fixdem::compile_fail {
struct Refused : Base {
  static constexpr double rolling_friction = -0.05;
};
template int use<Refused>();
}  // namespace fixdem::compile_fail
