// The critical time step of a spring network (tools/stability/tangent.hpp), where it is known: single particles at a
// wall.
#include "tools/stability/tangent.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "tools/run/step_criteria.hpp"

using namespace fixdem;
using fixdem::stability::Spring, fixdem::stability::SpringNetwork, fixdem::stability::critical_step;

namespace {

constexpr double mass = 5e-4;  // kg

/// A particle on a wall below it, without friction.
Spring on_wall(int particle, double stiffness, double damping) {
  return {particle, -1, {0, -1, 0}, {stiffness, 0, damping, 0}};
}

/// 4 m = h^2 k + a h c
double limit(double stiffness, double damping, const program::StepCriterion& criterion) {
  const double c = criterion.normal_damping * damping;
  return 8 * mass / (c + std::sqrt(c * c + 16 * stiffness * mass));
}

}  // namespace

TEST_CASE("tangent: one particle on a wall, with and without damping") {
  for (const auto& criterion : program::step_criteria)
    for (const double damping : {0.0, 3.0, 50.0}) {
      const SpringNetwork one{1, mass, {on_wall(0, 1e6, damping)}};
      CHECK(critical_step(one, criterion) == doctest::Approx(limit(1e6, damping, criterion)).epsilon(1e-6));
    }
  CHECK(stability::undamped_critical_step({1, mass, {on_wall(0, 1e6, 5)}}, stability::Springs::all) ==
        doctest::Approx(2 * std::sqrt(mass / 1e6)).epsilon(1e-6));
}

TEST_CASE("tangent: the stiffest particle is not always the one that limits the step") {
  // The second is softer than the first, but damped, by so much that it needs a step 1 or 30 % smaller.
  for (const auto& criterion : program::step_criteria)
    for (const double share : {0.99, 0.7}) {
      const double step = share * limit(1e6, 0, criterion);
      const double damping = (4 * mass - step * step * 5e5) / (step * criterion.normal_damping);
      const SpringNetwork two{2, mass, {on_wall(0, 1e6, 0), on_wall(1, 5e5, damping)}};
      CHECK(critical_step(two, criterion) == doctest::Approx(step).epsilon(1e-6));
    }
}
