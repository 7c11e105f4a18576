// expected: fixdem: [capacity] tile_steps must lie between 1 and 16
#include "base.hpp"

namespace fixdem::compile_fail {
struct Refused : Base {
  static constexpr int tile_steps = 17;
};
template int use<Refused>();
}  // namespace fixdem::compile_fail
