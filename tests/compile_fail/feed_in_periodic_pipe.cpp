// expected: [feed] needs [pipe] ends = "open"
#include "base.hpp"

namespace fixdem::compile_fail {
struct Refused : Line {
  static constexpr auto ends = Ends::periodic;
};
template int use<Refused>();
}  // namespace fixdem::compile_fail
