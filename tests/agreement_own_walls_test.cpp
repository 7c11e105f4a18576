// Kernel against reference (mixed precision: own_walls_test.cpp): walls with friction and restitution of their own, and
// the elastic limit of friction.
#include "small_scene.hpp"

namespace fixdem::tests {
namespace {

template <class Base>
struct own_walls : Base {
  static constexpr double wall_friction = 0.1, wall_restitution = 0.5;
};
/// Particles rotate, but nothing turns them at the walls.
template <class Base>
struct slick_walls : Base {
  static constexpr double wall_friction = 0;
};
/// Only the walls turn particles.
template <class Base>
struct slick_particles : Base {
  static constexpr double friction = 0, wall_friction = 0.4;
};
template <class Base>
struct elastic_limit : Base {
  static constexpr FrictionLimit friction_limit = FrictionLimit::elastic;
};

struct rescaled : small_closed {
  static constexpr TangentialLaw tangential = TangentialLaw::rescale;
};
struct forces : small_periodic {
  static constexpr TangentialLaw tangential = TangentialLaw::force;
  static constexpr Integrator integrator = Integrator::leapfrog;
};
struct impulses : small_closed {
  static constexpr Slider slider = Slider::exact;
  static constexpr Integrator integrator = Integrator::impulse;
};
struct exact : small_periodic {
  static constexpr Slider slider = Slider::exact;
};
struct linear : small_closed {
  static constexpr NormalLaw normal = NormalLaw::linear;
  static constexpr double normal_stiffness = 1e6, tangential_stiffness = 5e5;
};

TEST_CASE("agreement: walls of their own") {
  check_small<own_walls<small_periodic>>("walls of their own");
  check_small<own_walls<rescaled>>("walls of their own, rescale");
  check_small<own_walls<forces>>("walls of their own, force, leapfrog");
  check_small<own_walls<impulses>>("walls of their own, impulse");
  check_small<own_walls<linear>>("walls of their own, linear");
}

TEST_CASE("agreement: friction at the walls alone, or between particles alone") {
  check_small<slick_walls<small_closed>>("slick walls");
  check_small<slick_walls<impulses>>("slick walls, impulse");
  check_small<slick_particles<small_closed>>("slick particles");
  check_small<slick_particles<forces>>("slick particles, force, leapfrog");
  check_small<slick_particles<impulses>>("slick particles, impulse");
}

TEST_CASE("agreement: friction limited by the elastic force") {
  check_small<elastic_limit<small_periodic>>("elastic limit");
  check_small<elastic_limit<own_walls<rescaled>>>("elastic limit, walls of their own, rescale");
  check_small<elastic_limit<forces>>("elastic limit, force, leapfrog");
  check_small<elastic_limit<exact>>("elastic limit, exact");
  check_small<elastic_limit<impulses>>("elastic limit, impulse");
}

}  // namespace
}  // namespace fixdem::tests
