// Kernel against reference, the normal law: Hertz and linear, damping from the restitution and critical.
#include "small_scene.hpp"

namespace fixdem::tests {
namespace {

template <class Base, TangentialLaw form, Damping kind>
struct with_linear : Base {
  static constexpr NormalLaw normal = NormalLaw::linear;
  static constexpr TangentialLaw tangential = form;
  static constexpr double youngs_modulus = 0, poisson_ratio = 0, wall_youngs_modulus = 0, wall_poisson_ratio = 0;
  static constexpr double normal_stiffness = 2e5, tangential_stiffness = 1.3e5;
  static constexpr Damping damping = kind;
};

template <class Base, int permille>
struct with_restitution : Base {
  static constexpr double restitution = permille / 1000.0;
};

template <class Base>
struct with_leapfrog : Base {
  static constexpr Integrator integrator = Integrator::leapfrog;
};

TEST_CASE("agreement: linear law") {
  using enum TangentialLaw;
  check_small<with_linear<small_periodic, displacement, Damping::restitution>>("linear");
  check_small<with_linear<small_closed, displacement, Damping::critical>>("linear, critical damping, closed");
  check_small<with_linear<small_closed, force, Damping::restitution>>("linear, force, closed");
  check_small<with_leapfrog<with_linear<small_periodic, rescale, Damping::restitution>>>("linear, rescale, leapfrog");
}

TEST_CASE("agreement: restitution") {
  check_small<with_restitution<small_periodic, 1000>>("e = 1");
  check_small<with_restitution<small_closed, 200>>("e = 0.2, closed");
  check_small<with_leapfrog<with_restitution<small_periodic, 500>>>("e = 0.5, leapfrog");
}

}  // namespace
}  // namespace fixdem::tests
