// The gas in a pipe steeper than 80 degrees: no bed, no floaters, the whole section in every slice.
//
// All particles of a slice count. Up to a void fraction of 0.70 the pressure gradient is that of a bed (Ergun), from
// 0.85 on that of particles each by itself (Wen & Yu), and linear in between: Ergun's law alone is five times too
// strong for a lone sphere. Both are explicit in the velocity, so there is nothing to solve.
#pragma once

#include "gas_laws.hpp"

namespace fixdem {

inline constexpr double maximum_void_fraction_upright = 0.999;
inline constexpr double densest_cloud = 0.70, thinnest_bed = 0.85;  ///< void fractions between which laws are blended

namespace detail {

/// The flow of W slices; the same calls as SplitFlow (gas_flow.hpp).
template <class Case, int W>
struct SteepFlow {
  using V = Lanes<W>;
  using Gas = Stream<Case, V>;
  static constexpr double pipe_area = section_of<Case>;
  decltype(V{} > V{}) occupied;
  V void_fraction, gradient, slope;

  FIXDEM_INLINE SteepFlow(const SliceArrays<Case>& gas, int first, const Gas& coming) {
    const Bed<Case, W> bed(gas, first);
    occupied = bed.occupied;
    const V one = splat<V>(1.0), zero{}, U = V{} + coming.velocity, through = U - bed.mean_velocity;

    const V solids = bed.solids * (1 / (pipe_area * Derived<Case>::slice_length));
    V eps = min(1.0 - solids, splat<V>(maximum_void_fraction_upright));
    eps = max(eps, splat<V>(least_void_fraction<Case>));
    void_fraction = select(occupied, eps, one);
    const Ergun<V> ergun(eps, bed.in_ergun, coming);
    const auto d = bed.diameter;
    const WenYu<W> cloud(through, eps, solids * (6 / Derived<Case>::pi) / (d * d * d), d, coming);
    const V thin = max(min((eps - densest_cloud) / (thinnest_bed - densest_cloud), one), zero);
    gradient = (1.0 - thin) * ergun.gradient(through) + thin * cloud.gradient;
    slope = (1.0 - thin) * ergun.slope(through) + thin * cloud.slope;

    // An empty slice is a free pipe.
    const V c_b = blasius<V>(splat<V>(Case::pipe_diameter), coming), y = sqrt(sqrt(abs(U))), y3 = y * y * y;
    gradient = select(occupied, gradient, c_b * y3 * U);
    slope = select(occupied, slope, 1.75 * c_b * y3);
  }

  FIXDEM_INLINE void newton_step(bool) {}

  /// What the slices from `first` on hold then. Returns zero, or no number if there is none.
  FIXDEM_INLINE double put(SliceArrays<Case>& gas, int first, const Gas& coming) const {
    const V zero{}, U = V{} + coming.velocity;
    store(gas.bed_area + first, select(occupied, splat<V>(pipe_area), zero));
    store(gas.void_fraction + first, void_fraction);
    store(gas.pressure_gradient + first, gradient);
    store(gas.velocity_in_bed + first, select(occupied, U, zero));
    store(gas.velocity_above + first, U);
    if constexpr (is_compressible<Case>) store(gas.pressures.slope + first, slope);
    return largest_lane<W>(abs(gradient - gradient));
  }
};

}  // namespace detail

}  // namespace fixdem
