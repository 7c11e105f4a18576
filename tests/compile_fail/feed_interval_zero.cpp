// expected: feed_interval must be 1 step at least
#include "base.hpp"

namespace fixdem::compile_fail {
struct Refused : Line {
  static constexpr int feed_interval = 0;
};
template int use<Refused>();
}  // namespace fixdem::compile_fail
