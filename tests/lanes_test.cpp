// Lane widths 8, 4, 2 and 1 give the same bytes: the scalar twin of the SIMD vocabulary against the registers.
//
// Agitated closed and periodic scenes with sliding, sticking, new and ended contacts, walls and gas, 2000 steps; every
// particle's position, velocity and angular velocity is compared byte by byte.
#include <doctest/doctest.h>

#include <cstring>
#include <memory>

#include "identical/scenes.hpp"
#include "kernel/fixdem.hpp"

namespace {

using namespace fixdem::tests::identical;

template <class Case, int W>
void compare_with_one_lane() {
  auto wide = std::make_unique<fixdem::Simulation<Case, W>>();
  auto narrow = std::make_unique<fixdem::Simulation<Case, 1>>();
  place_agitated(*wide);
  place_agitated(*narrow);
  REQUIRE(wide->start().ok());
  REQUIRE(narrow->start().ok());
  REQUIRE(wide->run(2000).ok());
  REQUIRE(narrow->run(2000).ok());
  int different = 0;
  for (int id = 0; id < Case::particle_count; ++id) {
    const fixdem::Particle a = wide->particle(id), b = narrow->particle(id);
    different += std::memcmp(&a, &b, sizeof a) != 0;
  }
  CHECK(different == 0);
  const fixdem::Energy a = wide->energy(), b = narrow->energy();
  CHECK(std::memcmp(&a, &b, sizeof a) == 0);
  CHECK(a.dissipated_damping != 0);  // something did collide
}

}  // namespace

TEST_CASE_TEMPLATE("widths agree byte for byte", Case, gas, smooth, leapfrog, paper, linear, mixed_gas, mixed_smooth,
                   mixed_leapfrog, mixed_paper) {
  if constexpr (FIXDEM_WIDEST_LANES >= 8) compare_with_one_lane<Case, 8>();
  if constexpr (FIXDEM_WIDEST_LANES >= 4) compare_with_one_lane<Case, 4>();
  if constexpr (FIXDEM_WIDEST_LANES >= 2) compare_with_one_lane<Case, 2>();
}
