// The small scenes with gas in which each of its options is switched on and off.
#pragma once

#include "cases/plug_u24.hpp"
#include "small_scene.hpp"

namespace fixdem::tests {

struct small_gas : cases::plug_u24 {
  static constexpr int particle_count = 133;
  static constexpr double pipe_length = 0.10;
  static constexpr int slice_count = 10;
  static constexpr int gas_update_interval = 1, gas_floater_interval = 1;
};
/// A layer with room above it: slices of every kind, full, partly filled and empty, and floaters.
struct thin_gas : small_gas {
  static constexpr int particle_count = 90;
  static constexpr double pipe_length = 0.25;
  static constexpr int slice_count = 25;
};

/// Layers that fill the pipe.
template <class Case>
Events check_dense(const char* what) {
  return check_after<Case>(layered_spheres<Case>(Case::pipe_length / 7, 0.5, Random(seed())), 3000, what);
}
/// Dilute at first; after 60 ms some lie at the bottom and some still fly.
template <class Case>
Events check_dilute(const char* what) {
  const Events events = check_after<Case>(random_spheres<Case>(0.5, Random(seed())), 30000, what);
  CHECK(events.begun > 0);
  CHECK(events.ended > 0);
  return events;
}

}  // namespace fixdem::tests
