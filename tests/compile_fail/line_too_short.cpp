// expected: an open line must be at least 4 particle diameters long
#include "base.hpp"

namespace fixdem::compile_fail {
struct Refused : Line {
  static constexpr double pipe_length = 0.039, feed_length = 0.03;
};
template int use<Refused>();
}  // namespace fixdem::compile_fail
