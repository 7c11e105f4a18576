// expected: fixdem: the counts of sizes must add up to particle_count
#include "base.hpp"

namespace fixdem::compile_fail {
struct Refused : Sizes {
  static constexpr SizeRun sizes[] = {{2, 0.01, 1000, 0}, {5, 0.005, 2000, 1}};
};
template int use<Refused>();
}  // namespace fixdem::compile_fail
