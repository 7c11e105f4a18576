// expected: [particles] count must not be above capacity
#include "base.hpp"

namespace fixdem::compile_fail {
struct Refused : Line {
  static constexpr int start_count = 9;
};
template int use<Refused>();
}  // namespace fixdem::compile_fail
