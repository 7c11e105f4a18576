// expected: fixdem: [contact] damping_mass = "particle" needs one size of particles: use "reduced"
#include "base.hpp"

namespace fixdem::compile_fail {
struct Refused : Sizes {
  static constexpr auto damping_mass = DampingMass::particle;
};
template int use<Refused>();
}  // namespace fixdem::compile_fail
