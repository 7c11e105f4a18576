// expected: fixdem: [run] time_step must be positive
#include "base.hpp"

namespace fixdem::compile_fail {
struct Refused : Base {
  static constexpr double time_step = 0;
};
template int use<Refused>();
}  // namespace fixdem::compile_fail
