// expected: fixdem: tiles need a pipe of many chunks: lower [capacity] tile_steps
#include "base.hpp"

namespace fixdem::compile_fail {
struct Refused : Base {
  static constexpr int tile_steps = 2;
};
template int use<Refused>();
}  // namespace fixdem::compile_fail
