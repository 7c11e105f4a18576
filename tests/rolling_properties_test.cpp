// What follows from the laws of mechanics with rolling resistance: its torques are equal and opposite, it never gives
// energy where the form of the spring does not, all it takes and makes stands in the ledger, and a pile comes to rest.
#include <algorithm>

#include "impact_scene.hpp"

namespace fixdem::tests {
namespace {

template <class Base>
struct rolling : Base {
  static constexpr double rolling_friction = 0.1;
};

struct Momenta {
  double linear[3] = {}, angular[3] = {};
};

/// Of a pair; angular: about `origin`.
template <class Case>
Momenta momenta_of(const Sphere& a, const Sphere& b, const double* origin) {
  using D = Derived<Case>;
  Momenta sum;
  for (const Sphere* s : {&a, &b}) {
    const double* v = s->velocity;
    double x[3];
    for (int c = 0; c < 3; ++c) x[c] = s->position[c] - origin[c];
    const double orbital[3] = {x[1] * v[2] - x[2] * v[1], x[2] * v[0] - x[0] * v[2], x[0] * v[1] - x[1] * v[0]};
    for (int c = 0; c < 3; ++c) {
      sum.linear[c] += D::mass * v[c];
      sum.angular[c] += D::mass * orbital[c] + D::moment_of_inertia * s->angular_velocity[c];
    }
  }
  return sum;
}

/// Calls f(number, the pair before, the pair after) for each pair that has met.
template <class Case, class F>
void for_each_impact(const Spheres& spheres, F&& f) {
  enter({Case::name, seed()});
  static Simulation<Case> simulation;
  place_all(simulation, spheres);
  start(simulation);
  run(simulation, static_cast<long long>(4e-4 / Case::time_step));
  CHECK(simulation.observe().contacts == 0);
  const Spheres after = all_particles(simulation, Case::particle_count);
  for (int i = wall_impacts; i < Case::particle_count; i += 2) f(&spheres[i], &after[i]);
}

TEST_CASE("rolling: a pair that only rolls on itself exchanges spin, and nothing of it is lost") {
  using Case = rolling<impact_scene>;
  Spheres spheres = oblique_impacts<Case>(Random(seed()));
  for (int i = wall_impacts; i < Case::particle_count; i += 2) {
    Sphere &a = spheres[i], &b = spheres[i + 1];
    double n[3];
    for (int c = 0; c < 3; ++c) n[c] = b.position[c] - a.position[c];
    const double distance = length(n);
    for (int c = 0; c < 3; ++c) {
      n[c] /= distance;
      b.position[c] = a.position[c] + Case::diameter * n[c], b.velocity[c] = a.velocity[c] - n[c];  // meets at once
      b.angular_velocity[c] = -a.angular_velocity[c];
    }
  }
  for_each_impact<Case>(spheres, [](const Sphere* before, const Sphere* after) {
    double n[3], turned[3];
    for (int c = 0; c < 3; ++c) n[c] = before[1].position[c] - before[0].position[c];
    const double distance = length(n);
    for (double& component : n) component /= distance;
    for (int c = 0; c < 3; ++c) {
      turned[c] = after[0].angular_velocity[c] - before[0].angular_velocity[c];
      CHECK(std::abs(after[0].angular_velocity[c] + after[1].angular_velocity[c]) < 1e-9);  // of some 100 rad/s
    }
    CHECK(length(turned) > 1);
    CHECK(std::abs(dot(turned, n)) < 1e-6 * length(turned));  // spin about the normal is not resisted
  });
}

TEST_CASE("rolling: momentum and angular momentum of oblique impacts") {
  using Case = rolling<impact_scene>;
  for_each_impact<Case>(oblique_impacts<Case>(Random(seed())), [](const Sphere* before, const Sphere* after) {
    double middle[3], exchanged[3];
    for (int c = 0; c < 3; ++c) {
      middle[c] = (before[0].position[c] + before[1].position[c]) / 2;
      exchanged[c] = Derived<Case>::mass * (after[0].velocity[c] - before[0].velocity[c]);
    }
    const Momenta first = momenta_of<Case>(before[0], before[1], middle);
    const Momenta last = momenta_of<Case>(after[0], after[1], middle);
    // The model itself leaves a torque of half the overlap times the tangential force on each sphere (eq. 14). Rolling
    // resistance exchanges up to mu_r r/2 times the impulse.
    const double most = 1e-4 * length(exchanged) * Case::friction;
    CHECK(most < 0.2 * Case::rolling_friction * Case::diameter / 4 * length(exchanged));
    for (int c = 0; c < 3; ++c) {
      CHECK(std::abs(last.linear[c] - first.linear[c]) < 1e-13 * Derived<Case>::mass);
      CHECK(std::abs(last.angular[c] - first.angular[c]) < most);
    }
  });
}

// ---- energy --------------------------------------------------------------------------------------------------------

struct elastic_impacts : rolling<impact_scene> {
  static constexpr double restitution = 1;
  static constexpr TangentialLaw tangential = TangentialLaw::rescale;
};

TEST_CASE("rolling: an elastic impact never gains energy in the rescale form") {
  using Case = elastic_impacts;
  enter({Case::name, seed()});
  static Simulation<Case> simulation;
  for (int scene = 0; scene < 10; ++scene) {
    const Spheres before = oblique_impacts<Case>(Random(seed() + static_cast<unsigned long long>(scene)));
    place_all(simulation, before);
    start(simulation);
    run(simulation, 4000);  // 0.4 ms: all have met and parted
    CHECK(simulation.observe().contacts + simulation.observe().wall_contacts == 0);
    const Spheres after = all_particles(simulation, Case::particle_count);
    for (int i = 0; i < Case::particle_count; i += i < wall_impacts ? 1 : 2) {
      const int next = i < wall_impacts ? i + 1 : i + 2;
      const double ratio = kinetic_energy<Case>(after, i, next) / kinetic_energy<Case>(before, i, next);
      CHECK(ratio < 1 + 1e-5);  // the integrator's own error at 1/700 of the contact time
      CHECK(ratio > 0.05);
    }
  }
}

template <TangentialLaw form, Integrator scheme, int step_in_ns>
struct booked_impacts : rolling<impact_scene> {
  static constexpr double restitution = 0.7, time_step = step_in_ns * 1e-9;
  static constexpr TangentialLaw tangential = form;
  static constexpr Integrator integrator = scheme;
};

/// What there is too much of or too little in the balance, over the energy at first.
template <class Case>
double imbalance() {
  enter({Case::name, seed()});
  static Simulation<Case> simulation;
  const Spheres spheres = oblique_impacts<Case>(Random(seed()));
  place_all(simulation, spheres);
  start(simulation);
  run(simulation, static_cast<long long>(5e-4 / Case::time_step));
  const Energy e = simulation.energy();
  CHECK(e.elastic == 0);
  const double before = kinetic_energy<Case>(spheres, 0, Case::particle_count);
  CHECK(e.dissipated_rolling > 1e-3 * before);
  const double spent = e.dissipated_damping + e.dissipated_sliding + e.dissipated_rolling;
  return std::abs(e.kinetic + spent - e.made_by_law - before) / before;
}

template <TangentialLaw form, Integrator scheme>
void check_balance() {
  const double coarse = imbalance<booked_impacts<form, scheme, 2000>>();
  const double fine = imbalance<booked_impacts<form, scheme, 500>>();
  CAPTURE(coarse);
  CHECK(coarse < 1e-3);
  CHECK(fine < coarse / 2);
}

TEST_CASE("rolling: the energy ledger of impacts balances, the better the smaller the step") {
  check_balance<TangentialLaw::displacement, Integrator::euler>();
  check_balance<TangentialLaw::rescale, Integrator::leapfrog>();
  check_balance<TangentialLaw::force, Integrator::impulse>();
}

// ---- rest ----------------------------------------------------------------------------------------------------------

template <Integrator scheme, int step_in_us>
struct pile : cases::collide_wall {
  static constexpr int particle_count = 12;
  static constexpr bool has_wall = true;
  static constexpr double gravity[3] = {0, 0, -9.81};
  static constexpr Integrator integrator = scheme;
  static constexpr double time_step = step_in_us * 1e-6;
};
template <Integrator scheme, int step_in_us>
struct resisting_pile : pile<scheme, step_in_us> {
  static constexpr double rolling_friction = 0.05;
};

/// 1 s after it was dropped into a standing tube: the maximum speed, m/s, that of the surface by spin across the
/// vertical included. Spin about the vertical, which the floor does not resist, may go on.
template <class Case>
double speed_of_pile() {
  enter({Case::name, seed()});
  static Simulation<Case> simulation;
  place_all(simulation, layered_spheres<Case>(0.012, 0.3, Random(seed())));
  start(simulation);
  run(simulation, static_cast<long long>(1 / Case::time_step));
  double speed = 0;
  for (const Sphere& s : all_particles(simulation, Case::particle_count)) {
    const double across = std::hypot(s.angular_velocity[0], s.angular_velocity[1]) * Case::diameter / 2;
    speed = std::max({speed, length(s.velocity), across});
  }
  return speed;
}

TEST_CASE("rolling: particles at the bottom of a tube come to rest") {
  CHECK(speed_of_pile<resisting_pile<Integrator::euler, 5>>() < 1e-12);
  CHECK(speed_of_pile<resisting_pile<Integrator::impulse, 10>>() < 1e-12);
  CHECK(speed_of_pile<pile<Integrator::impulse, 10>>() > 1e-6);  // without rolling resistance some roll on and on
}

}  // namespace
}  // namespace fixdem::tests
