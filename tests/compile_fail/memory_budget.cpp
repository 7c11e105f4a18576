// expected: memory::near_pairs<
#include "base.hpp"

namespace fixdem::compile_fail {
struct Refused : Base {
  static constexpr long long memory_budget = 16 * 1024;
};
template int use<Refused>();
}  // namespace fixdem::compile_fail
