// expected: fixdem: [capacity] neighbours must lie between 2 and 30
#include "base.hpp"

namespace fixdem::compile_fail {
struct Refused : Base {
  static constexpr int neighbour_capacity = 1;
};
template int use<Refused>();
}  // namespace fixdem::compile_fail
