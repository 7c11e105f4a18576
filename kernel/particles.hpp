// The particles: rows of what is looked up by number, sorted along the pipe.
//
// A row of positions is x, y, z and a pad (32 bytes); a row of motion is velocity, pad, radius times angular velocity,
// pad (64 bytes; without friction there is no rotation and the row is 32). Particles are renumbered by z whenever the
// near list is renewed, so neighbours in space are neighbours in memory; `id` keeps the number in input order. With the
// leapfrog, positions are held half a step ahead of velocities, and the last change of velocity is kept for prediction
// (with impulses the contacts keep what they need of the last step themselves).
// In mixed precision contacts look up a copy of the motion in floats.
#pragma once

#include "coupling.hpp"

namespace fixdem {

/// A particle as the user sees it.
struct Particle {
  double position[3];          ///< m; x horizontal, y up, z along the pipe
  double velocity[3];          ///< m/s
  double angular_velocity[3];  ///< rad/s
};

namespace detail {
template <int Count, bool present>
struct RowsOf4 {
  alignas(64) double row[Count][4];
};
template <int Count>
struct RowsOf4<Count, false> {};

template <int Count, int Width, bool present>
struct FloatRows {
  alignas(64) float row[Count][Width];
};
template <int Count, int Width>
struct FloatRows<Count, Width, false> {};
}  // namespace detail

template <class Case>
struct Particles {
  using D = Derived<Case>;
  static constexpr int count = Case::particle_count;
  static constexpr int motion_width = D::has_rotation ? 8 : 4;
  static constexpr bool predicts = Case::integrator == Integrator::leapfrog;

  alignas(64) double position[count][4];
  alignas(64) double motion[count][motion_width];
  [[no_unique_address]] detail::FloatRows<count, motion_width, is_mixed<Case>> motion_as_float;
  [[no_unique_address]] detail::RowsOf4<count, predicts> last_kick;      ///< velocity change of the last step
  [[no_unique_address]] detail::RowsOf4<count, Case::has_gas> gas_kick;  ///< velocity change per step by the gas
  [[no_unique_address]] Coupling<Case> coupling;
  int id[count];
  int image[count];  ///< crossings of the periodic ends

  /// Motion as contacts look it up, from row `first` on.
  const Real<Case>* looked_up_motion(int first) const {
    if constexpr (is_mixed<Case>)
      return motion_as_float.row[first];
    else
      return motion[first];
  }
  /// Brings what contacts look up in line with `motion`; the step does so itself.
  void note_motion([[maybe_unused]] int i) {
    if constexpr (is_mixed<Case>)
      for (int c = 0; c < motion_width; ++c) motion_as_float.row[i][c] = static_cast<float>(motion[i][c]);
  }
};

}  // namespace fixdem
