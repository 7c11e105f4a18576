// expected: sizes must have the kinds of all particles at the start, and one to be fed
#include "base.hpp"

namespace fixdem::compile_fail {
struct Refused : LineOfSizes {
  static constexpr int particle_count = 20, start_count = 9;
};
template int use<Refused>();
}  // namespace fixdem::compile_fail
