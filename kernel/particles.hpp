// The particles: rows of what is looked up by number, sorted along the pipe.
//
// A row of positions is x, y, z and a pad (32 bytes); a row of motion is velocity, pad, radius times angular velocity,
// pad (64 bytes; without friction there is no rotation and the row is 32). Particles are renumbered by z whenever the
// near list is renewed, so neighbours in space are neighbours in memory; `id` keeps the number in input order. With the
// leapfrog, positions are held half a step ahead of velocities, and the last change of velocity is kept for prediction.
#pragma once

#include "case.hpp"

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
}  // namespace detail

template <class Case>
struct Particles {
  using D = Derived<Case>;
  static constexpr int count = Case::particle_count;
  static constexpr int motion_width = D::has_friction ? 8 : 4;
  static constexpr bool predicts = Case::integrator == Integrator::leapfrog;

  alignas(64) double position[count][4];
  alignas(64) double motion[count][motion_width];
  [[no_unique_address]] detail::RowsOf4<count, predicts> last_kick;      ///< velocity change of the last step
  [[no_unique_address]] detail::RowsOf4<count, Case::has_gas> gas_kick;  ///< velocity change per step by the gas
  int id[count];
  int image[count];  ///< crossings of the periodic ends
};

}  // namespace fixdem
