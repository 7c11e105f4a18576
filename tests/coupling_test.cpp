// Co-simulation: gravity and gas that are set while a scene runs, and the forces on its walls.
#include "kernel/fixdem.hpp"
#include "small_gas_scene.hpp"

namespace fixdem::tests {
namespace {

struct other_gas : small_gas {
  static constexpr double gas_velocity = -1.7;
  static constexpr double gravity[3] = {0, -3.0, 0};
};
struct coupled_gas : small_gas {
  static constexpr bool is_coupled = true;
};

Simulation<other_gas> fixed;
Simulation<coupled_gas> coupled;

void place_both() {
  const auto particles = layered_spheres<small_gas>(small_gas::pipe_length / 7, 0.5, Random(seed()));
  place_all(fixed, particles);
  place_all(coupled, particles);
  start(fixed);
  start(coupled);
}

double maximum_difference() {
  double maximum = 0;
  for (int id = 0; id < small_gas::particle_count; ++id)
    for (int c = 0; c < 3; ++c)
      maximum = std::max(maximum, std::abs(fixed.particle(id).position[c] - coupled.particle(id).position[c]));
  return maximum;
}

TEST_CASE("coupling: values set before the first step are as good as constants of the case, to the last bit") {
  enter({coupled_gas::name, seed()});
  place_both();
  coupled.set_gravity(other_gas::gravity);
  coupled.set_gas_velocity(other_gas::gas_velocity);
  run(fixed, 3000);
  run(coupled, 3000);
  CHECK(maximum_difference() == 0);
  CHECK(fixed.energy().gas_work == coupled.energy().gas_work);
  CHECK(fixed.energy().gravity_work == doctest::Approx(coupled.energy().gravity_work).epsilon(1e-12));
}

TEST_CASE("coupling: start() returns to the case's values; the energy of gravity is booked by parts") {
  enter({coupled_gas::name, seed()});
  place_both();
  run(fixed, 1000);
  run(coupled, 1000);
  CHECK(maximum_difference() > 1e-6);
  const double before = coupled.energy().gravity_work;
  coupled.set_gravity({0, 0, 0});
  CHECK(coupled.energy().gravity_work == doctest::Approx(before).epsilon(1e-12));
  run(coupled, 1000);
  CHECK(coupled.energy().gravity_work == doctest::Approx(before).epsilon(1e-12));
}

TEST_CASE("coupling: the force on a wall is the sum over its contacts, opposite to theirs on the particles") {
  enter({other_gas::name, seed()});
  place_both();
  run(fixed, 2000);
  double sum[3] = {};
  int contacts = 0;
  fixed.for_each_contact([&](const Contact& c) {
    if (c.partner != pipe_wall) return;
    ++contacts;
    for (int k = 0; k < 3; ++k) sum[k] += c.normal_force * c.normal[k] - c.tangential_force[k];
  });
  CHECK(contacts > 0);
  const Vec3<double> force = fixed.force_on(pipe_wall);
  CHECK(force.x == doctest::Approx(sum[0]));
  CHECK(force.y == doctest::Approx(sum[1]));
  CHECK(force.z == doctest::Approx(sum[2]));
  CHECK(fixed.force_on(start_end).z == 0);
}

}  // namespace
}  // namespace fixdem::tests
