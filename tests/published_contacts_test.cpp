// Published tests of single contacts whose figures are closed forms: Chung & Ooi (2011), tests 5 to 7, MFIX DEM02 and
// DEM04. By impulses, friction limited by the elastic force.
//
// The figures of tests 5 and 6 are ratios to mu v_n and hold for any sphere while it slides throughout, so that here
// one sphere stands for the paper's materials; below that, where it sticks for a while, they are those of an adaptive
// integration of the law for this sphere (tools/frontier/exact_impact.hpp).
#include "cases/collide_wall.hpp"
#include "kernel/fixdem.hpp"
#include "mfix_scenes.hpp"
#include "recorded.hpp"
#include "rolling_scenes.hpp"
#include "tools/frontier/exact_impact.hpp"

namespace fixdem::tests {
namespace {

/// Speed along the surface at first touch over mu v_n: from 3.5 (1 + e) = 5.25 on it slides throughout.
constexpr double inclinations[] = {1, 2, 4, 6, 14};
/// Spins of test 7, rad/s.
constexpr double gear_spins[] = {2, 20};

/// Aluminium alloy, R = 0.1 m, at 0.2 m/s along the normal: against a wall from the side (test 5) and turning (test 6),
/// and in pairs that turn like gears (test 7).
struct turning_spheres : cases::collide_wall {
  static constexpr int particle_count = 10 + 4;
  static constexpr double diameter = 0.2, density = 2700, youngs_modulus = 70e9, poisson_ratio = 0.33;
  static constexpr double wall_youngs_modulus = __builtin_inf(), wall_poisson_ratio = 0.33;
  static constexpr double restitution = 0.5, friction = 0.4;
  static constexpr FrictionLimit friction_limit = FrictionLimit::elastic;
  static constexpr Integrator integrator = Integrator::impulse;
  static constexpr Slider slider = Slider::exact;
  static constexpr bool has_wall = false;
  static constexpr Ends ends = Ends::closed;
  static constexpr double pipe_diameter = 1, pipe_length = 8;
  static constexpr double gravity[3] = {0, 0, 0};
  static constexpr double time_step = 4e-7;  // 1/1800 of the contact time
};

constexpr double speed = 0.2, unit = turning_spheres::friction * speed, radius = 0.1;

/// Centre velocity and surface velocity of the spin after an impact, over mu v_n.
struct Ratios {
  double velocity, spin;
};

Ratios expected_ratios(double sliding, double turning) {
  constexpr double taken = 1 + turning_spheres::restitution;
  if (sliding + turning > 3.5 * taken) return {sliding - taken, turning - 2.5 * taken};
  using Scalar = long double;
  const Scalar mass = reference::sphere_properties<turning_spheres, Scalar>().mass;
  frontier::ExactImpact impact(reference::wall_coefficients<turning_spheres, Scalar>(), true,
                               TangentialLaw::displacement, FrictionLimit::elastic, mass, mass, 1e-13L);
  const frontier::Outcome found = impact.solve(speed, sliding * unit, turning * unit);
  return {static_cast<double>(found.tangential) / unit, static_cast<double>(found.surface_spin) / unit};
}

/// Sliding throughout, impulses give Coulomb's impulse to 1e-6 of it at 1/700 of the contact time
/// (gross_sliding_test.cpp), here 4e-6 of mu v_n in the spin: 1e-5 is allowed. Where a contact changes from sticking to
/// sliding they are of first order in the step, some 3e-6 of the speed at 1/2000 (unequal_impacts_test.cpp), which is
/// 1e-5 of mu v_n: twice that is allowed.
void check_ratios(const char* name, double inclination, const Ratios& expected, const Particle& after) {
  const bool slides = inclination > 3.5 * (1 + turning_spheres::restitution);
  const Table table{name, slides ? "closed form (sliding)" : "reference integration"};
  const std::string row = "v_t / (mu v_n) = " + in_words(inclination);
  const double allowed = slides ? 1e-5 : 2e-5;
  check_figure(table, row, {"v_x' / (mu v_n)", ""}, expected.velocity, after.velocity[0] / unit, allowed);
  check_figure(table, row, {"R w' / (mu v_n)", ""}, expected.spin, -radius * after.angular_velocity[1] / unit, allowed);
}

TEST_CASE("published contacts: turning and sliding spheres, Chung & Ooi tests 5 to 7") {
  using Case = turning_spheres;
  enter({Case::name, 0});
  static Simulation<Case> simulation;
  constexpr double d = Case::diameter, gap = 1e-6;
  for (int k = 0; k < 5; ++k) {
    const double along = inclinations[k] * unit;
    simulation.place(k, {{(k - 6) * 4 * d, 0, d / 2 + gap}, {along, 0, -speed}, {0, 0, 0}});
    simulation.place(5 + k, {{k * 4 * d, 0, d / 2 + gap}, {0, 0, -speed}, {0, -along / radius, 0}});
  }
  for (int k = 0; k < 2; ++k) {
    simulation.place(10 + 2 * k, {{k * 4 * d, 0, 20 * d - gap}, {0, 0, speed}, {0, gear_spins[k], 0}});
    simulation.place(11 + 2 * k, {{k * 4 * d, 0, 21 * d + gap}, {0, 0, -speed}, {0, -gear_spins[k], 0}});
  }
  start(simulation);
  run(simulation, static_cast<long long>(2e-3 / Case::time_step));
  for (int k = 0; k < 5; ++k) {
    const double inclination = inclinations[k];
    REQUIRE(simulation.particle(k).position[2] > d / 2);
    REQUIRE(simulation.particle(5 + k).position[2] > d / 2);
    check_ratios("chung-ooi-5", inclination, expected_ratios(inclination, 0), simulation.particle(k));
    check_ratios("chung-ooi-6", inclination, expected_ratios(0, inclination), simulation.particle(5 + k));
  }
  // Equal spheres with opposite spins do not slip: nothing but the normal velocity changes, but for rounding.
  const Table gears{"chung-ooi-7", "closed form (no slip)"};
  for (int k = 0; k < 2; ++k) {
    const Particle after = simulation.particle(10 + 2 * k);
    const std::string row = "spins of " + in_words(gear_spins[k]) + " rad/s";
    check_figure(gears, row, {"angular velocity", "rad/s"}, gear_spins[k], after.angular_velocity[1], 1e-12);
    check_figure(gears, row, {"tangential velocity", "m/s"}, 0, after.velocity[0], 1e-13);
    // Head on: second order in the step, 3e-7 of the speed at 1/430 (unequal_impacts_test.cpp).
    check_figure(gears, row, {"normal velocity", "m/s"}, -Case::restitution * speed, after.velocity[2], 1e-7);
  }
}

/// MFIX DEM02: the ball of DEM01 on a stiffer spring; how high it bounces time after time.
struct bouncing_ball : dropped_ball<90> {
  static constexpr double normal_stiffness = 1e7, tangential_stiffness = 1e7;
  static constexpr Integrator integrator = Integrator::impulse;
  static constexpr double time_step = 1e-5;  // 1/330 of the contact time; falls are exact
};

/// Speed at which a ball leaves a linear spring with its dashpot that it has met at `v`, weight included: the first
/// zero of the closed form of the overlap, by bisection.
double leaving_speed(double v) {
  using Case = bouncing_ball;
  constexpr double pi = Derived<Case>::pi, d = Case::diameter, g = -Case::gravity[2];
  const double mass = Case::density * pi / 6 * d * d * d, omega = std::sqrt(Case::normal_stiffness / mass);
  const double log_e = std::log(Case::restitution), zeta = -log_e / std::hypot(pi, log_e);
  const double decay = zeta * omega, damped = omega * std::sqrt(1 - zeta * zeta);
  const double rest = g / (omega * omega);  // overlap under the weight; x = rest + exp(-decay t) (a cos + b sin)
  const double a = -rest, b = (v + decay * a) / damped;
  double low = pi / damped, high = 1.5 * pi / damped;
  for (int n = 0; n < 100; ++n) {
    const double t = (low + high) / 2, c = std::cos(damped * t), s = std::sin(damped * t);
    (rest + std::exp(-decay * t) * (a * c + b * s) > 0 ? low : high) = t;
  }
  const double c = std::cos(damped * low), s = std::sin(damped * low);
  return -std::exp(-decay * low) * ((b * damped - decay * a) * c - (a * damped + decay * b) * s);
}

TEST_CASE("published contacts: a bouncing ball, MFIX DEM02") {
  using Case = bouncing_ball;
  enter({Case::name, 0});
  static Simulation<Case> simulation;
  constexpr double r = Case::diameter / 2, fall = 0.4, g = -Case::gravity[2];
  simulation.place(0, {{0, 0, r + fall}, {0, 0, 0}, {0, 0, 0}});
  start(simulation);
  const Table soft{"mfix-dem02", "closed form (spring and dashpot)"}, hard{"mfix-dem02", "closed form (hard sphere)"};
  double v = std::sqrt(2 * g * fall), hard_height = fall;
  for (int bounce = 1; bounce <= 4; ++bounce) {
    v = leaving_speed(v), hard_height *= Case::restitution * Case::restitution;
    double top = 0;
    for (bool rises = false;;) {  // until it falls again
      run(simulation, 1);
      const Particle now = simulation.particle(0);
      if (now.position[2] > r && now.velocity[2] > 0) rises = true;
      if (rises) top = std::max(top, now.position[2] - r);
      if (rises && now.velocity[2] <= 0) break;
      REQUIRE(simulation.step() < 300000);
    }
    // An impulse rebounds to 1e-5 of the speed at 1/41 of the contact time (impulse_test.cpp), 6e-6 m of 0.32 m; the
    // errors of four bounces add up.
    const std::string row = "bounce " + std::to_string(bounce);
    check_figure(soft, row, {"height", "mm"}, 1e3 * v * v / (2 * g), 1e3 * top, 0.02);
    // The published formula is that of a contact without duration, to which a soft one comes near.
    report_figure(hard, row, {"height over that of a hard sphere", ""}, 1, top / hard_height);
  }
}

/// MFIX DEM04: a ball that slides on a plane until it rolls, without rolling resistance. The speed at which it rolls
/// follows from the angular momentum about the point of contact, whatever the spring. The time is that of rigid
/// friction from the first moment on: the spring must first be wound up by 25 nm, in less than a step.
TEST_CASE("published contacts: a ball that slides until it rolls, MFIX DEM04") {
  using Case = on_plane<30, 0, 0, Integrator::impulse, 5000>;
  enter({Case::name, 0});
  static Simulation<Case> simulation;
  constexpr double v = 0.1, slowing = Case::friction * 9.81;
  start_on_plane<Case>(simulation, v, 0);
  const Crossing rolls = run_until_it_rolls<Case>(simulation);
  const Table table{"mfix-dem04", "closed form (rigid sphere)"};
  check_figure(table, "mu = 0.3", {"mu g t / v_0", ""}, 2.0 / 7, slowing * rolls.time / v,
               slowing * Case::time_step / v);
  check_figure(table, "mu = 0.3", {"v / v_0", ""}, 5.0 / 7, rolls.velocity / v, 1e-9);
  run(simulation, 20000);  // the spring, still wound up when it rolls, swings out
  const Particle after = simulation.particle(0);
  check_figure(table, "mu = 0.3, 0.1 s later", {"v / v_0", ""}, 5.0 / 7, after.velocity[0] / v, 1e-9);
  check_figure(table, "mu = 0.3, 0.1 s later", {"R w / v_0", ""}, 5.0 / 7, 0.005 * after.angular_velocity[1] / v, 1e-9);
}

}  // namespace
}  // namespace fixdem::tests
