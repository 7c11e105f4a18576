// expected: fixdem: the largest diameter must be at most 10 times the smallest
#include "base.hpp"

namespace fixdem::compile_fail {
struct Refused : Sizes {
  static constexpr double smallest_diameter = 0.0009;
  static constexpr SizeRun sizes[] = {{2, 0.01, 1000, 0}, {6, 0.0009, 2000, 1}};
};
template int use<Refused>();
}  // namespace fixdem::compile_fail
