// The trajectory that the frontier compares with: the tests' reference in extended precision at dt/64.
//
// Usage: truth STATE. From the perturbed state (perturbed.hpp), by `leapfrog` with a 64th of the case's time step in
// long double, the gas renewed once in each of the case's steps. Slider "clip", because "paper" has no limit for
// vanishing steps. Output, in m:
//   at,moment,time            then, for every particle,          place,id,x,y,z
// Moment 0 is the start.
#include FIXDEM_CASE_HEADER

#include <fmt/format.h>

#include <cstdio>
#include <exception>

#include "perturbed.hpp"
#include "tests/reference/reference.hpp"

namespace {

using namespace fixdem;
using Original = cases::FIXDEM_CASE;

struct Fine : Original {
#ifdef FIXDEM_FINER
  static constexpr int finer = FIXDEM_FINER;
#else
  static constexpr int finer = 64;
#endif
  static constexpr double time_step = Original::time_step / finer;
  static constexpr Integrator integrator = Integrator::leapfrog;
  static constexpr Slider slider = Slider::clip;
  static constexpr int gas_update_interval = finer;
  static constexpr int gas_floater_interval = finer * Original::gas_floater_interval;
};

reference::Reference<Fine, long double> solver;

void print(int moment) {
  fmt::print("at,{},{:.17g}\n", moment, static_cast<double>(solver.step()) * Fine::time_step);
  for (int id = 0; id < Fine::particle_count; ++id) {
    const auto p = solver.particle(id);
    fmt::print("place,{},{:.17g},{:.17g},{:.17g}\n", id, p.position[0], p.position[1], p.position[2]);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: truth STATE\n");
    return 2;
  }
  try {
    frontier::start_from(solver, frontier::perturbed(frontier::stored_state(argv[1], Fine::particle_count)));
  } catch (const std::exception& error) {
    fmt::print(stderr, "truth: {}\n", error.what());
    return 3;
  }
  solver.look_ahead(0.05L * static_cast<long double>(Fine::diameter));
  print(0);
  int number = 0;
  for (const double moment : frontier::moments) {
    solver.run(Fine::finer * frontier::case_steps_until<Original>(moment) - solver.step());
    print(++number);
  }
}
