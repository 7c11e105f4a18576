// expected: fixdem: [material] youngs_modulus must be positive
#include "base.hpp"

namespace fixdem::compile_fail {
struct Refused : Base {
  static constexpr double youngs_modulus = 0;
};
template int use<Refused>();
}  // namespace fixdem::compile_fail
