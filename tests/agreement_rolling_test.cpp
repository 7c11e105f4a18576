// Kernel against reference with rolling resistance: tangential forms, sliders, integrators, normal laws, gas.
#include "small_gas_scene.hpp"

namespace fixdem::tests {
namespace {

template <class Base>
struct rolling : Base {
  static constexpr double rolling_friction = 0.5;
};
template <class Base, TangentialLaw form, Slider kind, Integrator scheme>
struct with : rolling<Base> {
  static constexpr TangentialLaw tangential = form;
  static constexpr Slider slider = kind;
  static constexpr Integrator integrator = scheme;
};
template <class Base>
struct elastic_limit : Base {
  static constexpr FrictionLimit friction_limit = FrictionLimit::elastic;
};
template <class Base>
struct linear : Base {
  static constexpr NormalLaw normal = NormalLaw::linear;
  static constexpr double normal_stiffness = 1e6, tangential_stiffness = 5e5;
};
template <class Base>
struct critical : linear<Base> {
  static constexpr Damping damping = Damping::critical;
  static constexpr double normal_stiffness = 2e5, tangential_stiffness = 1.3e5;
};

void check_both(const Events& events) {
  CHECK(events.rolling > 0);
  CHECK(events.held > 0);
  CHECK(events.compared > 0);
}

template <class Case>
void check_rolling(const char* what) {
  check_both(check_small<Case>(what));
}

using enum TangentialLaw;
using enum Slider;
using enum Integrator;

TEST_CASE("agreement: rolling resistance, euler") {
  check_rolling<with<small_periodic, displacement, clip, euler>>("rolling");
  check_rolling<with<small_closed, displacement, paper, euler>>("rolling, paper, closed");
  check_rolling<with<small_closed, force, exact, euler>>("rolling, force, exact, closed");
  check_rolling<with<small_periodic, rescale, clip, euler>>("rolling, rescale");
}

TEST_CASE("agreement: rolling resistance, leapfrog") {
  check_rolling<with<small_closed, displacement, exact, leapfrog>>("rolling, leapfrog, exact, closed");
  check_rolling<with<small_periodic, force, clip, leapfrog>>("rolling, leapfrog, force");
  check_rolling<with<small_closed, rescale, paper, leapfrog>>("rolling, leapfrog, rescale, paper, closed");
}

TEST_CASE("agreement: rolling resistance, impulse") {
  check_rolling<with<small_closed, displacement, exact, impulse>>("rolling, impulse, exact, closed");
  check_rolling<elastic_limit<with<small_periodic, displacement, clip, impulse>>>("rolling, impulse, elastic limit");
  check_rolling<with<small_periodic, force, clip, impulse>>("rolling, impulse, force");
  check_rolling<with<small_closed, rescale, exact, impulse>>("rolling, impulse, rescale, exact, closed");
}

TEST_CASE("agreement: rolling resistance with the linear law") {
  check_rolling<linear<with<small_closed, displacement, clip, euler>>>("rolling, linear, closed");
  check_rolling<critical<with<small_periodic, force, clip, leapfrog>>>("rolling, linear, critical, leapfrog, force");
  check_rolling<linear<with<small_periodic, rescale, clip, impulse>>>("rolling, linear, impulse, rescale");
}

TEST_CASE("agreement: rolling resistance with gas") { check_both(check_dense<rolling<small_gas>>("rolling, gas")); }

}  // namespace
}  // namespace fixdem::tests
