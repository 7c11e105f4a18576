// expected: fixdem: [particles] diameter and density must be positive
#include "base.hpp"

namespace fixdem::compile_fail {
struct Refused : Base {
  static constexpr double density = 0;
};
template int use<Refused>();
}  // namespace fixdem::compile_fail
