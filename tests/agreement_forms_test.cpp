// Kernel against reference, the tangential spring: every form of it, both sliders, both integrators.
#include "small_scene.hpp"

namespace fixdem::tests {
namespace {

template <class Base, TangentialLaw form, Slider kind, Integrator scheme = Integrator::euler>
struct with_forms : Base {
  static constexpr TangentialLaw tangential = form;
  static constexpr Slider slider = kind;
  static constexpr Integrator integrator = scheme;
};

TEST_CASE("agreement: displacement form") {
  check_small<with_forms<small_periodic, TangentialLaw::displacement, Slider::clip>>("displacement, clip");
  check_small<with_forms<small_closed, TangentialLaw::displacement, Slider::paper>>("displacement, paper, closed");
}

TEST_CASE("agreement: force form") {
  check_small<with_forms<small_closed, TangentialLaw::force, Slider::clip>>("force, clip, closed");
  check_small<with_forms<small_periodic, TangentialLaw::force, Slider::paper>>("force, paper");
}

TEST_CASE("agreement: rescale form") {
  check_small<with_forms<small_periodic, TangentialLaw::rescale, Slider::clip>>("rescale, clip");
  check_small<with_forms<small_closed, TangentialLaw::rescale, Slider::paper>>("rescale, paper, closed");
}

TEST_CASE("agreement: leapfrog") {
  constexpr auto leapfrog = Integrator::leapfrog;
  check_small<with_forms<small_periodic, TangentialLaw::displacement, Slider::clip, leapfrog>>("leapfrog");
  check_small<with_forms<small_closed, TangentialLaw::rescale, Slider::paper, leapfrog>>("leapfrog, rescale, paper");
  check_small<with_forms<small_closed, TangentialLaw::force, Slider::clip, leapfrog>>("leapfrog, force, closed");
}

}  // namespace
}  // namespace fixdem::tests
