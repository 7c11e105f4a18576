// expected: [feed] velocity must not be negative
#include "base.hpp"

namespace fixdem::compile_fail {
struct Refused : Line {
  static constexpr double feed_velocity = -0.5;
};
template int use<Refused>();
}  // namespace fixdem::compile_fail
