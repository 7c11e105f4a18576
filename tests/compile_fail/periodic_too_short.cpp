// expected: fixdem: a periodic pipe must be at least 4 particle diameters long
#include "base.hpp"

namespace fixdem::compile_fail {
struct Refused : Base {
  static constexpr double pipe_length = 0.035;
};
template int use<Refused>();
}  // namespace fixdem::compile_fail
