// What follows from the laws of mechanics, whatever the state: action equals reaction, momentum, angular momentum, and
// an energy that is never created (in the rescale form) and always accounted for (the ledger).
#include <algorithm>
#include <cmath>

#include "cases/settle.hpp"
#include "impact_scene.hpp"
#include "small_scene.hpp"

namespace fixdem::tests {
namespace {

/// A cloud of colliding spheres in the middle of a long pipe without walls; it never reaches the periodic ends.
struct cloud : cases::pipe_bed {
  static constexpr int particle_count = 76;
  static constexpr double pipe_length = 0.4;
  static constexpr bool has_wall = false;
  static constexpr double gravity[3] = {0, 0, 0};
};
struct smooth_cloud : cloud {
  static constexpr double friction = 0;
};

struct Momenta {
  double linear[3] = {}, angular[3] = {};
};

template <class Case>
Momenta momenta_of(const Spheres& spheres) {
  using D = Derived<Case>;
  Momenta sum;
  for (const Sphere& s : spheres) {
    const double *x = s.position, *v = s.velocity;
    const double orbital[3] = {x[1] * v[2] - x[2] * v[1], x[2] * v[0] - x[0] * v[2], x[0] * v[1] - x[1] * v[0]};
    for (int c = 0; c < 3; ++c) {
      sum.linear[c] += D::mass * v[c];
      sum.angular[c] += D::mass * orbital[c] + D::moment_of_inertia * s.angular_velocity[c];
    }
  }
  return sum;
}

template <class Case>
Spheres cloud_of_spheres() {
  Spheres spheres = layered_spheres<Case>(0.0103, 0.5, Random(seed()));
  for (Sphere& s : spheres) {
    s.position[2] += 0.18;
    for (int c = 0; c < 2; ++c) s.velocity[c] -= 20 * s.position[c];  // inwards, so that they collide
    s.velocity[2] -= 20 * (s.position[2] - 0.2);
  }
  return spheres;
}

template <class Case>
void check_momenta(double angular_tolerance) {
  enter({Case::name, seed()});
  Simulation<Case>& simulation = kernel<Case>();
  place_all(simulation, cloud_of_spheres<Case>());
  start(simulation);
  const Momenta before = momenta_of<Case>(all_particles(simulation, Case::particle_count));
  int contacts = 0;
  for (int piece = 0; piece < 1000; ++piece) {
    run(simulation, 10);
    contacts += simulation.observe().contacts;
  }
  CHECK(contacts > 300);
  const Momenta after = momenta_of<Case>(all_particles(simulation, Case::particle_count));
  // Scales: what the same particles would have, did none cancel another.
  const double momentum = Case::particle_count * Derived<Case>::mass * 0.5, angular = momentum * 0.02;
  for (int c = 0; c < 3; ++c) {
    // Each kick rounds two velocities to 1e-16 of themselves, some 1e5 times, at random.
    CHECK(std::abs(after.linear[c] - before.linear[c]) < 1e-13 * momentum);
    CHECK(std::abs(after.angular[c] - before.angular[c]) < angular_tolerance * angular);
  }
}

TEST_CASE("property: momentum and angular momentum without walls") {
  check_momenta<smooth_cloud>(1e-12);
  // With friction, eq. (14) puts the tangential force at the radius r, half an overlap outside the middle of the
  // contact: the model itself leaves a torque of overlap times |f_t|, some 1e-3 of the angular momentum exchanged.
  check_momenta<cloud>(1e-3);
}

// ---- energy --------------------------------------------------------------------------------------------------------

template <TangentialLaw form>
struct elastic_impacts : impact_scene {
  static constexpr double restitution = 1;
  static constexpr TangentialLaw tangential = form;
};

TEST_CASE("property: an elastic impact never gains energy in the rescale form") {
  using Case = elastic_impacts<TangentialLaw::rescale>;
  enter({Case::name, seed()});
  static Simulation<Case> simulation;
  for (int scene = 0; scene < 10; ++scene) {
    const Spheres before = oblique_impacts<Case>(Random(seed() + scene));
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

/// One contact led around a closed way of overlap and tangential displacement, from and to first touch; no slip, no
/// damping. Returns the work that the contact has done, over the maximum elastic energy: above zero it is a source.
template <class Case>
double work_around_cycle(Random& random) {
  using Law = ContactLaw<Case, false>;
  constexpr double deepest = 1e-4;  // m
  constexpr int pieces = 300;
  double corners[6][3] = {};  // two tangential coordinates and the overlap; first and last are zero
  const int count = 4 + static_cast<int>(random(0, 2));
  for (int k = 1; k < count; ++k) {
    corners[k][0] = random(-deepest, deepest), corners[k][1] = random(-deepest, deepest);
    corners[k][2] = random(0.1 * deepest, deepest);
  }
  History<double> history{};
  double work = 0;
  for (int k = 0; k < count; ++k) {
    double step[3];
    for (int c = 0; c < 3; ++c) step[c] = (corners[k + 1 == count ? 0 : k + 1][c] - corners[k][c]) / pieces;
    for (int piece = 1; piece <= pieces; ++piece) {
      const double overlap = std::max(0.0, corners[k][2] + piece * step[2]);
      const Vec3<double> velocity = {step[0] / Case::time_step, step[1] / Case::time_step, step[2] / Case::time_step};
      const ContactBodies<Law, Case, double> bodies(Motion<double>{});
      const Springs<double> springs_now = springs<Law, Case>(spring_base<Law, Case>(overlap, bodies), bodies);
      bool is_done = false;
      const auto f = contact_force<Law, Case, SlidingLanes::computed>(bodies, springs_now, Vec3<double>{0, 0, 1},
                                                                      velocity, velocity.z, velocity.z, Vec3<double>{},
                                                                      overlap > 0, history, is_done);
      work += f.force.x * step[0] + f.force.y * step[1] + f.force.z * step[2];
    }
  }
  return work / (Law::stiffness * std::pow(deepest, 2.5));
}

template <TangentialLaw form>
struct no_slip : elastic_impacts<form> {
  static constexpr double friction = 1e9;
};

TEST_CASE("property: closed cycles never create energy in the rescale form, and do in the others") {
  enter({no_slip<TangentialLaw::rescale>::name, seed()});
  constexpr int cycles = 2000;
  Random random(seed());
  int sources = 0, sources_displacement = 0, sources_force = 0;
  for (int k = 0; k < cycles; ++k) {
    sources += work_around_cycle<no_slip<TangentialLaw::rescale>>(random) > 1e-12;
    sources_displacement += work_around_cycle<no_slip<TangentialLaw::displacement>>(random) > 1e-4;
    sources_force += work_around_cycle<no_slip<TangentialLaw::force>>(random) > 1e-4;
  }
  CHECK(sources == 0);
  CHECK(sources_displacement > cycles / 10);  // known of these forms; and the test can see it
  CHECK(sources_force > cycles / 10);
}

/// What there is too much of (above zero) or too little in the balance, over the energy that was given.
double imbalance(const Energy& energy, double start) {
  const double spent = energy.dissipated_damping + energy.dissipated_sliding;
  const double given = start + energy.gravity_work + energy.gas_work;
  return (energy.kinetic + energy.elastic + spent - energy.made_by_law - given) / given;
}

template <class Base, int nanoseconds>
struct step_of : Base {
  static constexpr double time_step = nanoseconds * 1e-9;
};
struct linear_impacts : impact_scene {
  static constexpr NormalLaw normal = NormalLaw::linear;
  static constexpr double youngs_modulus = 0, poisson_ratio = 0, wall_youngs_modulus = 0, wall_poisson_ratio = 0;
  static constexpr double normal_stiffness = 4e5, tangential_stiffness = 3e5, restitution = 0.9;
};
struct head_on : linear_impacts {
  static constexpr double friction = 0;
};
struct head_on_impulse : head_on {
  static constexpr Integrator integrator = Integrator::impulse;
};
struct smooth_impacts : impact_scene {
  static constexpr double restitution = 0.7, friction = 0;
};
template <TangentialLaw form>
struct rough_impacts : impact_scene {
  static constexpr double restitution = 0.7;
  static constexpr TangentialLaw tangential = form;
};
struct paper_impacts : rough_impacts<TangentialLaw::displacement> {
  static constexpr Slider slider = Slider::paper;
};
struct leapfrog_impacts : rough_impacts<TangentialLaw::displacement> {
  static constexpr Integrator integrator = Integrator::leapfrog;
};
struct exact_impacts : rough_impacts<TangentialLaw::displacement> {
  static constexpr Integrator integrator = Integrator::impulse;
  static constexpr Slider slider = Slider::exact;
};

template <class Case>
double impact_imbalance(double* made_by_law = nullptr) {
  enter({Case::name, seed()});
  static Simulation<Case> simulation;
  Spheres spheres = oblique_impacts<Case>(Random(seed()));
  if (Case::friction == 0) {
    for (Sphere& s : spheres) s.angular_velocity[0] = s.angular_velocity[1] = s.angular_velocity[2] = 0;
  }
  place_all(simulation, spheres);
  start(simulation);
  run(simulation, static_cast<long long>(5e-4 / Case::time_step));
  const Energy energy = simulation.energy();
  if (Case::restitution < 1) CHECK(energy.dissipated_damping > 0);
  if (Case::friction > 0) CHECK(energy.dissipated_sliding > 0);
  CHECK(energy.elastic == 0);  // all have parted
  const double start_energy = kinetic_energy<Case>(spheres, 0, Case::particle_count);
  if (made_by_law != nullptr) *made_by_law = energy.made_by_law / start_energy;
  return imbalance(energy, start_energy);
}

/// At 2 us the balance closes to `bound`, and at a quarter of the step at least `gain` times better.
template <class Case>
void check_balance_converges(double bound, double gain) {
  const double coarse = std::abs(impact_imbalance<step_of<Case, 2000>>());
  const double fine = std::abs(impact_imbalance<step_of<Case, 500>>());
  CAPTURE(coarse);
  CAPTURE(fine);
  CHECK(coarse < bound);
  CHECK(fine < coarse / gain);
}

TEST_CASE("property: the energy ledger of head-on impacts balances, the better the smaller the step") {
  check_balance_converges<head_on>(1e-4, 8);
  check_balance_converges<head_on_impulse>(1e-4, 8);
  check_balance_converges<smooth_impacts>(5e-4, 2);
}

TEST_CASE("property: the energy ledger of impacts balances with every tangential form, slider and integrator") {
  check_balance_converges<linear_impacts>(1e-3, 2);
  check_balance_converges<rough_impacts<TangentialLaw::displacement>>(1e-3, 2);
  check_balance_converges<rough_impacts<TangentialLaw::force>>(1e-3, 2);
  check_balance_converges<rough_impacts<TangentialLaw::rescale>>(1e-3, 2);
  check_balance_converges<paper_impacts>(1e-3, 2);
  check_balance_converges<leapfrog_impacts>(1e-3, 2);
  check_balance_converges<exact_impacts>(1e-3, 2);
}

TEST_CASE("property: what the tangential law makes or loses stands in the ledger") {
  // With Hertz, a tangential spring whose stiffness follows the overlap takes up or gives off energy: up to 1 %.
  double displacement = 0, force = 0, rescale = 0;
  impact_imbalance<rough_impacts<TangentialLaw::displacement>>(&displacement);
  impact_imbalance<rough_impacts<TangentialLaw::force>>(&force);
  impact_imbalance<rough_impacts<TangentialLaw::rescale>>(&rescale);
  for (const double made : {displacement, force, rescale}) {
    CHECK(std::abs(made) < 0.01);
    CHECK(std::abs(made) > 1e-5);
  }
  CHECK(rescale < 0);
}

struct settle_rescale : cases::settle {
  static constexpr TangentialLaw tangential = TangentialLaw::rescale;
};

/// Imbalance while Table 1 settles, 0.2 s.
template <class Case>
double settling_imbalance() {
  enter({Case::name, seed()});
  static Simulation<Case> simulation;
  const Spheres spheres = random_spheres<Case>(0.5, Random(seed()));
  place_all(simulation, spheres);
  start(simulation);
  const double begin = kinetic_energy<Case>(spheres, 0, Case::particle_count);
  run(simulation, 100000);
  const Energy energy = simulation.energy();
  CAPTURE(begin);
  CHECK(energy.kinetic < 0.02 * begin);
  CHECK(energy.gravity_work > 0);
  CHECK(energy.dissipated_damping > 0);
  CHECK(energy.dissipated_sliding > 0);
  return imbalance(energy, begin);
}

TEST_CASE("property: the energy ledger while Table 1 settles") {
  CHECK(std::abs(settling_imbalance<cases::settle>()) < 2e-3);
  CHECK(std::abs(settling_imbalance<settle_rescale>()) < 2e-3);
}

}  // namespace
}  // namespace fixdem::tests
