// expected: fixdem: too many force rows in a chunk
#include "base.hpp"

namespace fixdem::compile_fail {
struct Refused : Base {
  static constexpr double pipe_diameter = 1.0;
};
template int use<Refused>();
}  // namespace fixdem::compile_fail
