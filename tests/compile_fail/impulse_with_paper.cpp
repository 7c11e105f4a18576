// expected: fixdem: integrator = "impulse" needs slider = "exact" or "clip"
#include "base.hpp"

namespace fixdem::compile_fail {
struct Refused : Base {
  static constexpr auto integrator = Integrator::impulse;
  static constexpr auto slider = Slider::paper;
};
template int use<Refused>();
}  // namespace fixdem::compile_fail
