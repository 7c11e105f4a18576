// expected: fixdem: [material] poisson_ratio must lie between 0 and 0.5
#include "base.hpp"

namespace fixdem::compile_fail {
struct Refused : Base {
  static constexpr double poisson_ratio = 0.6;
};
template int use<Refused>();
}  // namespace fixdem::compile_fail
