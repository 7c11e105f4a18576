// The gas and the particles: what each slice holds of them, and what it gives them.
//
// A bed particle counts in its slice; the flow is solved (gas_flow.hpp), and each bed particle feels G dz A_d / N along
// the axis (32), with several sizes G dz A_d (V/sum V) (eps d_32/d + 1 - eps) (32'). A particle that floats above the
// bed counts in no slice and feels the drag of a single sphere. Forces are turned into the velocity change of one step
// (with several sizes, of the mass of reference) and held until the next update.
#pragma once

#include "gas_pressure.hpp"
#include "near_list.hpp"
#include "status.hpp"

namespace fixdem {

/// State of the gas at the last update.
template <class Case, bool present = Case::has_gas>
struct GasSlices : SliceArrays<Case> {
  bool floats[Case::particle_count];              ///< by input number
  int slice_of[Case::particle_count];             ///< by row; scratch of one update
  double kick_in_bed[SliceArrays<Case>::padded];  ///< velocity change per step of a bed particle, m/s; scratch
};
template <class Case>
struct GasSlices<Case, false> {};

namespace detail {

/// Forgets the particles of the last update.
template <class Case>
void clear_slices(SliceArrays<Case>& gas) {
  for (int s = 0; s < gas.padded; ++s) gas.particles[s] = gas.axial_velocity_sum[s] = gas.height[s] = 0;
  if constexpr (has_sizes<Case>)
    for (int s = 0; s < gas.padded; ++s)
      gas.sums.solids[s] = gas.sums.volume_flow[s] = gas.sums.square_diameters[s] = 0;
}

/// Counts a bed particle in slice s; height over the axis and axial velocity are its own.
template <class Case>
void count_in_slice(SliceArrays<Case>& gas, int s, double height, double axial_velocity,
                    double diameter = largest_diameter<Case>) {
  const double top = height + Derived<Case>::pipe_radius + diameter / 2;
  gas.particles[s] += 1;
  gas.axial_velocity_sum[s] += axial_velocity;
  gas.height[s] = max(top, gas.height[s]);
  if constexpr (has_sizes<Case>) {
    const double volume = Derived<Case>::pi / 6 * diameter * diameter * diameter;
    gas.sums.solids[s] += volume;
    gas.sums.volume_flow[s] += volume * axial_velocity;
    gas.sums.square_diameters[s] += diameter * diameter;
  }
}

/// Force on each bed particle of slice s along the pipe, N: eq. (32). With several sizes the same without what is its
/// own: N/m3, to be multiplied by share_of_drag.
template <class Case>
double force_in_bed(const SliceArrays<Case>& gas, int s) {
  const double force = gas.pressure_gradient[s] * Derived<Case>::slice_length * gas.bed_area[s];
  if constexpr (has_sizes<Case>)
    return force / gas.sums.solids[s];
  else
    return force / gas.particles[s];
}

/// What a bed particle of slice s takes of it, m3: V (eps d_32/d + 1 - eps), eq. (32'); one where all are equal.
template <class Case>
double share_of_drag([[maybe_unused]] const SliceArrays<Case>& gas, [[maybe_unused]] int s,
                     [[maybe_unused]] double diameter) {
  if constexpr (has_sizes<Case>) {
    const double eps = gas.void_fraction[s], d_32 = gas.sauter(gas.sums.solids[s], gas.sums.square_diameters[s]);
    return Derived<Case>::pi / 6 * diameter * diameter * (eps * d_32 + (1 - eps) * diameter);
  } else {
    return 1;
  }
}

/// Drag on a floating sphere, N: C_d = 24/Re (1 + 0.15 Re^0.687) up to Re = 1000, then 0.44. `gas`: its density and
/// viscosity.
template <class Case>
void drag_on_floater(double gas_velocity, const double* velocity, double* force,
                     double diameter = largest_diameter<Case>, [[maybe_unused]] const Stream<Case, double>& gas = {}) {
  using D = Derived<Case>;
  const double u[3] = {-velocity[0], -velocity[1], gas_velocity - velocity[2]};
  const double speed = sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
  const double reynolds = speed * diameter / gas.viscosity;
  const double area = D::pi * diameter * diameter / 8 * gas.density;
  // C_d |u| without 0/0 at rest: 24 nu/d (1 + ...).
  const double drag =
      reynolds < 1000 ? 24 * gas.viscosity / diameter * (1 + 0.15 * power<687, 1000>(reynolds)) : 0.44 * speed;
  for (int k = 0; k < 3; ++k) force[k] = area * drag * u[k];
}

}  // namespace detail

/// Number of the slice of a place along the pipe, which may lie a little outside [0, length).
template <class Case>
int slice_at(double z) {
  constexpr double per_length = 1 / Derived<Case>::slice_length;
  int slice = static_cast<int>(z * per_length + Case::slice_count) - Case::slice_count;  // rounds down from -count on
  if (slice < 0) slice = Derived<Case>::is_periodic ? slice + Case::slice_count : 0;
  if (slice >= Case::slice_count)
    slice = Derived<Case>::is_periodic ? slice - Case::slice_count : Case::slice_count - 1;
  return slice;
}

/// Bulk velocity at a step: set by another program, by a table, or constant.
template <class Case>
double bulk_velocity([[maybe_unused]] const Particles<Case>& p, [[maybe_unused]] long long step) {
  if constexpr (is_coupled<Case>)
    return p.coupling.gas_velocity;
  else if constexpr (has_velocity_in_time<Case>)
    return value_at(Case::gas_velocity_in_time, static_cast<double>(step) * Case::time_step);
  else
    return Case::gas_velocity;
}

/// Whether the particle of a row floats. One just fed counts as floating until it is looked at, in a steep pipe never.
template <class Case>
bool is_floating(const GasSlices<Case>& gas, const Particles<Case>& p, int row) {
  return !Derived<Case>::is_steep && gas.floats[p.id[row]];
}

/// New slice quantities and forces from the present positions and velocities, before the step of this number.
template <class Case, int W>
Status update_slices(GasSlices<Case>& gas, Particles<Case>& p, long long step) {
  detail::clear_slices(gas);
  for (int i = 0; i < p.rows(); ++i) {
    if (!p.is_present(i)) continue;
    const int s = gas.slice_of[i] = slice_at<Case>(p.position[i][2]);
    if (is_floating(gas, p, i)) continue;
    detail::count_in_slice(gas, s, height_of<Case>(p.position[i]), p.motion[i][2], 2 * radius_at<Case>(p.position[i]));
  }
  const double U = bulk_velocity(p, step);
  double residual;
  if constexpr (is_compressible<Case>)
    residual = detail::solve_pressures<Case, W>(gas, U, step == 0);
  else
    residual = detail::solve_slices<Case, W>(gas, 0, gas.padded, U);
  if (!(residual < maximum_residual)) return {Fault::gas_unsolved, -1, 0, residual, maximum_residual};

  constexpr double per_force = Case::time_step / Derived<Case>::reference_mass;
  for (int s = 0; s < Case::slice_count; ++s) gas.kick_in_bed[s] = detail::force_in_bed(gas, s) * per_force;
  for (int i = 0; i < p.rows(); ++i) {
    double* kick = p.gas_kick.row[i];
    kick[0] = kick[1] = kick[2] = kick[3] = 0;
    if (!p.is_present(i)) continue;
    const int s = gas.slice_of[i];
    const double diameter = 2 * radius_at<Case>(p.position[i]);
    kick[2] = gas.kick_in_bed[s] * detail::share_of_drag(gas, s, diameter);
    if (!is_floating(gas, p, i)) continue;
    double force[3];
    detail::drag_on_floater<Case>(gas.velocity_above[s], p.motion[i], force, diameter, stream_at<Case, 1>(gas, s));
    for (int k = 0; k < 3; ++k) kick[k] = force[k] * per_force;
  }
  return {};
}

}  // namespace fixdem
