// expected: ends = "open" needs a feed
#include "base.hpp"

namespace fixdem::compile_fail {
struct Refused : Base {
  static constexpr auto ends = Ends::open;
};
template int use<Refused>();
}  // namespace fixdem::compile_fail
