// Kernel against reference on the real scenes, 1000 steps: a settled bed, an agitated start, a plug with gas.
#include "agreement.hpp"

#include "cases/pipe_bed.hpp"
#include "cases/plug_u24.hpp"

namespace fixdem::tests {
namespace {

/// 300 particles at the density of pipe_bed.
struct short_bed : cases::pipe_bed {
  static constexpr int particle_count = 300;
  static constexpr double pipe_length = 0.24;
  static constexpr int slice_count = 24;
};

TEST_CASE("agreement: a settled bed") {
  enter({short_bed::name, seed()});
  const Spheres spheres = layered_spheres<short_bed>(short_bed::pipe_length / 16, 0.5, Random(seed()));
  const Events events = check_after<short_bed>(spheres, 200000, "bed after 0.4 s, N = 300");
  // It has settled (root mean square speed below 5 mm/s), touches on all sides and mostly sticks.
  const Observation seen = kernel<short_bed>().observe();
  CHECK(seen.kinetic_translation < short_bed::particle_count * 0.5 * Derived<short_bed>::mass * 2.5e-5);
  CHECK(seen.coordination_number > 3);
  CHECK(events.sticking > events.sliding);
}

TEST_CASE("agreement: the agitated start of pipe_bed") {
  enter({cases::pipe_bed::name, seed()});
  const Spheres spheres = layered_spheres<cases::pipe_bed>(cases::pipe_bed::pipe_length / 53, 0.5, Random(seed()));
  HandOver start;
  start.spheres = spheres;
  check_agreement<cases::pipe_bed>(start, "pipe_bed from its first step, N = 1000");
  const Events events = check_after<cases::pipe_bed>(spheres, 5000, "pipe_bed after 10 ms, N = 1000");
  CHECK(events.begun > 100);
  CHECK(events.ended > 100);
  CHECK(events.sliding > 50);
  CHECK(events.sticking > 50);
}

TEST_CASE("agreement: a plug with gas") {
  enter({cases::plug_u24::name, seed()});
  // 0.55 m of layers as close as they fit; within 50 ms they pack, the gas moves them and the rear comes apart.
  const Spheres spheres = layered_spheres<cases::plug_u24>(0.0102, 0.3, Random(seed()));
  const Events events = check_after<cases::plug_u24>(spheres, 25000, "plug_u24 after 50 ms, N = 1000");
  CHECK(events.begun > 100);
  CHECK(events.ended > 100);
  CHECK(events.sliding > 50);
  CHECK(events.sticking > 50);
  int full = 0, partly = 0, empty = 0;
  for (int s = 0; s < cases::plug_u24::slice_count; ++s) {
    const double area = kernel<cases::plug_u24>().bed_area(s), section = 3.14159265 / 4 * 0.05 * 0.05;
    (area <= 0 ? empty : area < 0.999 * section ? partly : full) += 1;
  }
  CHECK(full > 0);
  CHECK(partly > 0);
  CHECK(empty > 0);
}

}  // namespace
}  // namespace fixdem::tests
