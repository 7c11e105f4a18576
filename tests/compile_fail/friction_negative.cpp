// expected: fixdem: [material] friction must not be negative
#include "base.hpp"

namespace fixdem::compile_fail {
struct Refused : Base {
  static constexpr double friction = -0.1;
};
template int use<Refused>();
}  // namespace fixdem::compile_fail
