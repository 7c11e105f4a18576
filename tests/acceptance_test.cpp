// The kernel held against the world: every impact returns the restitution asked.
#include <cstdio>
#include <cstdlib>

#include "kernel/fixdem.hpp"
#include "restitution_scenes.hpp"

namespace fixdem::tests {
namespace {

template <class Case>
using Kernel = Simulation<Case>;

template <Integrator chosen, int... permille>
void check_restitutions(const Table& table = unrecorded) {
  (check_restitution<Kernel, impacts<permille, chosen>>(table), ...);
}

TEST_CASE("acceptance: impacts return the restitution asked, Euler") {
  check_restitutions<Integrator::euler, 100, 200, 400, 600, 800, 900, 1000>(
      {"chung-ooi-3", "closed form (what is asked)"});
}

TEST_CASE("acceptance: impacts return the restitution asked, leapfrog") {
  check_restitutions<Integrator::leapfrog, 200, 600, 1000>();
}

TEST_CASE("acceptance: the restitution depends on no material") {
  check_restitution<Kernel, impacts<500, Integrator::leapfrog, large_aluminium>>();
  check_restitution<Kernel, impacts<500, Integrator::euler, small_rubber>>();
}

template <int step_in_hundred_ns>
void check_error(double least, double maximum) {
  const double euler = restitution_error<Kernel, phases<step_in_hundred_ns, Integrator::euler>>();
  const double leapfrog = restitution_error<Kernel, phases<step_in_hundred_ns, Integrator::leapfrog>>();
  if (std::getenv("FIXDEM_FIGURES") != nullptr) {
    std::fprintf(stderr, "  restitution error at %.0e s: euler %.1e, leapfrog %.1e\n", step_in_hundred_ns * 1e-7, euler,
                 leapfrog);
  }
  for (const double error : {euler, leapfrog}) {
    CHECK(error > least);
    CHECK(error < maximum);
  }
}

TEST_CASE("acceptance: how the error of the restitution grows with the step") {
  check_error<20>(1e-4, 1.5e-3);  // 2e-6 s, the step of the shipped cases: 1/41 of the contact time
  check_error<100>(5e-4, 1.5e-2);
  check_error<200>(3e-3, 6e-2);
}

}  // namespace
}  // namespace fixdem::tests
