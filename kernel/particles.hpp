// The particles: rows of what is looked up by number, sorted along the pipe.
//
// A row of positions is x, y, z and a pad (32 bytes); a row of motion is velocity, pad, radius times angular velocity,
// pad (64 bytes; without friction there is no rotation and the row is 32). Particles are renumbered by z whenever the
// near list is renewed, so neighbours in space are neighbours in memory; `id` keeps the number in input order. With the
// leapfrog, positions are held half a step ahead of velocities, and the last change of velocity is kept for prediction
// (with impulses the contacts keep what they need of the last step themselves).
// In mixed precision contacts look up a copy of the motion in floats.
//
// With several sizes the pads hold what a particle is: the radius in its position's, m_0/m and r_0/r in its motion's,
// m_0 and r_0 being those of the sphere of reference (case.hpp). Otherwise they are zero.
#pragma once

#include "coupling.hpp"

namespace fixdem {

/// A particle as the user sees it.
struct Particle {
  double position[3];          ///< m; x horizontal, y up, z along the pipe
  double velocity[3];          ///< m/s
  double angular_velocity[3];  ///< rad/s
};

/// Radius of the sphere of a row of positions, m.
template <class Case>
double radius_at([[maybe_unused]] const double* row) {
  if constexpr (has_sizes<Case>)
    return row[3];
  else
    return Derived<Case>::reference_radius;
}

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
  static constexpr int motion_width = D::has_rotation || has_sizes<Case> ? 8 : 4;
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

/// Mass of the particle of a row in units of the mass of reference.
template <class Case>
double share_of_mass(const Particles<Case>& p, int i) {
  if constexpr (has_sizes<Case>)
    return 1 / p.motion[i][3];
  else
    return 1;
}

/// Fills the pads of a row by what particle `id` is.
template <class Case>
void set_size(Particles<Case>& p, int row, int id) {
  using D = Derived<Case>;
  p.position[row][3] = radius_of<Case>(id);
  p.motion[row][3] = D::reference_mass / mass_of<Case>(id);
  p.motion[row][7] = D::reference_radius / radius_of<Case>(id);
}

/// Whether the pads of a row are those of its particle.
template <class Case>
bool has_its_size(const Particles<Case>& p, int row) {
  using D = Derived<Case>;
  if constexpr (has_sizes<Case>)
    return p.position[row][3] == radius_of<Case>(p.id[row]) &&
           p.motion[row][3] == D::reference_mass / mass_of<Case>(p.id[row]) &&
           p.motion[row][7] == D::reference_radius / radius_of<Case>(p.id[row]);
  else
    return true;
}

}  // namespace fixdem
