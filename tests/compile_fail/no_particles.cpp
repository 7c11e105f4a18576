// expected: fixdem: [particles] count must be at least 1
#include "base.hpp"

namespace fixdem::compile_fail {
struct Refused : Base {
  static constexpr int particle_count = 0;
};
template int use<Refused>();
}  // namespace fixdem::compile_fail
