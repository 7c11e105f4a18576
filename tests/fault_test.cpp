// What stops a run: each fault names the right kind, step, particle, value and limit; it is final; no byte outside the
// simulation is touched (writes between its arrays are for the sanitizers: make test SAN=1); and the program around it
// stops at the last good step.
#include <unistd.h>

#include <limits>

#include "cases/pipe_bed.hpp"
#include "cases/plug_u24.hpp"
#include "fault_checks.hpp"

namespace fixdem::tests {
namespace {

struct few : cases::pipe_bed {
  static constexpr int particle_count = 4;
  static constexpr double gravity[3] = {0, 0, 0};
  static constexpr double pipe_length = 0.2;
};
struct two_neighbours : few {
  static constexpr int neighbour_capacity = 2;
};
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

constexpr double d = few::diameter, r = d / 2, wall = few::pipe_diameter / 2;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Four spheres well apart, at rest.
Spheres apart() {
  Spheres spheres(4);
  for (int k = 0; k < 4; ++k) spheres[k].position[2] = 0.02 + 0.04 * k;
  return spheres;
}

TEST_CASE("fault: more neighbours than the capacity, at the start") {
  Spheres spheres = apart();  // 2 in the middle of 0, 1 and 3, which are apart
  const double centre = 0.1, places[4][3] = {{0, d, centre}, {0, -d, centre}, {0, 0, centre}, {0, 0, centre + d}};
  for (int k = 0; k < 4; ++k) std::memcpy(spheres[k].position, places[k], sizeof places[k]);
  check_refused<two_neighbours>(spheres, {Fault::neighbour_capacity, 2, 3, 2});
}

TEST_CASE("fault: more neighbours than the capacity, during the run") {
  Spheres spheres = apart();  // 3 flies towards 2, which has two neighbours already
  const double places[4][3] = {{0, d, 0.1}, {0, -d, 0.1}, {0, 0, 0.1}, {0, 0, 0.1 + 2 * d}};
  for (int k = 0; k < 4; ++k) std::memcpy(spheres[k].position, places[k], sizeof places[k]);
  spheres[3].velocity[2] = -1;
  // 10 mm to go, less the margin of the list (0.04 d at most): between 4600 and 5000 steps.
  check_stopped<two_neighbours>(spheres, {Fault::neighbour_capacity, 2, 3, 2}, 4850, 200);
}

/// Planes of 25 spheres; each sphere of the first plane touches two of the second, those of the third two of the
/// fourth.
struct zigzag : few {
  static constexpr int particle_count = 100;
  static constexpr bool has_wall = false;
  static constexpr int neighbour_capacity = 2;
};

/// `gap`: between the third and the fourth plane, in diameters.
Spheres planes(double gap) {
  Spheres spheres(100);
  for (int k = 0; k < 100; ++k) {
    const int plane = k / 25;
    spheres[k].position[0] = 1.6 * d * (k % 25) + (plane % 2 == 0 ? 0 : 0.8 * d);
    spheres[k].position[2] = 0.1 + (plane == 3 ? 1.3 + gap : plane / 2 * 1.3 + plane % 2 * 0.6) * d;
  }
  return spheres;
}

TEST_CASE("fault: more pairs than a chunk holds, at the start") {
  REQUIRE(Capacity<zigzag>::chunk_size == 64);
  // 49 pairs of the first two planes, then 1 + 11 * 2 of the third: number 73 is the first of its 13th sphere.
  const int limit = Capacity<zigzag>::chunk_pairs;
  REQUIRE(limit == 72);
  check_refused<zigzag>(planes(0.6), {Fault::pair_capacity, 62, limit + 1.0, static_cast<double>(limit)});
}

TEST_CASE("fault: more pairs than a chunk holds, during the run") {
  Spheres spheres = planes(0.9);
  for (int k = 75; k < 100; ++k) spheres[k].velocity[2] = -1;
  // Near from a distance of 1.015 d on: after 2.75 mm along z, or 1376 steps; listed when 0.015 d are used up.
  const int limit = Capacity<zigzag>::chunk_pairs;
  check_stopped<zigzag>(spheres, {Fault::pair_capacity, 62, limit + 1.0, static_cast<double>(limit)}, 1414, 50);
}

/// More spheres beside each other than the pipe could hold: only without its wall.
struct crowd : few {
  static constexpr int particle_count = 400;
  static constexpr bool has_wall = false;
};

/// 200 beside each other, 200 more `further` along (in diameters).
Spheres crowded(double further) {
  Spheres spheres(400);
  for (int k = 0; k < 400; ++k) {
    spheres[k].position[0] = 2 * d * (k % 200);
    spheres[k].position[2] = 0.1005 + (k < 200 ? 0 : further * d);
  }
  return spheres;
}

TEST_CASE("fault: more particles beside each other than are compared, at the start") {
  const int limit = Capacity<crowd>::in_reach;
  REQUIRE(limit < 199);
  // The first sphere and its partner have a cell of their own; between all others and theirs lie 198.
  check_refused<crowd>(crowded(1.1), {Fault::chunk_capacity, 1, 199, static_cast<double>(limit)});
}

TEST_CASE("fault: more particles beside each other than are compared, during the run") {
  Spheres spheres = crowded(1.9);
  for (int k = 200; k < 400; ++k) spheres[k].velocity[2] = -1;
  // Within the outer margin at 1.25 d: after 6.5 mm or 3250 steps; sorted whenever they have come 2.5 mm nearer.
  const int limit = Capacity<crowd>::in_reach;
  check_stopped<crowd>(spheres, {Fault::chunk_capacity, 1, 199, static_cast<double>(limit)}, 3700, 100);
}

/// A body-centred cubic lattice whose spheres touch eight neighbours in the corners of a cube and six beyond its faces:
/// more than the twelve of spheres that do not overlap.
struct squeezed : few {
  static constexpr int cells = 12, layers = 6, particle_count = 2 * cells * cells * layers;
  static constexpr int neighbour_capacity = 20;
  static constexpr bool has_wall = false;
  static constexpr double edge = 0.99 * diameter, pipe_length = layers * edge, pipe_diameter = 2 * cells * edge;
};

TEST_CASE("fault: more contacts than spheres that do not overlap can have") {
  Spheres spheres;
  Random random(seed());
  for (int k = 0; k < squeezed::particle_count; ++k) {
    const int cell = k / 2, x = cell % squeezed::cells, y = cell / squeezed::cells % squeezed::cells;
    const double half = 0.5 * (k % 2), z = cell / (squeezed::cells * squeezed::cells);
    Sphere sphere{};
    for (double& v : sphere.velocity) v = random(-0.1, 0.1);  // so that all springs are stretched
    const double place[3] = {x + half - 0.5 * squeezed::cells, y + half - 0.5 * squeezed::cells, z + half};
    for (int c = 0; c < 3; ++c) sphere.position[c] = place[c] * squeezed::edge;
    spheres.push_back(sphere);
  }
  auto& simulation = guarded<squeezed>().simulation;
  place_all(simulation, spheres);
  REQUIRE(simulation.start().ok());
  int contacts = 0;  // a step drives some of them apart
  simulation.for_each_contact([&](const Contact&) { ++contacts; });
  REQUIRE(simulation.run(1).ok());
  constexpr int limit = Capacity<squeezed>::histories;
  REQUIRE(contacts > limit);
  auto& s = simulation.state();
  const Status status =
      renew<squeezed, native_lanes>(s.contacts, s.near_list, s.particles, s.before.kept, s.scratch, s.step);
  check_status(status, {Fault::history_capacity, -1, static_cast<double>(contacts), static_cast<double>(limit)});
  CHECK(guarded<squeezed>().intact());
}

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
