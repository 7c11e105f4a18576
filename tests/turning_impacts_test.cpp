// Turning spheres on larger or smaller ones, rolling resistance between them, and two balls of unequal density, against
// figures from outside: the kernel, and the reference by itself.
#include "turning_impacts.hpp"

#include "kernel/fixdem.hpp"
#include "mfix_scenes.hpp"
#include "reference/reference.hpp"

namespace fixdem::tests {
namespace {

template <class Case>
using ReferenceProgram = reference::Reference<Case, double>;
template <class Case>
using Kernel = Simulation<Case>;

using enum FrictionLimit;
using enum Integrator;

TEST_CASE("unequal spheres: Chung & Ooi test 8") {
  check_chung_ooi_8<ReferenceProgram, chung_ooi_8<total, euler, 200>>(2e-5);
  check_chung_ooi_8<ReferenceProgram, chung_ooi_8<total, impulse, 1000>>(1e-5);
  check_chung_ooi_8<ReferenceProgram, chung_ooi_8<elastic, impulse, 200>>(5e-8);
  check_chung_ooi_8<Kernel, chung_ooi_8<total, euler, 200>>(2e-5);
  check_chung_ooi_8<Kernel, chung_ooi_8<total, impulse, 1000>>(1e-5);
  check_chung_ooi_8<Kernel, chung_ooi_8<elastic, impulse, 200>>(5e-8, {"chung-ooi-8", "reference integration"});
}

TEST_CASE("unequal spheres: rolling resistance") {
  check_unequal_rolling<ReferenceProgram, 9, impulse, 20>(1e-6, 2e-3);
  check_unequal_rolling<ReferenceProgram, 5, impulse, 20>(1e-5, 2e-3);
  check_unequal_rolling<ReferenceProgram, 5, euler, 20>(5e-5, 2e-3);
  check_unequal_rolling<Kernel, 9, impulse, 20>(1e-6, 2e-3, {"rolling-impacts", "reference integration"});
  check_unequal_rolling<Kernel, 5, impulse, 20>(1e-5, 2e-3);
  check_unequal_rolling<Kernel, 5, euler, 20>(5e-5, 2e-3);
}

TEST_CASE("unequal densities: two balls pressed between walls, MFIX DEM03") {
  check_all_pressed_balls<ReferenceProgram>();
  check_all_pressed_balls<Kernel>({"mfix-dem03", "published (MFIX DEM03), to more digits by a reference integration"});
}

}  // namespace
}  // namespace fixdem::tests
