// expected: sizes must have the kinds of all particles at the start, and one to be fed
#include "base.hpp"

namespace fixdem::compile_fail {
struct Refused : LineOfSizes {
  static constexpr int first_fed_kind = 8;
};
template int use<Refused>();
}  // namespace fixdem::compile_fail
