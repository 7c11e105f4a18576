// Neighbours of spheres of very different sizes: every contact is found, and a large sphere covered with small ones has
// room for all of them.
#include <cmath>
#include <memory>
#include <numbers>
#include <set>
#include <utility>

#include "kernel/fixdem.hpp"
#include "listed_sizes.hpp"
#include "scenes.hpp"

namespace fixdem::tests {
namespace {

/// A sphere of 10 mm in the middle, and around it as many of a `ratio`-th as a spiral with places 3.09 over the root of
/// their number apart has room for.
template <int ratio, int around>
struct covered {
  static constexpr const char* name = "a large sphere covered with small ones";
  static constexpr int species_count = 2;
  static constexpr const char* species_names[] = {"large", "small"};
  static constexpr SizeRun sizes[] = {{1, 0.010, 1000, 0}, {around, 0.010 / ratio, 1000, 1}};
};
template <int capacity>
struct weightless : short_pipe {
  static constexpr double gravity[3] = {0, 0, 0};
  static constexpr double time_step = 1e-8;
  static constexpr int neighbour_capacity = capacity;
};

template <int ratio, int around, int capacity>
void check_covered() {
  using Case = sized<covered<ratio, around>, weightless<capacity>>;
  CAPTURE(ratio);
  constexpr double r = Case::largest_diameter / 2, s = Case::smallest_diameter / 2, length = Case::pipe_length;
  // On either side of the periodic ends, and far from them: the large sphere first in the order, last, or in between.
  for (const double z : {0.5 * length, 0.001 * length, 0.999 * length}) {
    CAPTURE(z);
    auto simulation = std::make_unique<Simulation<Case>>();
    simulation->place(0, {{0, 0, z}, {}, {}});
    const double turn = std::numbers::pi * (3 - std::sqrt(5.0)), distance = (r + s) * (1 - 1e-7);
    for (int k = 0; k < around; ++k) {
      const double up = 1 - (2 * k + 1.0) / around, across = std::sqrt(1 - up * up);
      double at = z + distance * up;
      at += at < 0 ? length : (at >= length ? -length : 0);
      simulation->place(1 + k,
                        {{distance * across * std::cos(k * turn), distance * across * std::sin(k * turn), at}, {}, {}});
    }
    REQUIRE(simulation->start().ok());
    REQUIRE(simulation->run(1).ok());
    int touching = 0;
    simulation->for_each_contact([&](const Contact& c) { touching += c.owner == 0 || c.partner == 0; });
    CHECK(touching == around);
    CHECK(simulation->high_water(0).high_water >= around);
    CHECK(simulation->high_water(0).high_water <= capacity);
  }
}

TEST_CASE("several sizes: a large sphere covered with small ones exceeds no capacity") {
  // As casegen sets it: min(160, ceil(1.8 / (1 - c)) + 1), c = sqrt(1 - 1 / (1 + ratio)^2).
  check_covered<1, 9, 14>();
  check_covered<2, 21, 33>();
  check_covered<5, 85, 130>();
  check_covered<8, 159, 160>();
}

/// 10, 3 and 1 mm.
struct far_apart {
  static constexpr const char* name = "three sizes far apart";
  static constexpr int species_count = 3;
  static constexpr const char* species_names[] = {"large", "middle", "small"};
  static constexpr SizeRun sizes[] = {{8, 0.010, 1000, 0}, {80, 0.003, 1000, 1}, {1200, 0.001, 1000, 2}};
};
template <Ends kind>
struct crowded : short_pipe {
  static constexpr double pipe_diameter = 0.025, pipe_length = 0.045, time_step = 4e-7;
  static constexpr Ends ends = kind;
  static constexpr int neighbour_capacity = 160;
};

/// Pairs with overlap, by looking at all.
template <class Case>
std::set<std::pair<int, int>> touching_pairs(const Simulation<Case>& simulation) {
  std::set<std::pair<int, int>> pairs;
  for (int i = 0; i < Case::particle_count; ++i)
    for (int j = i + 1; j < Case::particle_count; ++j) {
      const Particle a = simulation.particle(i), b = simulation.particle(j);
      const double between[3] = {a.position[0] - b.position[0], a.position[1] - b.position[1],
                                 axial_difference<Case>(a.position[2], b.position[2])};
      const double touch = radius_of<Case>(i) + radius_of<Case>(j);
      if (dot(between, between) < touch * touch) pairs.insert({i, j});
    }
  return pairs;
}

template <class Case>
void check_all_found() {
  auto simulation = std::make_unique<Simulation<Case>>();
  const Spheres spheres = random_spheres<Case>(1, Random(seed()));
  for (int id = 0; id < Case::particle_count; ++id) {
    Particle p{};
    for (int c = 0; c < 3; ++c) {
      p.position[c] = spheres[static_cast<std::size_t>(id)].position[c];
      p.velocity[c] = spheres[static_cast<std::size_t>(id)].velocity[c];
    }
    simulation->place(id, p);
  }
  REQUIRE(simulation->start().ok());
  std::set<std::pair<int, int>> kinds;  // species that have been seen to touch
  for (int look = 0; look < 20; ++look) {
    REQUIRE(simulation->run(1000).ok());
    std::set<std::pair<int, int>> listed;
    simulation->for_each_contact([&](const Contact& c) {
      if (c.partner >= 0) listed.insert(std::minmax(c.owner, c.partner));
    });
    CHECK(listed == touching_pairs(*simulation));
    for (const auto& [i, j] : listed) kinds.insert(std::minmax(species_of<Case>(i), species_of<Case>(j)));
  }
  CHECK(simulation->sorts() > 20);
  CHECK(kinds.size() >= 5);  // of six
}

TEST_CASE("several sizes: every contact of spheres of 10, 3 and 1 mm is found") {
  enter({"three sizes far apart", seed()});
  check_all_found<sized<far_apart, crowded<Ends::periodic>>>();
  check_all_found<sized<far_apart, crowded<Ends::closed>>>();
}

}  // namespace
}  // namespace fixdem::tests
