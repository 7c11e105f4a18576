// Kernel against reference, walls and rotation: with and without pipe wall, closed ends, friction, wall materials.
#include "small_scene.hpp"

namespace fixdem::tests {
namespace {

template <class Base>
struct frictionless : Base {
  static constexpr double friction = 0;
};
template <class Base>
struct without_wall : Base {
  static constexpr bool has_wall = false;
};
struct frictionless_leapfrog : frictionless<small_closed> {
  static constexpr Integrator integrator = Integrator::leapfrog;
};
struct rigid_wall : small_closed {
  static constexpr double wall_youngs_modulus = __builtin_inf();
};
struct soft_wall : small_periodic {
  static constexpr double wall_youngs_modulus = 5e8, wall_poisson_ratio = 0.45;
};

TEST_CASE("agreement: no friction, no rotation") {
  check_small<frictionless<small_periodic>>("frictionless");
  check_small<frictionless<small_closed>>("frictionless, closed");
  check_small<frictionless_leapfrog>("frictionless, closed, leapfrog");
}

TEST_CASE("agreement: no pipe wall") {
  check_small<without_wall<small_periodic>>("without wall", 500);  // before they have flown apart
  check_small<without_wall<small_closed>>("without wall, closed", 500);
  check_small<without_wall<frictionless<small_periodic>>>("without wall, frictionless", 500);
}

TEST_CASE("agreement: wall material") {
  check_small<rigid_wall>("rigid wall");
  check_small<soft_wall>("soft wall");
}

}  // namespace
}  // namespace fixdem::tests
