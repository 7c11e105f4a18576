// expected: fixdem: the particle is wider than the pipe
#include "base.hpp"

namespace fixdem::compile_fail {
struct Refused : Base {
  static constexpr double diameter = 0.06;
};
template int use<Refused>();
}  // namespace fixdem::compile_fail
