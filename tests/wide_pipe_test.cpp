// Pipes of any width: the densest packings fit every capacity; in wide ones nothing that grows with the section lies on
// the stack, and histories survive listing.
#include <pthread.h>
#include <sys/mman.h>

#include <algorithm>
#include <memory>

#include "cases/pipe_bed.hpp"
#include "kernel/fixdem.hpp"
#include "scenes.hpp"

namespace fixdem::tests {
namespace {

struct weightless : cases::pipe_bed {
  static constexpr double gravity[3] = {0, 0, 0};
  static constexpr Ends ends = Ends::closed;
  static constexpr bool energy_ledger = false;
};

/// Pairs of spheres side by side in layers across the pipe: a pair every 2.5 d along x and 1.5 d along y, `distance`
/// between its centres; the left one moves along y at `speed`.
template <class Case>
Spheres pairs_across(double distance, double speed) {
  constexpr double d = Case::diameter, reach = (Case::pipe_diameter - 8 * d) / 2;
  Spheres spheres;
  for (double z = 1.5 * d;; z += 1.5 * d) {
    for (double y = -reach; y < reach; y += 1.5 * d)
      for (double x = -reach; x < reach; x += 2.5 * d) {
        if (x * x + y * y > reach * reach) continue;
        if (static_cast<int>(spheres.size()) == Case::particle_count) return spheres;
        spheres.push_back({{x, y, z}, {0, speed, 0}, {0, 0, 0}});
        spheres.push_back({{x + distance, y, z}, {0, 0, 0}, {0, 0, 0}});
      }
  }
}

struct very_wide : weightless {
  static constexpr int particle_count = 60000;
  static constexpr double pipe_diameter = 300 * diameter, pipe_length = 20 * diameter;
};

TEST_CASE("wide pipe: 300 diameters need no large stack") {
  enter({very_wide::name, 0});
  auto simulation = std::make_unique<Simulation<very_wide>>();
  Spheres spheres = pairs_across<very_wide>(1.0001 * very_wide::diameter, 0.01);
  for (std::size_t i = 0; i < spheres.size(); i += 6)
    spheres[i].position[0] += 2e-4 * very_wide::diameter;  // these touch
  place_all(*simulation, spheres);
  const auto steps = [](void* made) -> void* {
    auto& running = *static_cast<Simulation<very_wide>*>(made);
    if (running.start().ok()) running.run(3);
    return nullptr;
  };
  // A quarter of a megabyte, and below it nothing that could be written to.
  constexpr std::size_t stack = 256 << 10, below = 64 << 20;
  void* const memory = mmap(nullptr, below + stack, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  REQUIRE(memory != MAP_FAILED);
  char* const top = static_cast<char*>(memory) + below;
  REQUIRE(mprotect(top, stack, PROT_READ | PROT_WRITE) == 0);
  pthread_attr_t attributes;
  pthread_t thread;
  REQUIRE(pthread_attr_init(&attributes) == 0);
  REQUIRE(pthread_attr_setstack(&attributes, top, stack) == 0);
  REQUIRE(pthread_create(&thread, &attributes, steps, simulation.get()) == 0);
  pthread_join(thread, nullptr);
  pthread_attr_destroy(&attributes);
  munmap(memory, below + stack);
  CHECK(simulation->status().ok());
  CHECK(simulation->step() == 3);
}

/// So soft that contacts last, and too rough to slide.
struct wide_and_soft : weightless {
  static constexpr int particle_count = 30000;
  static constexpr double pipe_diameter = 200 * diameter, pipe_length = 20 * diameter;
  static constexpr NormalLaw normal = NormalLaw::linear;
  static constexpr double normal_stiffness = 1, tangential_stiffness = 1, restitution = 1, friction = 100;
};

TEST_CASE("wide pipe: listing a range of tens of thousands of particles keeps every history") {
  using Case = wide_and_soft;
  enter({Case::name, 0});
  auto simulation = std::make_unique<Simulation<Case>>();
  place_all(*simulation, pairs_across<Case>(0.999 * Case::diameter, 1));
  start(*simulation);
  constexpr int steps = 160;
  run(*simulation, steps);
  CHECK(simulation->listings() > 0);
  int contacts = 0, short_ones = 0;
  simulation->for_each_contact([&](const Contact& c) {
    ++contacts;
    short_ones += length(c.history) < 0.9 * steps * Case::time_step;  // slip at 1 m/s
  });
  CHECK(contacts == Case::particle_count / 2);
  CHECK(short_ones == 0);
}

/// Visits the places of a hexagonal close packing of spheres of unit diameter, flat on z = 0, in a pipe of `ratio`.
template <class Place>
constexpr void for_each_packed(double ratio, int layers, Place&& place) {
  constexpr double row = 0.86602540378443865, offset = 0.28867513459481288, layer = 0.81649658092772603;
  const double reach = (ratio - 1) / 2;
  const int most = static_cast<int>(ratio) + 2;
  for (int k = 0; k < layers; ++k)
    for (int b = -most; b <= most; ++b)
      for (int a = -most; a <= most; ++a) {
        const double x = a + 0.5 * (b & 1) + 0.5 * (k & 1), y = row * b + offset * (k & 1);
        if (x * x + y * y <= reach * reach) place(x, y, 0.5 + layer * k);
      }
}
constexpr int packed_count(double ratio, int layers) {
  int count = 0;
  for_each_packed(ratio, layers, [&](double, double, double) { ++count; });
  return count;
}

/// `layers` flat layers on the start of a closed pipe.
template <int ratio, int layers>
struct packed_on_end : weightless {
  static constexpr int particle_count = packed_count(ratio, layers);
  static constexpr double pipe_diameter = ratio * diameter, pipe_length = (layers + 2) * diameter;
};
using two_layers = packed_on_end<17, 2>;
using full = packed_on_end<17, 24>;
using full_narrow = packed_on_end<5, 24>;
using full_wide = packed_on_end<40, 10>;

TEST_CASE_TEMPLATE("any pipe: a close packing flat on an end is within every capacity", Case, two_layers, full,
                   full_narrow, full_wide) {
  enter({Case::name, 0});
  Spheres spheres;
  constexpr double d = 0.9999 * Case::diameter;  // all touch
  for_each_packed(Case::pipe_diameter / Case::diameter, Case::particle_count, [&](double x, double y, double z) {
    if (static_cast<int>(spheres.size()) < Case::particle_count)
      spheres.push_back({{d * x, d * y, d * z}, {0, 0, 0}, {0, 0, 0}});
  });
  auto simulation = std::make_unique<Simulation<Case>>();
  place_all(*simulation, spheres);
  start(*simulation);
  run(*simulation, 3);
  for (int k = 0; k < simulation->high_water_count(); ++k)
    CHECK(simulation->high_water(k).high_water <= simulation->high_water(k).limit);
}

/// A single file, each sphere touching the wall on the side opposite to its neighbours'.
struct single_file : weightless {
  static constexpr int particle_count = 500;
  static constexpr double pipe_diameter = 1.05 * diameter, pipe_length = particle_count * diameter;
};

TEST_CASE("any pipe: a single file in a pipe barely wider than a sphere") {
  using Case = single_file;
  enter({Case::name, 0});
  Spheres spheres(Case::particle_count);
  for (int i = 0; i < Case::particle_count; ++i)
    spheres[i] = {
        {(i % 2 == 0 ? 0.025 : -0.025) * Case::diameter, 0, (0.5 + 0.9986 * i) * Case::diameter}, {0, 0, 0}, {0, 0, 0}};
  auto simulation = std::make_unique<Simulation<Case>>();
  place_all(*simulation, spheres);
  start(*simulation);
  run(*simulation, 3);
  CHECK(simulation->observe().contacts == Case::particle_count - 1);
}

/// No contact, no force: all fly along the pipe at one speed, so no list is ever used up.
struct flying_as_one : weightless {
  static constexpr int particle_count = 190;
  static constexpr Ends ends = Ends::periodic;
  static constexpr double pipe_length = 0.115;
};

TEST_CASE("any pipe: what flies as one is brought back into the pipe before it is a length away") {
  using Case = flying_as_one;
  enter({Case::name, seed()});
  Spheres spheres = layered_spheres<Case>(0.0115, 0, Random(seed()));
  constexpr double speed = 50;
  for (auto& sphere : spheres) sphere.velocity[2] = speed;
  auto simulation = std::make_unique<Simulation<Case>>();
  place_all(*simulation, spheres);
  start(*simulation);
  double farthest = 0;
  constexpr int steps = static_cast<int>(3 * Case::pipe_length / (speed * Case::time_step));
  for (int k = 0; k < steps; k += 10) {
    run(*simulation, 10);
    for (const auto& position : simulation->state().particles.position) farthest = std::max(farthest, position[2]);
  }
  CHECK(farthest < 2 * Case::pipe_length);
  CHECK(simulation->observe().contacts == 0);
  CHECK(simulation->image(0) >= 2);
}

}  // namespace
}  // namespace fixdem::tests
