// Rolling resistance on a flat wall and in impacts, written once for the kernel and for the reference.
//
// Expected figures are of an event-driven solution of the same equations (Dormand-Prince, long double, two tolerances
// 2e-9 apart, in impacts 2e-8). Sphere of 10 mm and 1000 kg/m3; friction limited by the elastic force. The wall is the
// end z = 0, and +w about +y rolls towards +x.
#pragma once

#include <cmath>

#include "cases/collide_wall.hpp"
#include "support.hpp"

namespace fixdem::tests {

/// One sphere under gravity on a wall that falls towards +x with the slope `tangent` (in 1e-17), if not level.
template <int friction_percent, int rolling_permille, long long tangent, Integrator scheme, int step_in_ns>
struct on_plane : cases::collide_wall {
  static constexpr double slope = static_cast<double>(tangent) * 1e-17;
  static constexpr double friction = friction_percent / 100.0, rolling_friction = rolling_permille / 1000.0;
  static constexpr FrictionLimit friction_limit = FrictionLimit::elastic;
  static constexpr Integrator integrator = scheme;
  static constexpr double time_step = step_in_ns * 1e-9;
  static constexpr double weight = 9.81 / square_root(1 + slope * slope);
  static constexpr double gravity[3] = {weight * slope, 0, -weight};
};

/// Places the sphere at x = 0 with the overlap of rest, springs at zero, and starts.
template <class Case, class Solver>
void start_on_plane(Solver& solver, double velocity, double spin, double spin_about_normal = 0) {
  const double overlap = 1.015592e-7 / std::cbrt(1 + Case::slope * Case::slope);
  solver.place(0, {{0, 0, 0.005 - overlap}, {velocity, 0, 0}, {0, spin, spin_about_normal}});
  start(solver);
}

/// When and where something has changed its sign, between two steps.
struct Crossing {
  double time, place, velocity;
};

/// Runs step by step until `value(particle)` is below zero; what is sought lies between the last two steps.
template <class Case, class Solver, class Value>
Crossing run_until_below_zero(Solver& solver, Value value) {
  auto before = solver.particle(0);
  while (static_cast<double>(solver.step()) * Case::time_step < 2) {
    run(solver, 1);
    const auto now = solver.particle(0);
    if (value(now) < 0) {
      const double share = value(before) / (value(before) - value(now)), time = share * Case::time_step;
      const double mean = before.velocity[0] + share * (now.velocity[0] - before.velocity[0]) / 2;
      return {static_cast<double>(solver.step() - 1) * Case::time_step + time, before.position[0] + mean * time,
              before.velocity[0] + share * (now.velocity[0] - before.velocity[0])};
    }
    before = now;
  }
  FAIL("it goes on in the same way");
  return {};
}

template <class Case, class Solver>
Crossing run_until_it_stops(Solver& solver) {
  return run_until_below_zero<Case>(solver, [](const auto& p) { return p.velocity[0]; });
}
template <class Case, class Solver>
Crossing run_until_it_rolls(Solver& solver) {
  return run_until_below_zero<Case>(solver,
                                    [](const auto& p) { return p.velocity[0] - 0.005 * p.angular_velocity[1]; });
}

/// Rolling friction 0.1; one sphere above the wall and a pair beside it, no gravity.
template <int tenths, Integrator scheme, int step_in_ns>
struct rolling_impact : cases::collide_wall {
  static constexpr int particle_count = 3;
  static constexpr double restitution = 0.1 * tenths, rolling_friction = 0.1;
  static constexpr FrictionLimit friction_limit = FrictionLimit::elastic;
  static constexpr Integrator integrator = scheme;
  static constexpr double time_step = step_in_ns * 1e-9;
};

/// Spin before and after, rad/s; velocity along the wall after, m/s; work that rolling resistance has taken, J.
struct RollingImpact {
  double spin, spin_after, velocity_after, work;
};

/// The sphere meets the wall at 1 m/s, turning; the pair is left apart. The work is told from the motion alone: with
/// f_t = m dv/dt and I dw/dt = q's torque - r f_t.
template <class Case, class Solver>
RollingImpact impact_on_wall(Solver& solver, double spin) {
  constexpr double r = Case::diameter / 2, m = 1000 * 3.14159265358979324 / 6 * 1e-6, inertia = 0.4 * m * r * r;
  solver.place(0, {{0, 0, r + 1e-6}, {0, 0, -1}, {0, spin, 0}});
  solver.place(1, {{0.1, 0, 0.04}, {0, 0, 0}, {0, 0, 0}});
  solver.place(2, {{0.1, 0, 0.06}, {0, 0, 0}, {0, 0, 0}});
  start(solver);
  auto before = solver.particle(0);
  double work = 0;
  for (double t = 0; t < 1.2e-4; t += Case::time_step) {
    run(solver, 1);
    const auto now = solver.particle(0);
    const double w = before.angular_velocity[1], next_w = now.angular_velocity[1];
    work -= (inertia * (next_w - w) + r * m * (now.velocity[0] - before.velocity[0])) * (w + next_w) / 2;
    before = now;
  }
  const auto energy = solver.energy();
  CHECK(energy.elastic == 0);  // it has left the wall
  const double lost = m / 2 + inertia / 2 * spin * spin - energy.kinetic;
  const double booked = energy.dissipated_damping + energy.dissipated_sliding + energy.dissipated_rolling;
  CHECK(booked - energy.made_by_law == doctest::Approx(lost).epsilon(Case::time_step * 1e4));
  return {spin, before.angular_velocity[1], before.velocity[0], work};
}

/// The pair meets at 1 m/s with opposite spins, so that nothing slips. All that the law makes or loses is then made or
/// lost by the spring of rolling.
template <class Case, class Solver>
RollingImpact impact_of_pair(Solver& solver, double spin) {
  constexpr double r = Case::diameter / 2, gap = 1e-6;
  solver.place(0, {{0, 0, 0.05}, {0, 0, 0}, {0, 0, 0}});
  solver.place(1, {{0.1, 0, 0.05 - r}, {0, 0, 0.5}, {0, spin, 0}});
  solver.place(2, {{0.1, 0, 0.05 + r + gap}, {0, 0, -0.5}, {0, -spin, 0}});
  start(solver);
  run(solver, static_cast<long long>(1.2e-4 / Case::time_step));
  const auto energy = solver.energy();
  CHECK(energy.elastic == 0);
  const auto after = solver.particle(1);
  CHECK(solver.particle(2).angular_velocity[1] == -after.angular_velocity[1]);
  return {spin, after.angular_velocity[1], after.velocity[0], energy.dissipated_rolling - energy.made_by_law};
}

}  // namespace fixdem::tests
