// Kernel against reference in an open line: feed, outlet and gas with integrators, precision, laws and sizes.
#include "agreement_line.hpp"

#include "mixed.hpp"

namespace fixdem::tests {
namespace {

template <class Base>
struct leapfrog : Base {
  static constexpr Integrator integrator = Integrator::leapfrog;
};
template <class Base>
struct impulse : Base {
  static constexpr Integrator integrator = Integrator::impulse;
  static constexpr Slider slider = Slider::exact;
};
template <class Base>
struct rolling : Base {
  static constexpr double rolling_friction = 0.1, wall_rolling_friction = 0.2;
};
template <class Base>
struct without_gas : Base {
  static constexpr bool has_gas = false;
};
template <class Base>
struct rescaled_force : Base {
  static constexpr TangentialLaw tangential = TangentialLaw::rescale;
};
struct plain_line : short_line {};
// In some scenes a grazing impact makes more of a difference. Series for means of powers round more than other sums.
template <class Case>
inline constexpr double wider_tolerance = 10 * position_tolerance<Case>;
template <class Case>
inline constexpr double wider_agitated_tolerance = 30 * agitated_tolerance<Case>;
using two_species = in_two_species<short_line>;

TEST_CASE("agreement: a line with gas") { check_line<plain_line>("line"); }
TEST_CASE("agreement: a line without gas") { check_line<without_gas<rescaled_force<plain_line>>>("line, no gas"); }
TEST_CASE("agreement: a line, leapfrog") { check_line<leapfrog<plain_line>>("line, leapfrog"); }
TEST_CASE("agreement: a line, impulse") {
  check_line<impulse<plain_line>>("line, impulse", wider_tolerance<impulse<plain_line>>);
}
TEST_CASE("agreement: a line in mixed precision") {
  check_line<in_mixed_precision<plain_line>>("line, mixed", wider_agitated_tolerance<in_mixed_precision<plain_line>>);
}
TEST_CASE("agreement: a line, rolling resistance") {
  const Events events = check_line<rolling<plain_line>>("line, rolling");
  CHECK(events.rolling > 0);
  CHECK(events.held > 0);
}
TEST_CASE("agreement: a line of two species") {
  check_line<two_species>("line, two species");
  using rolling_impulse = impulse<rolling<two_species>>;
  check_line<rolling_impulse>("line, two species, rolling, impulse", wider_tolerance<rolling_impulse>);
}
TEST_CASE("agreement: a plug leaves a line") {
  check_plug_leaves<plain_line>("line, plug");
  using rescaled = without_gas<rescaled_force<plain_line>>;
  check_plug_leaves<rescaled>("line, plug, no gas, rescale", wider_tolerance<rescaled>);
  check_plug_leaves<rolling<plain_line>>("line, plug, rolling");
  using rolling_impulse = impulse<rolling<plain_line>>;
  check_plug_leaves<rolling_impulse>("line, plug, rolling, impulse", wider_tolerance<rolling_impulse>);
}

}  // namespace
}  // namespace fixdem::tests
