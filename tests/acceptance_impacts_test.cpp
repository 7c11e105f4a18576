// The kernel held against the world: Hertz impacts, oblique impacts, the linear spring, a grain in gas.
#include "chung_ooi_scenes.hpp"
#include "kernel/fixdem.hpp"
#include "mfix_scenes.hpp"

namespace fixdem::tests {
namespace {

template <class Case>
using Kernel = Simulation<Case>;

TEST_CASE("acceptance: elastic normal impacts, Chung & Ooi tests 1 and 2") {
  check_normal_impacts<Kernel>({"chung-ooi-1", "closed form (Hertz)"}, {"chung-ooi-2", "closed form (Hertz)"});
}

TEST_CASE("acceptance: oblique impacts, Chung & Ooi test 4") {
  check_oblique_impacts<Kernel>({"chung-ooi-4", "reference integration"}, {"chung-ooi-4", "closed form (sliding)"},
                                {"chung-ooi-4-experiment", "published (Foerster's experiment, MFIX DEM05)"});
}

TEST_CASE("acceptance: a ball dropped on a linear spring, MFIX DEM01") {
  check_dropped_balls<Kernel>({"mfix-dem01", "published (MFIX DEM01)"});
}

TEST_CASE("acceptance: a grain in rising gas, MFIX DEM06") {
  check_grain_in_gas<Kernel>({"mfix-dem06", "published (MFIX DEM06)"});
}

}  // namespace
}  // namespace fixdem::tests
