// What follows from the laws of mechanics with particles of several sizes: momentum, and an energy that is never
// created (in the rescale form) and always accounted for.
#include <algorithm>
#include <cmath>

#include "sized_impacts.hpp"

namespace fixdem::tests {
namespace {

TEST_CASE("sizes: momentum and angular momentum of oblique impacts") {
  using Case = sized_impacts;
  const Spheres before = oblique_impacts<Case>(Random(seed())), after = after_impacts<Case>(before);
  for (int i = wall_impacts; i < Case::particle_count; i += 2) {
    double linear[3] = {}, angular[3] = {}, most = 0;  // changes; what is exchanged
    const double total = mass_of<Case>(i) + mass_of<Case>(i + 1);
    double middle[3] = {};
    for (int id = i; id < i + 2; ++id)
      for (int c = 0; c < 3; ++c) middle[c] += mass_of<Case>(id) / total * before[id].position[c];
    const auto add = [&](const Sphere& s, int id, double sign) {
      const double m = mass_of<Case>(id), r = radius_of<Case>(id), *v = s.velocity;
      double x[3];
      for (int c = 0; c < 3; ++c) x[c] = s.position[c] - middle[c];
      const double orbital[3] = {x[1] * v[2] - x[2] * v[1], x[2] * v[0] - x[0] * v[2], x[0] * v[1] - x[1] * v[0]};
      for (int c = 0; c < 3; ++c) {
        linear[c] += sign * m * v[c];
        angular[c] += sign * m * (orbital[c] + 0.4 * r * r * s.angular_velocity[c]);
      }
    };
    for (int id = i; id < i + 2; ++id) {
      add(before[id], id, -1), add(after[id], id, 1);
      for (int c = 0; c < 3; ++c)
        most = std::max(most, mass_of<Case>(id) * std::abs(after[id].velocity[c] - before[id].velocity[c]));
    }
    CAPTURE(i);
    CHECK(most > 0);
    for (int c = 0; c < 3; ++c) {
      CHECK(std::abs(linear[c]) < 1e-13 * total);
      // Tangential forces act at the full radii (eq. 44): a torque of the overlap, up to some 0.1 mm, times the force.
      CHECK(std::abs(angular[c]) < 1e-4 * most);
    }
  }
}

struct elastic_impacts : sized_impacts {
  static constexpr double restitution = 1, rolling_friction = 0.1;
  static constexpr TangentialLaw tangential = TangentialLaw::rescale;
};

TEST_CASE("sizes: an elastic impact never gains energy in the rescale form") {
  using Case = elastic_impacts;
  for (int scene = 0; scene < 10; ++scene) {
    const Spheres before = oblique_impacts<Case>(Random(seed() + static_cast<unsigned long long>(scene)));
    const Spheres after = after_impacts<Case>(before);
    for (int i = 0; i < Case::particle_count; i += i < wall_impacts ? 1 : 2) {
      const int next = i < wall_impacts ? i + 1 : i + 2;
      const double ratio = kinetic_energy<Case>(after, i, next) / kinetic_energy<Case>(before, i, next);
      CHECK(ratio < 1 + 5e-5);  // the integrator's own error at 1/170 of the shortest contact time
      CHECK(ratio > 0.05);
    }
  }
}

template <TangentialLaw form, Integrator scheme, int step_in_ns>
struct booked_impacts : sized_impacts {
  static constexpr double restitution = 0.7, rolling_friction = 0.1, wall_friction = 0.2;
  static constexpr double time_step = step_in_ns * 1e-9;
  static constexpr TangentialLaw tangential = form;
  static constexpr Integrator integrator = scheme;
};

/// What there is too much of or too little in the balance, over the energy at first.
template <class Case>
double imbalance() {
  const Spheres spheres = oblique_impacts<Case>(Random(seed()));
  Energy e;
  after_impacts<Case>(spheres, &e);
  CHECK(e.elastic == 0);
  const double before = kinetic_energy<Case>(spheres, 0, Case::particle_count);
  CHECK(e.dissipated_rolling > 1e-3 * before);
  CHECK(e.dissipated_sliding > 1e-3 * before);
  const double spent = e.dissipated_damping + e.dissipated_sliding + e.dissipated_rolling;
  return std::abs(e.kinetic + spent - e.made_by_law - before) / before;
}

template <TangentialLaw form, Integrator scheme>
void check_balance() {
  const double coarse = imbalance<booked_impacts<form, scheme, 1000>>();
  const double fine = imbalance<booked_impacts<form, scheme, 250>>();
  CAPTURE(coarse);
  CHECK(coarse < 1e-3);
  CHECK(fine < coarse / 2);
}

TEST_CASE("sizes: the energy ledger of impacts balances, the better the smaller the step") {
  check_balance<TangentialLaw::displacement, Integrator::euler>();
  check_balance<TangentialLaw::rescale, Integrator::leapfrog>();
  check_balance<TangentialLaw::force, Integrator::impulse>();
}

}  // namespace
}  // namespace fixdem::tests
