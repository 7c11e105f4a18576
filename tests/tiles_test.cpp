// Steps that are worked off together give the same bytes as steps one by one.
//
// A tile's depth never exceeds the steps asked for, so run(1) again and again is the plain order, and run(many) is
// tiles as deep as the case allows. Agitated pipes of some dozens of chunks, periodic (where tiles have a wedge around
// the cut), closed, with gas (where they end at its updates), and open (where they end at feeding events, and particles
// leave within them), with contacts that begin and end and ranges that are listed anew within tiles; every particle and
// the energy ledger are compared byte by byte.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <memory>

#include "cases/pipe_bed.hpp"
#include "cases/plug_u24.hpp"
#include "kernel/fixdem.hpp"
#include "line_scenes.hpp"
#include "mixed.hpp"

using namespace fixdem;
using namespace fixdem::tests;

namespace {

/// `layers` layers of 19 spheres 1.15 diameters apart.
template <class Base, int layers>
struct long_pipe : Base {
  static constexpr int particle_count = 19 * layers;
  static constexpr double pipe_length = layers * 0.0115;
  static constexpr int slice_count = layers;
};
struct periodic : long_pipe<cases::pipe_bed, 200> {
  static constexpr int tile_steps = 8;
};
struct deep : long_pipe<cases::pipe_bed, 280> {
  static constexpr int tile_steps = 16;
};
struct closed : periodic {
  static constexpr Ends ends = Ends::closed;
};
struct with_gas : long_pipe<cases::plug_u24, 200> {
  static constexpr int tile_steps = 8;
};
struct mixed : in_mixed_precision<periodic> {};
struct smooth_mixed : mixed {
  static constexpr double friction = 0;
};
struct smooth_leapfrog : periodic {
  static constexpr double friction = 0;
  static constexpr auto integrator = Integrator::leapfrog;
};

/// A line whose feed section is empty at the start, and whose last layer is about to leave.
template <class Base>
struct opened : Base {
  static constexpr Ends ends = Ends::open;
  static constexpr int start_count = Base::particle_count, particle_count = start_count + 200;
  static constexpr TimeValue feed_rate[] = {{0, 5}};
  static constexpr double feed_start = 0, feed_length = 0.1, feed_velocity = 0.5;
  static constexpr unsigned long long feed_seed = 1;
  static constexpr int feed_interval = 100;
  static constexpr double pipe_length = Base::pipe_length + 1.05 * feed_length - 0.5 * 0.0115;
};
struct line : opened<periodic> {};
struct line_with_gas : opened<with_gas> {};
struct mixed_leapfrog_line : opened<mixed> {
  static constexpr auto integrator = Integrator::leapfrog;
};

template <class Case>
std::unique_ptr<Simulation<Case>> started() {
  auto simulation = std::make_unique<Simulation<Case>>();
  Spheres spheres = layered_spheres<Placing<Case>>(0.0115, 0.5, Random(seed()));
  if constexpr (is_line<Case>)
    for (Sphere& s : spheres)
      s.position[2] = std::min(s.position[2] + 1.05 * Case::feed_length, Case::pipe_length - 1e-6);
  place_all(*simulation, spheres);
  start(*simulation);
  return simulation;
}

}  // namespace

TEST_CASE_TEMPLATE("tiles: the same bytes as step by step", Case, periodic, deep, closed, with_gas, mixed, smooth_mixed,
                   smooth_leapfrog, line, line_with_gas, mixed_leapfrog_line) {
  enter({Case::name, seed()});
  static_assert(Capacity<Case>::chunks >= 24);
  auto together = started<Case>(), one_by_one = started<Case>();
  // Long enough for ranges to be listed anew (every 100 steps or so) and for the order to be made anew (every 500).
  constexpr int steps = 1500;
  run(*together, steps);
  for (int k = 0; k < steps; ++k) run(*one_by_one, 1);
  CHECK(together->sorts() > 1);
  CHECK(together->listings() > 10 * Capacity<Case>::chunks);
  CHECK(together->sorts() == one_by_one->sorts());
  CHECK(together->listings() == one_by_one->listings());
  int different = 0;
  for (int id = 0; id < Case::particle_count; ++id) {
    different += together->is_present(id) != one_by_one->is_present(id);
    if (!together->is_present(id)) continue;
    const Particle a = together->particle(id), b = one_by_one->particle(id);
    different += std::memcmp(&a, &b, sizeof a) != 0;
  }
  CHECK(different == 0);
  const Energy a = together->energy(), b = one_by_one->energy();
  CHECK(std::memcmp(&a, &b, sizeof a) == 0);
  CHECK(a.dissipated_damping != 0);
  if constexpr (is_line<Case>) {
    const LineTotals s = together->line(), t = one_by_one->line();
    CHECK(std::memcmp(&s, &t, sizeof s) == 0);
    CHECK(s.fed > 10);
    CHECK(s.left > 3);
  }
}

TEST_CASE_TEMPLATE("tiles: the rows of every step are aligned to the widest register", Case, periodic, mixed,
                   smooth_mixed, smooth_leapfrog) {
  auto simulation = std::make_unique<Simulation<Case>>();
  for (int step = 0; step < Case::tile_steps; ++step)
    CHECK(reinterpret_cast<std::uintptr_t>(simulation->state().contacts.ring(step)) % 64 == 0);
}

TEST_CASE("tiles: a fault within a tile is reported as step by step") {
  auto together = started<periodic>(), one_by_one = started<periodic>();
  run(*together, 40);
  run(*one_by_one, 40);
  // A blow that drives one particle through its neighbour.
  for (auto* simulation : {together.get(), one_by_one.get()}) simulation->state().particles.motion[700][1] = 300;
  const Status a = together->run(64);
  Status b;
  for (int k = 0; k < 64 && b.ok(); ++k) b = one_by_one->run(1);
  CHECK(!a.ok());
  CHECK(a.fault == b.fault);
  CHECK(a.step == b.step);
  CHECK(a.value == b.value);
}

TEST_CASE("tiles: with another span the row of zeros of every ring holds zeros") {
  using Case = periodic;
  auto simulation = std::make_unique<Simulation<Case>>();
  auto& contacts = simulation->state().contacts;
  for (int span = Capacity<Case>::span; span >= 1; --span) {
    for (double& number : contacts.rows) number = 1;
    contacts.set_span(span);
    const int depth =
        Contacts<Case>::rows_for(span, Case::tile_steps) <= Contacts<Case>::row_count ? Case::tile_steps : 1;
    double sum = 0;
    for (int step = 0; step < depth; ++step)
      for (int c = 0; c < Contacts<Case>::row_width; ++c)
        sum += contacts.ring(step)[Rows<Case>::zero * Contacts<Case>::row_width + c];
    CHECK(sum == 0);
  }
}
