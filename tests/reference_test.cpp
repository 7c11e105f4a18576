// The reference held against the world: figures from outside the project, before it is used to judge the kernel.
#include "reference/reference.hpp"

#include <utility>

#include "chung_ooi_scenes.hpp"
#include "mfix_scenes.hpp"
#include "restitution_scenes.hpp"

namespace fixdem::tests {
namespace {

template <class Case>
using ReferenceProgram = reference::Reference<Case, double>;

/// Restitution of the scaled equation of motion, eq. (30), in its form in time: x'' = -(5/4) x^1.5 - sqrt(5/4) alpha
/// x^0.25 x', x(0) = 0, x'(0) = 1, until x = 0 again. Classical Runge-Kutta; the kinks at both ends make it about
/// first order, so the step is tiny.
double restitution_of(double alpha) {
  const auto acceleration = [alpha](double x, double v) {
    x = std::max(x, 0.0);
    return -1.25 * x * std::sqrt(x) - std::sqrt(1.25) * alpha * std::sqrt(std::sqrt(x)) * v;
  };
  constexpr double h = 2e-5;
  double x = 0, v = 1;
  for (;;) {
    const double a1 = acceleration(x, v), v2 = v + h / 2 * a1;
    const double a2 = acceleration(x + h / 2 * v, v2), v3 = v + h / 2 * a2;
    const double a3 = acceleration(x + h / 2 * v2, v3), v4 = v + h * a3;
    const double a4 = acceleration(x + h * v3, v4);
    x += h / 6 * (v + 2 * v2 + 2 * v3 + v4);
    v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
    if (x <= 0) return -v;
  }
}

template <int... permille>
void check_all_restitutions(std::integer_sequence<int, permille...>) {
  (check_restitution<ReferenceProgram, impacts<permille, Integrator::euler>>(), ...);
  (check_restitution<ReferenceProgram, impacts<permille, Integrator::leapfrog>>(), ...);
}

TEST_CASE("reference: the damping constant is the solution of eq. (30)") {
  for (double e : {0.1, 0.2, 0.4, 0.5, 0.6, 0.8, 0.9, 1.0}) {
    CAPTURE(e);
    CHECK(std::abs(restitution_of(reference::damping_constant(e)) - e) < 1e-5);
  }
  CHECK(std::abs(reference::damping_constant(0.9) - 0.07495) < 1e-5);
  CHECK(std::abs(reference::damping_constant(0.5) - 0.48177) < 1e-5);
  CHECK(std::abs(reference::damping_constant(0.2) - 1.01953) < 1e-5);
}

TEST_CASE("reference: impacts return the restitution asked") {
  check_all_restitutions(std::integer_sequence<int, 100, 200, 400, 600, 800, 900, 1000>{});
  check_restitution<ReferenceProgram, impacts<500, Integrator::leapfrog, large_aluminium>>();
  check_restitution<ReferenceProgram, impacts<500, Integrator::leapfrog, small_rubber>>();
}

TEST_CASE("reference: elastic normal impacts, Chung & Ooi tests 1 and 2") { check_normal_impacts<ReferenceProgram>(); }

TEST_CASE("reference: oblique impacts, Chung & Ooi test 4") { check_oblique_impacts<ReferenceProgram>(); }

TEST_CASE("reference: a ball dropped on a linear spring, MFIX DEM01") { check_dropped_balls<ReferenceProgram>(); }

TEST_CASE("reference: a grain in rising gas, MFIX DEM06") { check_grain_in_gas<ReferenceProgram>(); }

}  // namespace
}  // namespace fixdem::tests
