// The scenes in which the kernel meets the reference, for either precision: a settled bed, an agitated start, a plug
// with gas.
#pragma once

#include "agreement.hpp"
#include "cases/pipe_bed.hpp"
#include "cases/plug_u24.hpp"

namespace fixdem::tests {

/// 300 particles at the density of pipe_bed.
struct short_bed : cases::pipe_bed {
  static constexpr int particle_count = 300;
  static constexpr double pipe_length = 0.24;
  static constexpr int slice_count = 24;
};

/// `Case`: short_bed.
template <class Case>
void check_settled_bed() {
  enter({Case::name, seed()});
  const Spheres spheres = layered_spheres<Case>(Case::pipe_length / 16, 0.5, Random(seed()));
  const Events events = check_after<Case>(spheres, 300000, "bed after 0.6 s, N = 300");
  // It has settled (root mean square speed below 5 mm/s), touches on all sides and mostly sticks.
  const Observation seen = kernel<Case>().observe();
  CHECK(seen.kinetic_translation < Case::particle_count * 0.5 * Derived<Case>::mass * 2.5e-5);
  CHECK(seen.coordination_number > 3);
  CHECK(events.sticking > events.sliding);
}

/// `Case`: pipe_bed.
template <class Case>
void check_agitated_start() {
  enter({Case::name, seed()});
  const Spheres spheres = layered_spheres<Case>(Case::pipe_length / 53, 0.5, Random(seed()));
  HandOver start;
  start.spheres = spheres;
  check_agreement<Case>(start, "pipe_bed from its first step, N = 1000", agitated_tolerance<Case>);
  const Events events = check_after<Case>(spheres, 5000, "pipe_bed after 10 ms, N = 1000", agitated_tolerance<Case>);
  CHECK(events.begun > 100);
  CHECK(events.ended > 100);
  CHECK(events.sliding > 50);
  CHECK(events.sticking > 50);
}

/// `Case`: plug_u24.
template <class Case>
void check_plug() {
  enter({Case::name, seed()});
  // 0.55 m of layers as close as they fit; within 50 ms they pack, the gas moves them and the rear comes apart.
  const Spheres spheres = layered_spheres<Case>(0.0102, 0.3, Random(seed()));
  const Events events = check_after<Case>(spheres, 25000, "plug_u24 after 50 ms, N = 1000", agitated_tolerance<Case>);
  CHECK(events.begun > 100);
  CHECK(events.ended > 100);
  CHECK(events.sliding > 50);
  CHECK(events.sticking > 50);
  int full = 0, partly = 0, empty = 0;
  for (int s = 0; s < Case::slice_count; ++s) {
    const double area = kernel<Case>().bed_area(s), section = 3.14159265 / 4 * 0.05 * 0.05;
    (area <= 0 ? empty : area < 0.999 * section ? partly : full) += 1;
  }
  CHECK(full > 0);
  CHECK(partly > 0);
  CHECK(empty > 0);
}

}  // namespace fixdem::tests
