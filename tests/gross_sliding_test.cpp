// Impacts that slide from beginning to end: what friction takes of the tangential velocity.
#include "impact_scene.hpp"
#include "recorded.hpp"

namespace fixdem::tests {
namespace {

template <int tenths>
struct sliding_impact : impact_scene {
  static constexpr double restitution = 0.1 * tenths, friction = 0.01;
};

template <int tenths>
struct elastic_sliding : sliding_impact<tenths> {
  static constexpr FrictionLimit friction_limit = FrictionLimit::elastic;
};
struct elastic_impulse : elastic_sliding<2> {
  static constexpr Integrator integrator = Integrator::impulse;
  static constexpr Slider slider = Slider::exact;
};

/// Change of tangential velocity at the wall over mu (1 + e) v, which it would be if friction acted under repulsion
/// only.
template <class Case>
double share_of_coulomb() {
  enter({Case::name, seed()});
  static Simulation<Case> simulation;
  Spheres spheres = oblique_impacts<Case>(Random(seed()));
  Sphere& s = spheres[0];
  s.velocity[0] = 1, s.velocity[1] = 0, s.velocity[2] = -1;
  for (double& w : s.angular_velocity) w = 0;
  s.position[2] = Case::diameter / 2 + 1e-5;
  place_all(simulation, spheres);
  start(simulation);
  run(simulation, static_cast<long long>(3e-4 / Case::time_step));
  const auto after = simulation.particle(0);
  return (1 - after.velocity[0]) / (Case::friction * (1 + after.velocity[2]));
}

constexpr Quantity share{"impulse over mu (1 + e) m v", ""};

TEST_CASE("gross sliding: the cap mu |f_n| also acts while f_n attracts at the end of a contact") {
  // Integral of |f_n| over that of f_n for m x'' + eta x^(1/4) x' + K x^(3/2) = 0, by a Runge-Kutta program.
  const Table table{"gross-sliding", "reference integration"};
  check_figure(table, "total force, e = 0.5", share, 1.06704, share_of_coulomb<sliding_impact<5>>(), 1e-3);
  check_figure(table, "total force, e = 0.9", share, 1.00213, share_of_coulomb<sliding_impact<9>>(), 2e-4);
}

TEST_CASE("gross sliding: limited by the elastic force it takes Coulomb's impulse, whatever the restitution") {
  const Table table{"gross-sliding", "closed form (Coulomb)"};
  check_figure(unrecorded, "elastic force, e = 0.2", share, 1, share_of_coulomb<elastic_sliding<2>>(), 2e-3);
  check_figure(unrecorded, "elastic force, e = 0.5", share, 1, share_of_coulomb<elastic_sliding<5>>(), 1e-3);
  check_figure(table, "elastic force, e = 0.9", share, 1, share_of_coulomb<elastic_sliding<9>>(), 2e-4);
  check_figure(table, "elastic force, e = 0.2, impulses", share, 1, share_of_coulomb<elastic_impulse>(), 1e-6);
}

}  // namespace
}  // namespace fixdem::tests
