// What stops a run: each fault names the right kind, step, particle, value and limit; it is final; no byte outside the
// simulation is touched (writes between its arrays are for the sanitizers: make test SAN=1); and the program around it
// stops at the last good step. Faults of capacities: capacity_fault_test.cpp.
#include <unistd.h>

#include <limits>

#include "cases/plug_u24.hpp"
#include "fault_checks.hpp"

namespace fixdem::tests {
namespace {

struct closed_few : few {
  static constexpr Ends ends = Ends::closed;
};
struct soft : few {
  static constexpr NormalLaw normal = NormalLaw::linear;
  static constexpr double normal_stiffness = 10, tangential_stiffness = 10, restitution = 1, friction = 0;
};
/// Nothing stops a particle before it is outside.
struct ghost_wall : soft {
  static constexpr double max_overlap = 1000;
};

constexpr double r = d / 2, wall = few::pipe_diameter / 2;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST_CASE("fault: particles that have not been placed") {
  Simulation<few>& simulation = guarded<few>().simulation;
  const Spheres spheres = apart();
  place_all(simulation, spheres);
  REQUIRE(simulation.start().ok());
  REQUIRE(simulation.run(3).ok());
  check_status(simulation.start(), {Fault::not_placed, 0, 0, 1});  // a second start needs them again
  CHECK(simulation.run(1).fault == Fault::not_placed);

  const auto placed = [](int id) { return Particle{{0, 0, 0.02 + 0.04 * id}, {}, {}}; };
  for (int id : {0, 1, 3}) simulation.place(id, placed(id));
  check_status(simulation.start(), {Fault::not_placed, 2, 0, 1});
  simulation.place(2, placed(2));
  CHECK(simulation.start().ok());
  CHECK(simulation.run(3).ok());

  // What has been placed is gone when the run goes on.
  place_all(simulation, spheres);
  CHECK(simulation.run(3).ok());
  CHECK(simulation.step() == 6);
  check_status(simulation.start(), {Fault::not_placed, 0, 0, 1});
}

TEST_CASE("fault: input that is no finite number") {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, infinity, -infinity}) {
    for (int component = 0; component < 3; ++component) {
      Spheres spheres = apart();
      spheres[1].position[component] = bad;
      check_refused<few>(spheres, {Fault::non_finite, 1, nan, 0});
      spheres = apart();
      spheres[2].velocity[component] = bad;
      check_refused<few>(spheres, {Fault::non_finite, 2, nan, 0});
      spheres = apart();
      spheres[3].angular_velocity[component] = bad;
      check_refused<few>(spheres, {Fault::non_finite, 3, nan, 0});
    }
  }
}

TEST_CASE("fault: a state that becomes not finite") {
  Spheres spheres = apart();
  spheres[2].angular_velocity[1] = 1e300;  // finite, its square is not
  check_stopped<few>(spheres, {Fault::non_finite, 2, nan, 0}, 1, 0);
}

TEST_CASE("fault: outside the pipe at the start") {
  Spheres spheres = apart();
  spheres[3].position[1] = -1.01 * wall;
  check_refused<few>(spheres, {Fault::outside_pipe, 3, 1.01 * wall, wall});
  spheres = apart();
  spheres[0].position[2] = -0.01 * d;
  check_refused<closed_few>(spheres, {Fault::outside_pipe, 0, -0.01 * d, few::pipe_length});
  spheres = apart();
  spheres[1].position[2] = few::pipe_length + 0.01 * d;
  check_refused<closed_few>(spheres, {Fault::outside_pipe, 1, few::pipe_length + 0.01 * d, few::pipe_length});
}

TEST_CASE("fault: outside the pipe during the run") {
  Spheres spheres = apart();
  spheres[3].velocity[0] = 5;
  // 25 mm to the wall at 5 m/s (2500 steps); the spring is too soft to matter. Found at the next sort, at the latest
  // 0.25 d or 250 steps further.
  enter({ghost_wall::name, 0});
  Guarded<ghost_wall>& object = guarded<ghost_wall>();
  place_all(object.simulation, spheres);
  REQUIRE(object.simulation.start().ok());
  const Status status = object.simulation.run(100000);
  CHECK(status.fault == Fault::outside_pipe);
  CHECK(status.particle == 3);
  CHECK(status.value > wall);
  CHECK(status.value < wall + 0.25 * d);
  CHECK(status.limit == doctest::Approx(wall).epsilon(1e-12));
  CHECK(std::abs(static_cast<double>(status.step) - 2625) <= 125);
  check_final(object.simulation, status);
  CHECK(object.intact());
  check_program<ghost_wall>(spheres, status);
}

TEST_CASE("fault: too deep an overlap at the start") {
  Spheres spheres = apart();
  spheres[2].position[2] = spheres[1].position[2] + d - 0.6 * r;
  check_refused<few>(spheres, {Fault::overlap, 1, 0.6, 0.5});
  spheres = apart();
  spheres[3].position[0] = wall - r + 0.7 * r;
  check_refused<few>(spheres, {Fault::overlap, 3, 0.7, 0.5});
}

TEST_CASE("fault: coincident centres") {
  Spheres spheres = apart();
  spheres[2] = spheres[1];
  check_refused<few>(spheres, {Fault::overlap, 1, 2, 0.5});
}

TEST_CASE("fault: too deep an overlap during the run") {
  Spheres spheres = apart();
  spheres[1].velocity[2] = 3;  // 30 mm to sphere 2, then 2.5 mm into it: 32.5 mm at 3 m/s, or 5417 steps
  enter({soft::name, 0});
  Guarded<soft>& object = guarded<soft>();
  place_all(object.simulation, spheres);
  REQUIRE(object.simulation.start().ok());
  const Status status = object.simulation.run(100000);
  CHECK(status.fault == Fault::overlap);
  CHECK((status.particle == 1 || status.particle == 2));
  CHECK(status.value > 0.5);
  CHECK(status.value < 0.51);  // one or two steps of 1.2e-3 radii beyond
  CHECK(std::abs(static_cast<double>(status.step) - 5420) < 10);
  check_final(object.simulation, status);
  CHECK(object.intact());
  check_program<soft>(spheres, status);
}

TEST_CASE("fault: too fast") {
  Spheres spheres = apart();
  spheres[2].velocity[2] = 2000;  // 4 mm per step: 0.8 radii
  check_stopped<few>(spheres, {Fault::too_fast, 2, 0.8, 0.5}, 1, 0);
}

struct absurd_gas : cases::plug_u24 {
  static constexpr int particle_count = 4;
  static constexpr double gas_velocity = 1e300;  // its square is not finite
};
struct violent_gas : absurd_gas {
  static constexpr double gas_velocity = 1e100;  // solved, but the velocities that follow have no finite square
};

TEST_CASE("fault: a gas flow that cannot be solved, or that blows everything away") {
  Spheres spheres = apart();
  spheres[0].position[1] = -(wall - r) - 1e-6;  // on the bottom: a bed
  check_stopped<absurd_gas>(spheres, {Fault::gas_unsolved, -1, nan, 1e-9}, 0, 0);
  alarm(60);  // a state that is not finite must still be looked at in finite time
  check_stopped<violent_gas>(spheres, {Fault::non_finite, 0, nan, 0}, 1, 0);
  alarm(0);
}

TEST_CASE("fault: a good run touches nothing outside and reports no fault") {
  enter({few::name, 0});
  Guarded<few>& object = guarded<few>();
  place_all(object.simulation, apart());
  REQUIRE(object.simulation.start().ok());
  CHECK(object.simulation.run(1000).ok());
  CHECK(object.intact());
}

}  // namespace
}  // namespace fixdem::tests
