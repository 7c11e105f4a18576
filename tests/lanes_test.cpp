// Lane widths 8, 4, 2 and 1 give the same bytes: the scalar twin of the SIMD vocabulary against the registers.
//
// Agitated closed and periodic scenes with sliding, sticking, new and ended contacts, walls and gas, 2000 steps; every
// particle's position, velocity and angular velocity is compared byte by byte.
#include <doctest/doctest.h>

#include <cstring>
#include <memory>

#include "cases/plug_u24.hpp"
#include "cases/settle.hpp"
#include "kernel/fixdem.hpp"

namespace {

/// Particles on a jittered lattice that fits the pipe, with velocities and spins, the same for every width.
template <class Simulation>
void place_agitated(Simulation& simulation) {
  using Case = typename Simulation::case_type;
  unsigned long long bits = 0x9e3779b97f4a7c15ULL;
  const auto uniform = [&] {
    bits ^= bits << 13, bits ^= bits >> 7, bits ^= bits << 17;
    return static_cast<double>(bits >> 11) * 0x1p-52 - 1;  // -1 .. 1
  };
  const double d = Case::diameter;
  for (int id = 0; id < Case::particle_count; ++id) {
    const int layer = id / 4, corner = id % 4;
    fixdem::Particle p{};
    p.position[0] = (corner % 2 == 0 ? -0.6 : 0.6) * d + 0.05 * d * uniform();
    p.position[1] = (corner / 2 == 0 ? -0.6 : 0.6) * d + 0.05 * d * uniform();
    p.position[2] = (layer + 0.6) * 1.1 * d;
    for (int c = 0; c < 3; ++c) p.velocity[c] = uniform();
    if (Case::friction > 0)
      for (int c = 0; c < 3; ++c) p.angular_velocity[c] = 100 * uniform();
    simulation.place(id, p);
  }
}

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

struct gas : fixdem::cases::plug_u24 {
  static constexpr int particle_count = 240;
};
struct smooth : gas {
  static constexpr double friction = 0;
};
struct leapfrog : gas {
  static constexpr auto integrator = fixdem::Integrator::leapfrog;
  static constexpr auto tangential = fixdem::TangentialLaw::rescale;
};
struct paper : fixdem::cases::settle {
  static constexpr int particle_count = 20;
  static constexpr auto slider = fixdem::Slider::paper;
  static constexpr auto tangential = fixdem::TangentialLaw::force;
};
struct linear : paper {
  static constexpr auto normal = fixdem::NormalLaw::linear;
  static constexpr auto damping = fixdem::Damping::critical;
  static constexpr double normal_stiffness = 1e5, tangential_stiffness = 3e4;
};

}  // namespace

TEST_CASE_TEMPLATE("widths agree byte for byte", Case, gas, smooth, leapfrog, paper, linear) {
  if constexpr (FIXDEM_WIDEST_LANES >= 8) compare_with_one_lane<Case, 8>();
  if constexpr (FIXDEM_WIDEST_LANES >= 4) compare_with_one_lane<Case, 4>();
  if constexpr (FIXDEM_WIDEST_LANES >= 2) compare_with_one_lane<Case, 2>();
}
