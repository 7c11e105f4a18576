// expected: [feed] rate must not be negative, and its times must increase
#include "base.hpp"

namespace fixdem::compile_fail {
struct Refused : Line {
  static constexpr TimeValue feed_rate[] = {{0, 0.1}, {1, -0.1}};
};
template int use<Refused>();
}  // namespace fixdem::compile_fail
