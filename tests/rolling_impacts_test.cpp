// Impacts of turning spheres with rolling resistance, on a wall and of pairs: the kernel, and the reference by itself.
//
// Where rolling slips from beginning to end (the highest spins), the change of spin is that of a closed form, and
// impulses give it to 1e-8 m/s at 0.1 us. Where its spring holds, errors are of first order in the step with every
// integrator: the dashpot takes the rolling velocity of the step's beginning.
#include <initializer_list>

#include "kernel/fixdem.hpp"
#include "recorded.hpp"
#include "reference/reference.hpp"
#include "rolling_scenes.hpp"

namespace fixdem::tests {
namespace {

struct Bounds {
  double velocity, work;                    ///< m/s at the surface; of the work
  double slipping_velocity, slipping_work;  ///< the same where rolling slips all the time
};

struct Row {
  RollingImpact expected;
  bool slips;
};

void check_impact(WorstFigures& worst, const RollingImpact& got, const Row& row, const Bounds& bounds) {
  const RollingImpact& expected = row.expected;
  const std::string which = "spin " + in_words(expected.spin) + " rad/s";
  const double allowed = row.slips ? bounds.slipping_velocity : bounds.velocity;
  worst.check(which, {"angular velocity", "rad/s"}, expected.spin_after, got.spin_after, allowed / 0.005);
  worst.check(which, {"tangential velocity", "m/s"}, expected.velocity_after, got.velocity_after, allowed);
  worst.check(which, {"work of rolling resistance", "J"}, expected.work, got.work,
              (row.slips ? bounds.slipping_work : bounds.work) * expected.work);
}

template <class Solver, class Case>
void check_impacts(std::initializer_list<Row> on_wall, std::initializer_list<Row> of_pair, const Bounds& bounds,
                   const Table& table) {
  enter({Case::name, 0});
  static Solver solver;
  const std::string e = ", e = " + in_words(Case::restitution);
  WorstFigures pairs(table, "10 mm on 10 mm" + e), walls(table, "10 mm on a wall" + e);  // recorded: walls first
  for (const Row& row : on_wall) check_impact(walls, impact_on_wall<Case>(solver, row.expected.spin), row, bounds);
  for (const Row& row : of_pair) check_impact(pairs, impact_of_pair<Case>(solver, row.expected.spin), row, bounds);
}

template <template <class> class Solver, Integrator scheme, int step_in_ns>
void check_restitution_9(const Bounds& bounds, const Table& table = unrecorded) {
  using Case = rolling_impact<9, scheme, step_in_ns>;
  check_impacts<Solver<Case>, Case>({{{10, -4.94387998, -0.0049761888, 6.466498034e-08}, false},
                                     {{50, -1.60420093, 0.0461362757, 4.303951992e-06}, false},
                                     {{200, 39.58764243, 0.1641822488, 2.693416542e-05}, false},
                                     {{800, 420.00000000, 0.5700000000, 3.034254905e-04}, true}},
                                    {{{10, -7.21609944, 0, 2.509499441e-07}, false},
                                     {{50, 26.25000000, 0, 9.482046577e-06}, true},
                                     {{200, 176.25000000, 0, 4.678845934e-05}, true},
                                     {{800, 776.25000000, 0, 1.960141104e-04}, true}},
                                    bounds, table);
}

template <template <class> class Solver, Integrator scheme, int step_in_ns>
void check_restitution_5(const Bounds& bounds, const Table& table = unrecorded) {
  using Case = rolling_impact<5, scheme, step_in_ns>;
  check_impacts<Solver<Case>, Case>({{{10, -1.10205101, -0.0076613671, 3.342259337e-08}, false},
                                     {{50, 5.41008459, 0.0124103857, 2.625658236e-06}, false},
                                     {{200, 35.70963048, 0.1785807390, 2.847026380e-05}, false},
                                     {{800, 500.00000000, 0.4500000000, 2.552544031e-04}, true}},
                                    {{{10, -5.40713555, 0, 3.705136002e-07}, false},
                                     {{50, 31.25000000, 0, 7.976700097e-06}, true},
                                     {{200, 181.25000000, 0, 3.742913122e-05}, true},
                                     {{800, 781.25000000, 0, 1.552388557e-04}, true}},
                                    bounds, table);
}

template <class Case>
using ReferenceProgram = reference::Reference<Case, double>;

TEST_CASE("rolling: impacts by impulses, in the reference") {
  check_restitution_9<ReferenceProgram, Integrator::impulse, 100>({1e-4, 3e-3, 1e-8, 1e-6});
  check_restitution_5<ReferenceProgram, Integrator::impulse, 100>({1e-4, 3e-3, 1e-8, 1e-6});
}
TEST_CASE("rolling: impacts by impulses") {
  check_restitution_9<Simulation, Integrator::impulse, 100>({1e-4, 3e-3, 1e-8, 1e-6});
  check_restitution_5<Simulation, Integrator::impulse, 100>({1e-4, 3e-3, 1e-8, 1e-6});
  check_restitution_9<Simulation, Integrator::impulse, 20>({2e-5, 6e-4, 1e-8, 1e-6},
                                                           {"rolling-impacts", "reference integration"});
  check_restitution_5<Simulation, Integrator::impulse, 20>({2e-5, 6e-4, 1e-8, 1e-6});
}
TEST_CASE("rolling: impacts by euler and leapfrog") {
  check_restitution_9<Simulation, Integrator::euler, 100>({3e-4, 1e-2, 1e-3, 1e-3});
  check_restitution_9<Simulation, Integrator::euler, 20>({6e-5, 2e-3, 2e-4, 2e-4});
  check_restitution_9<Simulation, Integrator::leapfrog, 100>({3e-4, 1e-2, 1e-3, 1e-3});
  check_restitution_9<Simulation, Integrator::leapfrog, 20>({6e-5, 2e-3, 2e-4, 2e-4});
}

}  // namespace
}  // namespace fixdem::tests
