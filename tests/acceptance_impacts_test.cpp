// The kernel held against the world: Hertz impacts, oblique impacts, the linear spring, a grain in gas.
#include "chung_ooi_scenes.hpp"
#include "kernel/fixdem.hpp"
#include "mfix_scenes.hpp"

namespace fixdem::tests {
namespace {

template <class Case>
using Kernel = Simulation<Case>;

TEST_CASE("acceptance: elastic normal impacts, Chung & Ooi tests 1 and 2") { check_normal_impacts<Kernel>(); }

TEST_CASE("acceptance: oblique impacts, Chung & Ooi test 4") { check_oblique_impacts<Kernel>(); }

TEST_CASE("acceptance: a ball dropped on a linear spring, MFIX DEM01") { check_dropped_balls<Kernel>(); }

TEST_CASE("acceptance: a grain in rising gas, MFIX DEM06") { check_grain_in_gas<Kernel>(); }

}  // namespace
}  // namespace fixdem::tests
