// The small scene in which each feature of a case is switched on and off: 133 spheres in seven layers of a short pipe.
//
// Dense (0.44) and agitated (+-0.5 m/s with spins to match), so within the 2 ms compared contacts begin, end, slide and
// stick by the dozen; before that the kernel runs it for 6 ms, so that histories are not empty.
#pragma once

#include "agreement.hpp"
#include "cases/pipe_bed.hpp"

namespace fixdem::tests {

struct small_periodic : cases::pipe_bed {
  static constexpr int particle_count = 133;
  static constexpr double pipe_length = 0.08;
  static constexpr int slice_count = 8;
};

struct small_closed : small_periodic {
  static constexpr Ends ends = Ends::closed;
};

/// `Case` differs from one of the above in what is compared.
template <class Case>
Events check_small(const char* what, long long steps_before = 3000) {
  const Spheres spheres = layered_spheres<Case>(Case::pipe_length / 7, 0.5, Random(seed()));
  const Events events = check_after<Case>(spheres, steps_before, what);
  CHECK(events.begun > 0);
  CHECK(events.ended > 0);
  if (Derived<Case>::has_rotation) {
    CHECK(events.sliding > 0);
    CHECK(events.sticking > 0);
  }
  return events;
}

}  // namespace fixdem::tests
