// The exact impacts of `make frontier` (tools/frontier/exact_impact.hpp) where another solution is known: rolling
// resistance on a wall, and friction with the elastic limit that slides from the first touch on.
#include "tools/frontier/exact_impact.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "cases/settle.hpp"

using namespace fixdem;

namespace {

constexpr double radius = 0.005;

template <int tenths>
struct rolling : cases::settle {
  static constexpr double restitution = 0.1 * tenths, friction = 0.3, rolling_friction = 0.1;
};

/// Onto a wall at 1 m/s, with the elastic limit of friction.
template <class Case>
frontier::Outcome onto_wall(long double tangential, long double spin) {
  using Scalar = long double;
  const Scalar mass = reference::sphere_properties<Case, Scalar>().mass;
  frontier::ExactImpact impact(reference::wall_coefficients<Case, Scalar>(), true, TangentialLaw::displacement,
                               FrictionLimit::elastic, mass, mass, 1e-13L);
  return impact.solve(1, tangential, radius * spin);
}

template <class Case>
void check_spin(double before, double after, double tangential) {
  const frontier::Outcome found = onto_wall<Case>(0, before);
  CAPTURE(before);
  CHECK(std::abs(static_cast<double>(found.surface_spin) / radius - after) < 2e-8);
  CHECK(std::abs(static_cast<double>(found.tangential) + tangential) < 1e-10);
  CHECK(std::abs(static_cast<double>(found.normal) - Case::restitution) < 1e-10);
}

}  // namespace

TEST_CASE("exact impacts: rolling resistance agrees with an event-driven solution of its own") {
  check_spin<rolling<9>>(10, -4.94387998, -0.0049761888);
  check_spin<rolling<9>>(50, -1.60420093, 0.0461362757);
  check_spin<rolling<9>>(200, 39.58764243, 0.1641822488);
  check_spin<rolling<5>>(10, -1.10205101, -0.0076613671);
  check_spin<rolling<5>>(50, 5.41008459, 0.0124103857);
  check_spin<rolling<5>>(200, 35.70963048, 0.1785807390);
}

TEST_CASE("exact impacts: what slides and rolls throughout takes Coulomb's impulses") {
  // dw = -(5/2) (1 + e) (v/r) (mu + mu_r), and mu (1 + e) v of the centre.
  check_spin<rolling<9>>(800, 800 - 2.5 * 1.9 / radius * 0.4, 0.3 * 1.9);
  check_spin<rolling<5>>(800, 800 - 2.5 * 1.5 / radius * 0.4, 0.3 * 1.5);
  const frontier::Outcome steep = onto_wall<cases::settle>(6, 0);
  CHECK(std::abs(static_cast<double>(steep.tangential) - (6 - 0.3 * 1.9)) < 1e-10);
}
