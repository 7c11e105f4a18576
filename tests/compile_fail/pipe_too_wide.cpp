// expected: fixdem: force rows are numbered in 16 bits: lower [capacity] neighbours
#include "base.hpp"

namespace fixdem::compile_fail {
struct Refused : Base {
  static constexpr double pipe_diameter = 1.0;
};
template int use<Refused>();
}  // namespace fixdem::compile_fail
