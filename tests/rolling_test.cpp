// A sphere with rolling resistance on a plane: it rolls out, slides before it rolls, and stays on a slope or not. The
// kernel, and the reference by itself.
//
// The plane is level or falls towards +x; times and places are of an event-driven solution (rolling_scenes.hpp), and
// agree with rigid-body mechanics, v' = -(5/7) mu_r g on the level and (5/7) g (sin - mu_r cos) on a slope.
#include "kernel/fixdem.hpp"
#include "recorded.hpp"
#include "reference/reference.hpp"
#include "rolling_scenes.hpp"

namespace fixdem::tests {
namespace {

template <class Case>
using ReferenceProgram = reference::Reference<Case, double>;

template <class Case, class Solver>
void run_to(Solver& solver, double time) {
  run(solver, static_cast<long long>(std::round(time / Case::time_step)) - solver.step());
}

constexpr Table rolling_on_a_plane{"rolling-plane", "reference integration"};

/// Bounds: seconds and metres.
template <template <class> class Solver, Integrator scheme, int step_in_ns>
void check_level(double time_bound, double place_bound, double sliding_time_bound, double sliding_place_bound,
                 const Table& table = unrecorded) {
  using Case = on_plane<30, 50, 0, scheme, step_in_ns>;
  enter({Case::name, 0});
  static Solver<Case> solver;
  start_on_plane<Case>(solver, 0.1, 20, 30);  // rolls at first, and turns about the normal
  const Crossing stop = run_until_it_stops<Case>(solver);
  const char *rolling = "level, rolls at first", *sliding = "level, slides at first";
  check_figure(table, rolling, {"it stops at", "s"}, 0.285423038, stop.time, time_bound);
  check_figure(unrecorded, rolling, {"it stops at", "mm"}, 14.2711523, stop.place * 1e3, place_bound * 1e3);
  run_to<Case>(solver, 0.5);
  check_figure(table, rolling, {"it rests at", "mm"}, 14.2711487, solver.particle(0).position[0] * 1e3,
               place_bound * 1e3);
  check_figure(unrecorded, rolling, {"velocity at 0.5 s", "m/s"}, 0, solver.particle(0).velocity[0], 1e-13);
  CHECK(std::abs(solver.particle(0).angular_velocity[1]) < 1e-11);
  check_figure(table, rolling, {"spin about the normal", "rad/s"}, 30, solver.particle(0).angular_velocity[2], 0);

  start_on_plane<Case>(solver, 0.1, 0);  // slides at first
  const Crossing rolls = run_until_it_rolls<Case>(solver);
  check_figure(table, sliding, {"it rolls from", "s"}, 0.01102, rolls.time, 1e-5);
  check_figure(table, sliding, {"velocity then", "m/s"}, 0.067573, rolls.velocity, 2e-6);
  const Crossing then = run_until_it_stops<Case>(solver);
  check_figure(table, sliding, {"it stops at", "s"}, 0.203886989, then.time, sliding_time_bound);
  check_figure(unrecorded, sliding, {"it stops at", "mm"}, 7.4395329, then.place * 1e3, sliding_place_bound * 1e3);
  run_to<Case>(solver, 0.5);
  check_figure(table, sliding, {"it rests at", "mm"}, 7.4395293, solver.particle(0).position[0] * 1e3,
               sliding_place_bound * 1e3);
  CHECK(std::abs(solver.particle(0).velocity[0]) < 1e-13);
}

TEST_CASE("rolling: on the level, in the reference") {
  check_level<ReferenceProgram, Integrator::impulse, 5000>(2e-8, 1e-9, 1e-6, 1e-7);
}
TEST_CASE("rolling: on the level") {
  check_level<Simulation, Integrator::impulse, 5000>(2e-8, 1e-9, 1e-6, 1e-7);
  check_level<Simulation, Integrator::impulse, 2000>(5e-9, 2e-10, 4e-7, 3e-8, rolling_on_a_plane);
  check_level<Simulation, Integrator::euler, 10000>(1e-8, 6e-7, 3e-6, 6e-7);
  check_level<Simulation, Integrator::euler, 2000>(1e-8, 1.2e-7, 4e-7, 1.2e-7);
  check_level<Simulation, Integrator::leapfrog, 10000>(1e-8, 1e-9, 3e-6, 2e-7);
}

constexpr long long ten_degrees_up = -17632698070846498;  // tangent, 1e-17

/// Rolls up at 1 m/s; bounds: m.
template <template <class> class Solver, int rolling_permille, Integrator scheme, int step_in_ns>
void check_slope_up(double time, double place, double final_place, double final_velocity, double bound,
                    const Table& table = unrecorded) {
  using Case = on_plane<50, rolling_permille, ten_degrees_up, scheme, step_in_ns>;
  enter({Case::name, 0});
  static Solver<Case> solver;
  start_on_plane<Case>(solver, 1, 200);
  const Crossing stop = run_until_it_stops<Case>(solver);
  const std::string row = "10 degrees upwards, mu_r = " + in_words(Case::rolling_friction);
  check_figure(table, row, {"it stops at", "s"}, time, stop.time, 2e-8);
  check_figure(unrecorded, row, {"it stops at", "mm"}, place * 1e3, stop.place * 1e3, bound * 1e3);
  run_to<Case>(solver, 0.8);
  const auto after = solver.particle(0);
  check_figure(table, row, {"place at 0.8 s", "mm"}, final_place * 1e3, after.position[0] * 1e3, bound * 1e3);
  check_figure(unrecorded, row, {"velocity at 0.8 s", "m/s"}, final_velocity, after.velocity[0],
               final_velocity == 0 ? 1e-13 : 5e-5);
}

TEST_CASE("rolling: up a slope of 10 degrees, where it stays or rolls back") {
  check_slope_up<ReferenceProgram, 200, Integrator::impulse, 5000>(0.385072242, 0.192536122, 0.192535929, 0, 1e-8);
  check_slope_up<Simulation, 200, Integrator::impulse, 5000>(0.385072242, 0.192536122, 0.192535929, 0, 1e-8,
                                                             rolling_on_a_plane);
  check_slope_up<Simulation, 100, Integrator::impulse, 5000>(0.524426076, 0.262213038, 0.2421866, -0.1452, 1e-7,
                                                             rolling_on_a_plane);
  check_slope_up<Simulation, 200, Integrator::euler, 10000>(0.385072242, 0.192536122, 0.192535929, 0, 6e-6);
  check_slope_up<Simulation, 200, Integrator::euler, 2000>(0.385072242, 0.192536122, 0.192535929, 0, 1.2e-6);
}

/// Lies on the slope at first. `tenths`: its tangent over the rolling friction.
template <int rolling_permille, int tenths>
Particle after_slope(double& speed_before) {
  using Case = on_plane<50, rolling_permille, rolling_permille * tenths * 10000000000000, Integrator::impulse, 10000>;
  enter({Case::name, 0});
  static Simulation<Case> solver;
  start_on_plane<Case>(solver, 0, 0);
  run_to<Case>(solver, 0.1);
  speed_before = solver.particle(0).velocity[0];
  run_to<Case>(solver, 0.2);
  return solver.particle(0);
}
template <int rolling_permille>
void check_slopes(double moved, double slow, double fast) {
  double before = 0;
  const Particle stays = after_slope<rolling_permille, 9>(before);
  const std::string on_slope = "mu_r = " + in_words(rolling_permille / 1000.0) + ", tangent over mu_r ";
  const Quantity acceleration{"acceleration", "m/s2"};
  check_share(rolling_on_a_plane, on_slope + "0.9", {"moved in 0.2 s", "m"}, moved, stays.position[0], 2e-3);
  check_figure(unrecorded, on_slope + "0.9", {"velocity", "m/s"}, 0, stays.velocity[0], 1e-15);
  const double after_slow = after_slope<rolling_permille, 11>(before).velocity[0];
  check_figure(rolling_on_a_plane, on_slope + "1.1", acceleration, slow, (after_slow - before) / 0.1, 1e-8);
  const double after_fast = after_slope<rolling_permille, 20>(before).velocity[0];
  check_figure(rolling_on_a_plane, on_slope + "2", acceleration, fast, (after_fast - before) / 0.1, 1e-8);
}

TEST_CASE("rolling: it stays on a slope whose tangent is less than the rolling friction") {
  check_slopes<50>(1.910e-8, 0.034982843, 0.348618387);
  check_slopes<100>(3.812e-8, 0.069651305, 0.687106888);
}

}  // namespace
}  // namespace fixdem::tests
