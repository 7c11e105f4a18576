// expected: a line cannot be coupled
#include "base.hpp"

namespace fixdem::compile_fail {
struct Refused : Line {
  static constexpr bool is_coupled = true;
};
template int use<Refused>();
}  // namespace fixdem::compile_fail
