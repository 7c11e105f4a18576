// Kernel against reference with impulses and the exact slider.
#include "mixed.hpp"
#include "small_scene.hpp"

namespace fixdem::tests {
namespace {

struct impulse_exact : small_closed {
  static constexpr Integrator integrator = Integrator::impulse;
  static constexpr Slider slider = Slider::exact;
};
struct impulse_linear : small_periodic {
  static constexpr Integrator integrator = Integrator::impulse;
  static constexpr NormalLaw normal = NormalLaw::linear;
  static constexpr TangentialLaw tangential = TangentialLaw::rescale;
  static constexpr double youngs_modulus = 0, poisson_ratio = 0, wall_youngs_modulus = 0, wall_poisson_ratio = 0;
  static constexpr double normal_stiffness = 2e5, tangential_stiffness = 1.3e5;
};
struct euler_exact : small_periodic {
  static constexpr Slider slider = Slider::exact;
  static constexpr TangentialLaw tangential = TangentialLaw::force;
};

TEST_CASE("agreement: impulse") {
  check_small<impulse_exact>("impulse, exact slider, closed");
  check_small<impulse_linear>("impulse, linear, rescale, clip");
  check_small<euler_exact>("euler, exact slider, force");
}

}  // namespace
}  // namespace fixdem::tests
