// expected: ends = "open" needs the pipe's wall
#include "base.hpp"

namespace fixdem::compile_fail {
struct Refused : Line {
  static constexpr bool has_wall = false;
};
template int use<Refused>();
}  // namespace fixdem::compile_fail
