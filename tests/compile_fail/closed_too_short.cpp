// expected: fixdem: a closed pipe must be at least 2 particle diameters long
#include "base.hpp"

namespace fixdem::compile_fail {
struct Refused : Base {
  static constexpr auto ends = Ends::closed;
  static constexpr double pipe_length = 0.015;
};
template int use<Refused>();
}  // namespace fixdem::compile_fail
