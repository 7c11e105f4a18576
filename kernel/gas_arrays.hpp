// What is known of every slice: the bed in it, the gas that comes to it, and how the gas flows through.
//
// Slices are computed W at a time. Nothing here knows how particles are stored, so that another program can do the
// same with its own (tools/lammps).
#pragma once

#include "contacts.hpp"
#include "gas_case.hpp"

namespace fixdem {

template <class Case>
inline constexpr double least_void_fraction = has_sizes<Case> ? 0.20 : 0.35;  ///< mixtures pack to 0.79

/// Sums over the bed particles of each slice, where they are not equal.
template <int Padded, bool present>
struct SliceSums {
  alignas(64) double solids[Padded];            ///< volume, m3
  alignas(64) double volume_flow[Padded];       ///< of volume times axial velocity, m4/s
  alignas(64) double square_diameters[Padded];  ///< m2
};
template <int Padded>
struct SliceSums<Padded, false> {};

/// A compressible gas: slice k lies between nodes k and k + 1, the last of which is the outlet (gas_pressure.hpp).
template <int Padded, bool present>
struct Pressures {
  alignas(64) double mean[Padded];              ///< pressure in a slice by the update before, Pa
  alignas(64) double flow[Padded];              ///< mass flow as pressure times bulk velocity, Pa m/s
  alignas(64) double slope[Padded];             ///< of the pressure gradient over the bulk velocity, Pa s/m2
  alignas(64) double above_outlet[Padded + 8];  ///< at nodes, Pa; zero from the outlet on
  alignas(64) double offset[Padded];            ///< scratch of one update
  alignas(64) double resistance[Padded];        ///< the same
  double supply;                                ///< what flows in, as `flow`
};
template <int Padded>
struct Pressures<Padded, false> {};

/// The flow in the slices at the last update: all that does not depend on how particles are stored.
template <class Case>
struct SliceArrays {
  static constexpr int count = Case::slice_count;
  static constexpr int padded = (count + 7) / 8 * 8;
  alignas(64) double particles[padded];           ///< bed particles
  alignas(64) double axial_velocity_sum[padded];  ///< of the bed particles, m/s
  alignas(64) double height[padded];              ///< of the highest top of a bed particle above the pipe's bottom, m
  alignas(64) double bed_area[padded];            ///< A_d, m2; the whole section in a full slice, 0 in an empty one
  alignas(64) double void_fraction[padded];
  alignas(64) double pressure_gradient[padded];  ///< G, Pa/m, positive pushing along +z
  alignas(64) double velocity_in_bed[padded];    ///< U_d, m/s
  alignas(64) double velocity_above[padded];     ///< U_a, m/s; U_d in a full slice
  [[no_unique_address]] SliceSums<padded, has_sizes<Case>> sums;
  [[no_unique_address]] Pressures<padded, is_compressible<Case>> pressures;
  /// Sauter diameter of the bed particles of a slice, m: d_32, from sums of volumes and of squares. `V`: number or
  /// lanes.
  template <class V>
  static V sauter(V solids, V square_diameters) {
    return solids / square_diameters * (6 / Derived<Case>::pi);
  }
};

/// The gas that comes to a slice, or to several: bulk velocity U, density rho, kinematic viscosity nu. One and the same
/// in all slices unless it is compressible.
template <class Case, class V, bool differs = is_compressible<Case>>
struct Stream {
  double velocity;
  static constexpr double density = Case::gas_density, viscosity = Case::gas_viscosity;
};
template <class Case, class V>
struct Stream<Case, V, true> {
  V velocity, density, viscosity;
};

/// Of W slices from `first` on. `set_velocity`: the bulk velocity where it is no constant of the case.
template <class Case, int W>
FIXDEM_INLINE Stream<Case, Lanes<W>> stream_at([[maybe_unused]] const SliceArrays<Case>& gas,
                                               [[maybe_unused]] int first, [[maybe_unused]] double set_velocity = 0) {
  if constexpr (is_compressible<Case>) {
    using V = Lanes<W>;
    const V pressure = load<V>(gas.pressures.mean + first), share = pressure * (1 / Case::gas_outlet_pressure);
    return {load<V>(gas.pressures.flow + first) / pressure, Case::gas_density * share, Case::gas_viscosity / share};
  } else {
    return {is_coupled<Case> || has_velocity_in_time<Case> ? set_velocity : Case::gas_velocity};
  }
}

namespace detail {

/// The bed of W slices from `first` on.
template <class Case, int W>
struct Bed {
  using V = Lanes<W>;
  using Diameter = std::conditional_t<has_sizes<Case>, V, double>;
  decltype(V{} > V{}) occupied;
  V solids, mean_velocity;  ///< volume, m3; V_s
  Diameter diameter;        ///< that of all particles, or d_32 of each slice
  Diameter in_ergun;        ///< d_g

  FIXDEM_INLINE Bed(const SliceArrays<Case>& gas, int first) {
    const V n = load<V>(gas.particles + first);
    occupied = n > 0.0;
    if constexpr (has_sizes<Case>) {
      solids = load<V>(gas.sums.solids + first);
      mean_velocity = load<V>(gas.sums.volume_flow + first) / max(solids, splat<V>(1e-300));
      diameter = SliceArrays<Case>::sauter(solids, max(load<V>(gas.sums.square_diameters + first), splat<V>(1e-300)));
    } else {
      solids = n * Derived<Case>::volume;
      mean_velocity = load<V>(gas.axial_velocity_sum + first) / max(n, splat<V>(1.0));
      diameter = Case::diameter;
    }
    in_ergun = diameter;
    if constexpr (Case::gas_bed_diameter > 0) in_ergun = Diameter{} + Case::gas_bed_diameter;
  }
};

}  // namespace detail

}  // namespace fixdem
