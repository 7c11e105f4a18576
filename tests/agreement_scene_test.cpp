// Kernel against reference, the rest of a scene: gravity, damping mass, ledger, capacities, the shape of the pipe.
#include "small_scene.hpp"

namespace fixdem::tests {
namespace {

struct particle_mass : small_closed {
  static constexpr DampingMass damping_mass = DampingMass::particle;
};
struct without_ledger : small_periodic {
  static constexpr bool energy_ledger = false;
};
struct oblique_gravity : small_closed {
  static constexpr double gravity[3] = {3, -4, -8};
};
struct weightless : small_periodic {
  static constexpr double gravity[3] = {0, 0, 0};
};
struct rough : small_periodic {
  static constexpr double friction = 2.5;
};
struct many_neighbours : small_periodic {
  static constexpr int neighbour_capacity = 30;
};
/// Four diameters: every particle has neighbours across one of the ends.
struct shortest_pipe : cases::pipe_bed {
  static constexpr int particle_count = 57;
  static constexpr double pipe_length = 4 * diameter;
};
/// Several hundred particles stand beside each other.
struct wide_pipe : cases::pipe_bed {
  static constexpr int particle_count = 1000;
  static constexpr double pipe_diameter = 16 * diameter, pipe_length = 11 * diameter;
};

TEST_CASE("agreement: gravity, friction, ledger, capacity, damping mass") {
  check_small<particle_mass>("damping by the particle's mass");
  check_small<oblique_gravity>("oblique gravity");
  check_small<weightless>("weightless");
  check_small<rough>("friction 2.5");
  check_small<without_ledger>("no energy ledger");
  check_small<many_neighbours>("30 neighbours");
}

TEST_CASE("agreement: a periodic pipe of four diameters") {
  const Spheres spheres = layered_spheres<shortest_pipe>(shortest_pipe::pipe_length / 3, 0.5, Random(seed()));
  check_after<shortest_pipe>(spheres, 3000, "pipe of four diameters");
}

TEST_CASE("agreement: a wide pipe") {
  const Spheres spheres = random_spheres<wide_pipe>(1.0, Random(seed()));
  check_after<wide_pipe>(spheres, 3000, "pipe of 16 diameters");
}

}  // namespace
}  // namespace fixdem::tests
