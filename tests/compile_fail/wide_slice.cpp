// expected: fixdem: a slice of the pipe holds too many particles
#include "base.hpp"

namespace fixdem::compile_fail {
struct Refused : Base {
  static constexpr int particle_count = 3000000;
  static constexpr double pipe_diameter = 2000 * diameter;
};
template int use<Refused>();
}  // namespace fixdem::compile_fail
