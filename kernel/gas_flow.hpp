// The gas: one-dimensional flow through slices of the pipe, partly through the bed and partly above it.
//
// In each slice the pressure gradient G is the same in the bed (Ergun, eqs. 33-35) and above it (Blasius, eqs. 36, 37),
// and the two streams add up to the given flow (38). With c = (1 - eps)/eps^3, w = U_d - V_s:
//   bed    G = a w|w| + b w,  a = 1.75 c rho/d_g,  b = 150 c (1 - eps) nu rho/d_g^2
//   above  G = c_b y^7,  U_a = y^4,  c_b = 0.3164 (nu/D_h)^(1/4) rho/(2 D_h)
// so that A_a y^4 + A_d w(y) = |A U - A_d V_s| is one equation for y, increasing and convex: a fixed number of Newton
// steps solves it with products and square roots alone; the residual is checked. With several sizes (46) V_s is
// weighted by volume, and d_32 = sum d^3 / sum d^2 of the slice stands for the diameter.
//
// Slices are computed W at a time. Nothing here knows how particles are stored, so that another program can do the
// same with its own (tools/lammps).
#pragma once

#include "contacts.hpp"
#include "special_functions.hpp"

namespace fixdem {

inline constexpr int newton_steps = 8;            ///< 5 reach rounding on random slices; see tests/gas_test.cpp
inline constexpr double maximum_residual = 1e-9;  ///< relative to the flow
inline constexpr double full_within = 1e-6;       ///< free height in pipe diameters below which a slice is full
inline constexpr double maximum_void_fraction = 0.95;
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
  /// Sauter diameter of the bed particles of a slice, m: d_32, from sums of volumes and of squares. `V`: number or
  /// lanes.
  template <class V>
  static V sauter(V solids, V square_diameters) {
    return solids / square_diameters * (6 / Derived<Case>::pi);
  }
};

namespace detail {

/// The flow of W slices on its way to be split between bed and free section; notation as above.
template <class Case, int W>
struct SplitFlow {
  using V = Lanes<W>;
  using Mask = decltype(V{} > V{});
  Mask occupied, full;
  V mean_velocity, void_fraction, bed_area, area_above;  ///< V_s, eps, A_d, A_a
  V a, b, c_b;
  V flow, demand;  ///< A U - A_d V_s and its absolute value
  V y, w, residual;

  /// From what the slices from `first` on hold; U: the bulk velocity.
  FIXDEM_INLINE SplitFlow(const SliceArrays<Case>& gas, int first, double U) {
    using D = Derived<Case>;
    constexpr double R = D::pipe_radius, pipe_area = D::pi * R * R;
    constexpr double rho = Case::gas_density, nu = Case::gas_viscosity, bore = Case::pipe_diameter;
    const V one = splat<V>(1.0), zero{};

    const V n = load<V>(gas.particles + first);
    occupied = n > 0.0;
    auto d = diameter_of_bed(gas, first), d_g = d;
    if constexpr (Case::gas_bed_diameter > 0) d_g = decltype(d){} + Case::gas_bed_diameter;
    V solids_volume;
    if constexpr (has_sizes<Case>) {
      solids_volume = load<V>(gas.sums.solids + first);
      mean_velocity = load<V>(gas.sums.volume_flow + first) / max(solids_volume, splat<V>(1e-300));
    } else {
      solids_volume = n * D::volume;
      mean_velocity = load<V>(gas.axial_velocity_sum + first) / max(n, one);
    }
    const V top = load<V>(gas.height + first);
    V h = select(top < bore, top, splat<V>(bore));
    if constexpr (Case::gas_bed_height == BedHeight::continuous) {
      const V over = (h - (bore - 2 * d)) / d;
      h = h + d * select(over < 1.0, max(over, zero), one);
    } else if constexpr (Case::gas_bed_height == BedHeight::hard) {
      h = select(bore - h < d, splat<V>(bore), h);
    }
    full = bore - h < full_within * bore;
    h = select(full, splat<V>(bore * (1 - full_within)), h);  // keeps the arithmetic of the free section finite

    // Section: free arc, chord and areas.
    const V free_angle = arc_cosine((h - R) / R);  // half of it
    const V half_chord = sqrt(max(2 * R * h - h * h, zero));
    const V free_area = R * R * free_angle - (h - R) * half_chord;
    area_above = select(occupied, free_area, splat<V>(pipe_area));
    bed_area = select(occupied, select(full, splat<V>(pipe_area), pipe_area - free_area), zero);
    const V hydraulic_diameter =
        select(occupied, 4.0 * free_area / (2 * R * free_angle + 2.0 * half_chord), splat<V>(bore));

    // Void fraction and Ergun's coefficients.
    const V solids = solids_volume / (max(bed_area, splat<V>(1e-12 * pipe_area)) * D::slice_length);
    V eps = 1.0 - solids;
    eps = max(select(eps < maximum_void_fraction, eps, splat<V>(maximum_void_fraction)),
              splat<V>(least_void_fraction<Case>));
    const V c = (1.0 - eps) / (eps * eps * eps);
    a = c * (1.75 * rho / d_g), b = c * (1.0 - eps) * (150 * nu * rho / (d_g * d_g));
    void_fraction = select(occupied, eps, one);

    // Flow, and where Newton's method starts. Roots of roots approximate the 7th root: 1/7 = 1/8 + 1/64 + 1/512 + ...
    flow = pipe_area * U - bed_area * mean_velocity;
    demand = abs(flow);
    c_b = 0.3164 * sqrt(sqrt(nu / hydraulic_diameter)) * rho / (2.0 * hydraulic_diameter);
    const V y_above = sqrt(sqrt(demand / area_above));  // if all flowed above the bed
    const V w_bed = demand / max(bed_area, splat<V>(1e-30));
    const auto seventh_root = [](V x) {
      const V eighth = sqrt(sqrt(sqrt(x))), next = sqrt(sqrt(sqrt(eighth)));
      return eighth * next * sqrt(sqrt(sqrt(next)));
    };
    const V y_bed = seventh_root((a * w_bed + b) * w_bed / c_b);  // if all flowed through it
    y = select(occupied & (y_bed < y_above), y_bed, y_above);
  }

  /// That of all particles, or of the slices' own.
  static FIXDEM_INLINE auto diameter_of_bed([[maybe_unused]] const SliceArrays<Case>& gas, [[maybe_unused]] int first) {
    if constexpr (has_sizes<Case>)
      return SliceArrays<Case>::sauter(load<V>(gas.sums.solids + first),
                                       max(load<V>(gas.sums.square_diameters + first), splat<V>(1e-300)));
    else
      return Case::diameter;
  }

  /// w and the residual at the present y; `moves`: and the next y.
  FIXDEM_INLINE void newton_step(bool moves) {
    const V zero{}, y2 = y * y, y3 = y2 * y, gradient = c_b * (y2 * y2 * y3);
    const V root = sqrt(b * b + 4.0 * a * gradient);
    w = select(occupied, 2.0 * gradient / max(root + b, splat<V>(1e-300)), zero);
    residual = area_above * y2 * y2 + bed_area * w - demand;
    if (!moves) return;
    const V w_slope = select(occupied, 7.0 * c_b * y3 * y3 / max(root, splat<V>(1e-300)), zero);
    y = max(y - residual / max(4.0 * area_above * y3 + bed_area * w_slope, splat<V>(1e-300)), zero);
  }

  /// What the slices from `first` on hold then. Returns the maximum residual.
  FIXDEM_INLINE double put(SliceArrays<Case>& gas, int first, double U) const {
    const V one = splat<V>(1.0), zero{};
    const V sign = select(flow < 0.0, -one, one);
    const V y2 = y * y;
    V gradient = sign * c_b * (y2 * y2 * y2 * y);
    V in_bed = mean_velocity + sign * w, above = sign * (y2 * y2);

    // A full slice lets nothing pass above the bed.
    const V through = U - mean_velocity;
    const Mask plugged = occupied & full;
    gradient = select(plugged, a * through * abs(through) + b * through, gradient);
    in_bed = select(plugged, splat<V>(U), select(occupied, in_bed, zero));
    above = select(plugged, splat<V>(U), above);

    store(gas.bed_area + first, bed_area);
    store(gas.void_fraction + first, void_fraction);
    store(gas.pressure_gradient + first, gradient);
    store(gas.velocity_in_bed + first, in_bed);
    store(gas.velocity_above + first, above);
    alignas(64) double residuals[W];
    store(residuals, select(plugged, zero, abs(residual) / max(demand, splat<V>(1e-30))));
    double maximum = 0;
    for (double r : residuals) maximum = maximum >= r || maximum != maximum ? maximum : r;  // a NaN is kept
    return maximum;
  }
};

/// Flow of the slices from `first` to `end`, multiples of W; reads particles, sums and heights, writes the rest.
/// Returns the maximum residual. `set_velocity`: the bulk velocity in a coupled case.
///
/// A step of Newton's method waits for a root and two quotients, so several groups take it side by side.
template <class Case, int W>
double solve_slices(SliceArrays<Case>& gas, int first, int end, [[maybe_unused]] double set_velocity = 0) {
  using Split = SplitFlow<Case, W>;
  const double U = is_coupled<Case> ? set_velocity : Case::gas_velocity;
  double maximum = 0;
  const auto side_by_side = [&](auto... group) FIXDEM_INLINE_LAMBDA {
    Split split[] = {Split(gas, first + group * W, U)...};
    for (int step = 0; step <= newton_steps; ++step)
      for (Split& s : split) s.newton_step(step < newton_steps);
    int at = first;
    for (const Split& s : split) {
      const double residual = s.put(gas, at, U);
      maximum = maximum >= residual || maximum != maximum ? maximum : residual;
      at += W;
    }
    first = at;
  };
  while (first + 4 * W <= end) side_by_side(0, 1, 2, 3);
  while (first < end) side_by_side(0);
  return maximum;
}

}  // namespace detail

}  // namespace fixdem
