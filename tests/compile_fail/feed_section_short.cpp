// expected: [feed] length must lie between two diameters of the particles and the length of the pipe
#include "base.hpp"

namespace fixdem::compile_fail {
struct Refused : Line {
  static constexpr double feed_length = 0.019;
};
template int use<Refused>();
}  // namespace fixdem::compile_fail
