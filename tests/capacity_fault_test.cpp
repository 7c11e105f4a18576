// What exceeds a capacity: each fault names its kind, step, particle, value and limit, at the start and during a run.
#include "fault_checks.hpp"

namespace fixdem::tests {
namespace {

struct two_neighbours : few {
  static constexpr int neighbour_capacity = 2;
};

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
  // 49 pairs of the first two planes, then 1 + 7 * 2 of the third: number 65 is the first of its 9th sphere.
  const int limit = Capacity<zigzag>::chunk_pairs;
  REQUIRE(limit == 64);
  check_refused<zigzag>(planes(0.6), {Fault::pair_capacity, 58, limit + 1.0, static_cast<double>(limit)});
}

TEST_CASE("fault: more pairs than a chunk holds, during the run") {
  Spheres spheres = planes(0.9);
  for (int k = 75; k < 100; ++k) spheres[k].velocity[2] = -1;
  // Near from a distance of 1.015 d on: after 2.75 mm along z, or 1376 steps; listed when 0.015 d are used up.
  const int limit = Capacity<zigzag>::chunk_pairs;
  check_stopped<zigzag>(spheres, {Fault::pair_capacity, 58, limit + 1.0, static_cast<double>(limit)}, 1414, 50);
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
      renew<squeezed, native_lanes>(s.contacts, s.near_list, s.particles, s.before.kept, s.scratch, s.line, s.step);
  check_status(status, {Fault::history_capacity, -1, static_cast<double>(contacts), static_cast<double>(limit)});
  CHECK(guarded<squeezed>().intact());
}

}  // namespace
}  // namespace fixdem::tests
