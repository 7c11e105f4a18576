// expected: full_gap must lie between 0 and the diameter of the pipe
#include "base.hpp"

namespace fixdem::compile_fail {
struct Refused : AirLine {
  static constexpr double gas_full_gap = 0.06;
};
template int use<Refused>();
}  // namespace fixdem::compile_fail
