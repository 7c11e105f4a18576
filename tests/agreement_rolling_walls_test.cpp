// Kernel against reference with rolling resistance between particles, at walls, or both, and in mixed precision.
#include "mixed.hpp"
#include "small_scene.hpp"

namespace fixdem::tests {
namespace {

template <class Base>
struct rolling : Base {
  static constexpr double rolling_friction = 0.5;
};
/// Walls do not resist.
template <class Base>
struct between_particles : rolling<Base> {
  static constexpr double wall_rolling_friction = 0;
};
/// Only walls resist.
template <class Base>
struct at_walls : Base {
  static constexpr double wall_rolling_friction = 0.5;
};
template <class Base>
struct differing : Base {
  static constexpr double rolling_friction = 0.2, wall_rolling_friction = 0.5;
};
template <class Base>
struct own_walls : Base {
  static constexpr double wall_friction = 0.1, wall_restitution = 0.5;
};
/// Walls turn nothing, and so resist no rolling.
template <class Base>
struct slick_walls : Base {
  static constexpr double wall_friction = 0;
};
template <class Base>
struct slick_particles : Base {
  static constexpr double friction = 0, wall_friction = 0.4;
};
template <class Base>
struct elastic_limit : Base {
  static constexpr FrictionLimit friction_limit = FrictionLimit::elastic;
};
struct impulses : small_closed {
  static constexpr Slider slider = Slider::exact;
  static constexpr Integrator integrator = Integrator::impulse;
};
struct forces : small_closed {
  static constexpr TangentialLaw tangential = TangentialLaw::force;
  static constexpr Integrator integrator = Integrator::leapfrog;
};
struct rescaled : small_periodic {
  static constexpr TangentialLaw tangential = TangentialLaw::rescale;
};

void check_both(const Events& events) {
  CHECK(events.rolling > 0);
  CHECK(events.held > 0);
  CHECK(events.compared > 0);
}

TEST_CASE("agreement: rolling resistance between particles alone, or at walls alone") {
  check_both(check_small<between_particles<small_closed>>("rolling between particles"));
  check_both(check_small<between_particles<impulses>>("rolling between particles, impulse"));
  check_both(check_small<at_walls<small_periodic>>("rolling at walls"));
  check_both(check_small<at_walls<impulses>>("rolling at walls, impulse"));
}

TEST_CASE("agreement: rolling resistance with walls of their own") {
  check_both(check_small<differing<own_walls<forces>>>("rolling, walls of their own, force, leapfrog"));
  check_both(check_small<rolling<own_walls<impulses>>>("rolling, walls of their own, impulse"));
  check_both(check_small<elastic_limit<differing<own_walls<rescaled>>>>("rolling, own walls, elastic limit, rescale"));
  check_both(check_small<rolling<slick_walls<small_closed>>>("rolling, slick walls"));
  check_both(check_small<at_walls<slick_particles<small_closed>>>("rolling at walls, slick particles"));
}

template <class Case>
void check_mixed(const char* what) {
  const Spheres spheres = layered_spheres<Case>(Case::pipe_length / 7, 0.5, Random(seed()));
  check_both(check_after<Case>(spheres, 3000, what, agitated_tolerance<Case>));
}

TEST_CASE("mixed agreement: rolling resistance") {
  check_mixed<in_mixed_precision<rolling<small_periodic>>>("rolling, mixed");
  check_mixed<in_mixed_precision<differing<forces>>>("rolling, mixed, force, leapfrog");
  check_mixed<in_mixed_precision<rolling<impulses>>>("rolling, mixed, impulse");
}

}  // namespace
}  // namespace fixdem::tests
