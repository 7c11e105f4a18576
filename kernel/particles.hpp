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
//
// In a line (feed.hpp, outlet.hpp) the arrays have room for `count` particles and the first `rows()` rows are in use. A
// particle that has left keeps its row until particles are sorted, parked far behind the outlet, at rest. Its number
// here, the slot, is then used again; the serial number is its own for ever.
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

/// Which particles of a line are present.
template <class Case, bool present = is_line<Case>>
struct Slots {
  int rows_in_use;
  long long serial[Case::particle_count];                ///< by slot
  bool is_taken[Case::particle_count];                   ///< by slot
  int kind[has_sizes<Case> ? Case::particle_count : 1];  ///< by slot: number in the table of sizes
};
template <class Case>
struct Slots<Case, false> {};
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
  [[no_unique_address]] detail::Slots<Case> slots;

  /// Rows in use.
  int rows() const {
    if constexpr (is_line<Case>)
      return slots.rows_in_use;
    else
      return count;
  }
  /// Whether the particle of a row is in the pipe still.
  bool is_present([[maybe_unused]] int row) const {
    if constexpr (is_line<Case>)
      return !(position[row][2] >= Case::pipe_length);
    else
      return true;
  }
  /// Number in the table of sizes.
  int kind([[maybe_unused]] int row) const {
    if constexpr (is_line<Case> && has_sizes<Case>)
      return slots.kind[id[row]];
    else
      return id[row];
  }

  /// A particle at rest on the axis that nothing has acted on, of no size yet.
  void clear_row(int row) {
    for (double& x : position[row]) x = 0;
    for (double& v : motion[row]) v = 0;
    if constexpr (predicts)
      for (double& change : last_kick.row[row]) change = 0;
    if constexpr (Case::has_gas)
      for (double& change : gas_kick.row[row]) change = 0;
  }

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

/// What the pads of a row hold: radius, m_0/m and r_0/r of a kind.
template <class Case>
struct SizePads {
  double radius, inverse_mass, inverse_radius;
  explicit SizePads(int kind)
      : radius(radius_of<Case>(kind)),
        inverse_mass(Derived<Case>::reference_mass / mass_of<Case>(kind)),
        inverse_radius(Derived<Case>::reference_radius / radius) {}
};

/// Fills the pads of a row, whose number is set, by what its particle is; nothing with one size.
template <class Case>
void set_size([[maybe_unused]] Particles<Case>& p, [[maybe_unused]] int row) {
  if constexpr (has_sizes<Case>) {
    const SizePads<Case> pads(p.kind(row));
    p.position[row][3] = pads.radius, p.motion[row][3] = pads.inverse_mass, p.motion[row][7] = pads.inverse_radius;
  }
}

/// Whether the pads of a row are those of its particle.
template <class Case>
bool has_its_size([[maybe_unused]] const Particles<Case>& p, [[maybe_unused]] int row) {
  if constexpr (has_sizes<Case>) {
    const SizePads<Case> pads(p.kind(row));
    return p.position[row][3] == pads.radius && p.motion[row][3] == pads.inverse_mass &&
           p.motion[row][7] == pads.inverse_radius;
  }
  return true;
}

}  // namespace fixdem
