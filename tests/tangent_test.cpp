// The critical time step of a spring network (tools/stability/tangent.hpp), where it is known: single particles at a
// wall, and two that touch; and that it is never below the bound that programs watch.
#include "tools/stability/tangent.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "tools/run/step_criteria.hpp"

using namespace fixdem;
using fixdem::stability::Spring, fixdem::stability::SpringNetwork, fixdem::stability::critical_step;

namespace {

constexpr double mass = 5e-4;  // kg

/// With tangential springs as stiff as the normal one, and rolling springs like them or none.
Spring sticking(int owner, int partner, double stiffness, double damping, bool rolls) {
  const double k = rolls ? stiffness : 0, c = rolls ? damping : 0;
  return {owner, partner, {0.6, 0, -0.8}, {stiffness, stiffness, damping, damping, k, c}};
}

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

TEST_CASE("tangent: rolling springs act on the turning of a sphere on a wall, and not on two that slip alike") {
  const auto undamped = [](const SpringNetwork& network) {
    return stability::undamped_critical_step(network, stability::Springs::all);
  };
  const double unit = 2 * std::sqrt(mass / 1e6);
  const SpringNetwork slips{1, mass, {sticking(0, -1, 1e6, 0, false)}}, rolls{1, mass, {sticking(0, -1, 1e6, 0, true)}};
  CHECK(undamped(slips) == doctest::Approx(unit / std::sqrt(3.5)).epsilon(1e-6));
  CHECK(undamped(rolls) == doctest::Approx(unit / std::sqrt(3 + std::sqrt(6.5))).epsilon(1e-6));
  for (const bool rolling : {false, true}) {
    const SpringNetwork pair{2, mass, {sticking(0, 1, 1e6, 0, rolling)}};
    CHECK(undamped(pair) == doctest::Approx(unit / std::sqrt(7)).epsilon(1e-6));
  }
  // Damped: 4 m = root (h^2 k + a h c) along the stiffest motion.
  const double root = 3 + std::sqrt(6.5);
  for (const auto& criterion : program::step_criteria) {
    const double c = root * criterion.tangential_damping * 3, k = root * 1e6;
    const SpringNetwork damped{1, mass, {sticking(0, -1, 1e6, 3, true)}};
    CHECK(critical_step(damped, criterion) ==
          doctest::Approx(8 * mass / (c + std::sqrt(c * c + 16 * k * mass))).epsilon(1e-6));
  }
}

TEST_CASE("tangent: with rolling springs the bound that programs watch stays below the critical step") {
  program::CaseFacts facts{};
  facts.particle_count = 3, facts.mass = mass, facts.normal = NormalLaw::linear, facts.time_step = 1e-6;
  facts.pair_contact = facts.wall_contact = {1e6, 8e5, 2, 2, 0.3, 0.9, 0.05};
  // A corner: one sphere on two walls, one beside and one above it.
  const auto touching = [](int owner, int partner, double x, double y) {
    Contact c{};
    c.owner = owner, c.partner = partner, c.overlap = 1e-6, c.normal[0] = x, c.normal[1] = y;
    return c;
  };
  const std::vector<Contact> corner = {touching(0, -1, 0, -1), touching(0, -2, -1, 0), touching(0, 1, 1, 0),
                                       touching(1, -1, 0, -1), touching(0, 2, 0, 1),   touching(1, 2, -0.6, 0.8)};
  for (const auto& criterion : program::step_criteria) {
    const double exact = critical_step(stability::network_of(facts, corner), criterion);
    const double bound = program::stable_step(facts, criterion, corner).seconds;
    CHECK(bound <= exact);
    CHECK(bound > 0.65 * exact);
    facts.pair_contact.rolling_friction = facts.wall_contact.rolling_friction = 0;
    CHECK(program::stable_step(facts, criterion, corner).seconds > bound);
    facts.pair_contact.rolling_friction = facts.wall_contact.rolling_friction = 0.05;
  }
}
