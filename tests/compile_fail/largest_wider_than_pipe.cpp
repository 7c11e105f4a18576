// expected: fixdem: the particle is wider than the pipe
#include "base.hpp"

namespace fixdem::compile_fail {
struct Refused : Sizes {
  static constexpr double pipe_diameter = 0.01;
};
template int use<Refused>();
}  // namespace fixdem::compile_fail
