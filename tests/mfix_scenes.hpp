// A ball dropped on a linear spring, two balls pressed between walls and a grain in rising gas, written once for the
// kernel and for the reference.
//
// Figures of the MFIX test cases DEM01, DEM03 and DEM06, with as many digits as are published; those of DEM03 to more
// digits by another program. SI units.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "cases/collide_wall.hpp"
#include "cases/drag_single.hpp"
#include "listed_sizes.hpp"
#include "recorded.hpp"
#include "support.hpp"

namespace fixdem::tests {

/// MFIX DEM01: a heavy ball dropped on a soft flat wall; time and speed of first contact and of the return to it. There
/// the ball has a radius of 0.1 m and its centre passes the wall; here the same mass has three times the radius, which
/// changes nothing in the motion and keeps the overlap within the limit that the kernel watches.
template <int restitution_percent>
struct dropped_ball : cases::collide_wall {
  static constexpr int particle_count = 1;
  static constexpr double diameter = 0.6, density = 2600.0 / 27, restitution = restitution_percent / 100.0,
                          friction = 0;
  static constexpr NormalLaw normal = NormalLaw::linear;
  static constexpr double normal_stiffness = 1e4, tangential_stiffness = 1e4;
  static constexpr bool has_wall = false;
  static constexpr Ends ends = Ends::closed;
  static constexpr double pipe_diameter = 2, pipe_length = 2;
  static constexpr double gravity[3] = {0, 0, -9.80665};
  static constexpr double time_step = 2e-5;  // 1/5000 of the contact time: the fall is first order in it
};

template <template <class> class Solver, class Case>
void check_dropped_ball(const Table& table, double return_time, double return_speed) {
  enter({Case::name, 0});
  static Solver<Case> solver;
  const double r = Case::diameter / 2, height = r + 0.4;
  solver.place(0, {{0, 0, height}, {0, 0, 0}, {0, 0, 0}});
  start(solver);
  std::vector<std::array<double, 2>> crossings;  // time and velocity where the centre passes one radius
  double z_before = height, v_before = 0;
  for (int n = 0; n < 20000 && crossings.size() < 2; ++n) {
    run(solver, 1);
    const auto p = solver.particle(0);
    if ((z_before > r) != (p.position[2] > r)) {
      const double part = (r - z_before) / (p.position[2] - z_before);
      crossings.push_back({(n + part) * Case::time_step, v_before + part * (p.velocity[2] - v_before)});
    }
    z_before = p.position[2], v_before = p.velocity[2];
  }
  REQUIRE(crossings.size() == 2);
  const std::string row = "e = " + in_words(Case::restitution);
  const Table& falls = Case::restitution == 1 ? table : unrecorded;                            // the same for both
  check_figure(falls, "the fall", {"time of contact", "s"}, 0.285617, crossings[0][0], 2e-5);  // one step
  check_share(falls, "the fall", {"velocity at contact", "m/s"}, -2.800950, crossings[0][1], 2e-4);
  check_figure(table, row, {"time of return", "s"}, return_time, crossings[1][0], 3e-5);
  check_share(table, row, {"velocity of return", "m/s"}, return_speed, crossings[1][1], 5e-4);
}

template <template <class> class Solver>
void check_dropped_balls(const Table& table = unrecorded) {
  check_dropped_ball<Solver, dropped_ball<100>>(table, 0.396887, 2.800950);
  check_dropped_ball<Solver, dropped_ball<90>>(table, 0.397435, 2.475443);
}

/// MFIX DEM03: two balls of 1 mm, the lower of twice the density, at rest and pressed between walls 1.8 mm apart;
/// linear springs, no losses. Here the walls are the bottom and top of a pipe.
struct pressed_balls {
  static constexpr const char* name = "MFIX DEM03";
  static constexpr int species_count = 2;
  static constexpr const char* species_names[] = {"lower", "upper"};
  static constexpr SizeRun sizes[] = {{1, 0.001, 20000, 0}, {1, 0.001, 10000, 1}};
};
template <Integrator scheme>
struct between_walls : sized<pressed_balls, short_pipe> {
  static constexpr double restitution = 1, friction = 0;
  static constexpr NormalLaw normal = NormalLaw::linear;
  static constexpr double normal_stiffness = 1e3, tangential_stiffness = 1e3;
  static constexpr double pipe_diameter = 0.0018, pipe_length = 0.004;
  static constexpr int slice_count = 4;
  static constexpr double gravity[3] = {0, -9.80665, 0};
  static constexpr Integrator integrator = scheme;
  static constexpr double time_step = 2e-8;
};

/// Heights at three times to `bound`, m.
template <template <class> class Solver, class Case>
void check_pressed_balls(double bound, const Table& table = unrecorded) {
  enter({Case::name, 0});
  static Solver<Case> solver;
  constexpr double middle = Case::pipe_diameter / 2;
  solver.place(0, {{0, 0.00045 - middle, 0.002}, {0, 0, 0}, {0, 0, 0}});
  solver.place(1, {{0, 0.00135 - middle, 0.002}, {0, 0, 0}, {0, 0, 0}});
  start(solver);
  constexpr double expected[3][3] = {{12.86e-6, 0.4496064489e-3, 1.3507836378e-3},
                                     {102.88e-6, 0.4320098711e-3, 1.3823714935e-3},
                                     {160.74e-6, 0.4235740682e-3, 1.3872912607e-3}};
  for (const auto& [time, lower, upper] : expected) {
    run(solver, std::llround(time / Case::time_step) - solver.step());
    const std::string row = in_words(time * 1e6) + " us";
    const double y[2] = {solver.particle(0).position[1] + middle, solver.particle(1).position[1] + middle};
    check_figure(table, row, {"height of the lower ball", "mm"}, lower * 1e3, y[0] * 1e3, bound * 1e3);
    check_figure(table, row, {"height of the upper ball", "mm"}, upper * 1e3, y[1] * 1e3, bound * 1e3);
  }
  CHECK(solver.particle(0).position[0] == 0);
}

template <template <class> class Solver>
void check_all_pressed_balls(const Table& table = unrecorded) {
  check_pressed_balls<Solver, between_walls<Integrator::euler>>(5e-9);
  check_pressed_balls<Solver, between_walls<Integrator::leapfrog>>(1e-12);
  check_pressed_balls<Solver, between_walls<Integrator::impulse>>(1e-12, table);
}

/// MFIX DEM06: one grain in rising gas; its speed after 0.1 s and in the end.
struct grain_in_gas : cases::drag_single {
  static constexpr int particle_count = 1;
  static constexpr double diameter = 100e-6, density = 2000;
  static constexpr double pipe_diameter = 0.001, pipe_length = 0.02;
  static constexpr Ends ends = Ends::periodic;
  static constexpr double gas_velocity = 0.4, gas_density = 1.2, gas_viscosity = 1.8e-5 / 1.2;
  static constexpr int gas_update_interval = 1, slice_count = 100;
  /// MFIX subtracts the buoyancy of the grain, which this model leaves out: given to it through the gravity.
  static constexpr double gravity[3] = {0, 0, -9.80665 * (1 - 1.2 / 2000)};
  static constexpr double time_step = 1e-5;
};

template <template <class> class Solver>
void check_grain_in_gas(const Table& table = unrecorded) {
  enter({grain_in_gas::name, 0});
  static Solver<grain_in_gas> solver;
  solver.place(0, {{0, 0, 0.01}, {0, 0, 0}, {0, 0, 0}});
  start(solver);
  run(solver, 10000);
  const Quantity velocity{"velocity", "m/s"};
  check_figure(table, "after 0.1 s", velocity, -0.05263133, solver.particle(0).velocity[2],
               2e-6);  // first order: 1.4e-6 at 1e-5 s
  run(solver, 140000);
  check_figure(table, "in the end", velocity, -0.05740169, solver.particle(0).velocity[2],
               1e-8);  // the limit does not depend on the step
}

}  // namespace fixdem::tests
