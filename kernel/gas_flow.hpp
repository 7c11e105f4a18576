// The gas: one-dimensional flow through slices of the pipe, partly through the bed and partly above it.
//
// In each slice the pressure gradient G is the same in the bed (Ergun, eqs. 33-35) and above it (Blasius, eqs. 36, 37),
// and the two streams add up to the given flow (38). With c = (1 - eps)/eps^3, w = U_d - V_s:
//   bed    G = a w|w| + b w,  a = 1.75 c rho/d_g,  b = 150 c (1 - eps) nu rho/d_g^2
//   above  G = c_b y^7,  U_a = y^4,  c_b = 0.3164 (nu/D_h)^(1/4) rho/(2 D_h)
// so that A_a y^4 + A_d w(y) = |A U - A_d V_s| is one equation for y, increasing and convex: a fixed number of Newton
// steps solves it with products and square roots alone; the residual is checked. With several sizes (46) V_s is
// weighted by volume, and d_32 = sum d^3 / sum d^2 of the slice stands for the diameter. A pipe too steep for a bed is
// solved otherwise (gas_steep.hpp).
#pragma once

#include "gas_steep.hpp"

namespace fixdem {

inline constexpr int newton_steps = 8;            ///< 5 reach rounding on random slices; see tests/gas_test.cpp
inline constexpr double maximum_residual = 1e-9;  ///< relative to the flow
inline constexpr double full_within = 1e-6;       ///< free height in pipe diameters below which a slice is full
inline constexpr double maximum_void_fraction = 0.95;

namespace detail {

/// The flow of W slices on its way to be split between bed and free section; notation as above.
template <class Case, int W>
struct SplitFlow {
  using V = Lanes<W>;
  using Gas = Stream<Case, V>;
  using Mask = decltype(V{} > V{});
  Mask occupied, full;
  V mean_velocity, void_fraction, bed_area, area_above;  ///< V_s, eps, A_d, A_a
  V a, b, c_b;
  V flow, demand;  ///< A U - A_d V_s and its absolute value
  V y, w, residual;

  /// Of the slices from `first` on, and the gas that comes to them.
  FIXDEM_INLINE SplitFlow(const SliceArrays<Case>& gas, int first, const Gas& coming) {
    using D = Derived<Case>;
    constexpr double R = D::pipe_radius, pipe_area = D::pi * R * R, bore = Case::pipe_diameter;
    const V one = splat<V>(1.0), zero{};

    const Bed<Case, W> bed(gas, first);
    occupied = bed.occupied, mean_velocity = bed.mean_velocity;
    auto gap = bed.diameter;  // free height over the bed below which a slice is full
    if constexpr (requires { Case::gas_full_gap; }) gap = decltype(gap){} + Case::gas_full_gap;
    const V top = load<V>(gas.height + first);
    V h = select(top < bore, top, splat<V>(bore));
    if constexpr (Case::gas_bed_height == BedHeight::continuous) {
      const V over = (h - (bore - 2 * gap)) / gap;
      h = h + gap * select(over < 1.0, max(over, zero), one);
    } else if constexpr (Case::gas_bed_height == BedHeight::hard) {
      h = select(bore - h < gap, splat<V>(bore), h);
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
    const V solids = bed.solids / (max(bed_area, splat<V>(1e-12 * pipe_area)) * D::slice_length);
    V eps = 1.0 - solids;
    eps = max(select(eps < maximum_void_fraction, eps, splat<V>(maximum_void_fraction)),
              splat<V>(least_void_fraction<Case>));
    const Ergun<V> ergun(eps, bed.in_ergun, coming);
    a = ergun.a, b = ergun.b;
    void_fraction = select(occupied, eps, one);

    // Flow, and where Newton's method starts. Roots of roots approximate the 7th root: 1/7 = 1/8 + 1/64 + 1/512 + ...
    flow = pipe_area * coming.velocity - bed_area * mean_velocity;
    demand = abs(flow);
    c_b = blasius<V>(hydraulic_diameter, coming);
    const V y_above = sqrt(sqrt(demand / area_above));  // if all flowed above the bed
    const V w_bed = demand / max(bed_area, splat<V>(1e-30));
    const auto seventh_root = [](V x) {
      const V eighth = sqrt(sqrt(sqrt(x))), next = sqrt(sqrt(sqrt(eighth)));
      return eighth * next * sqrt(sqrt(sqrt(next)));
    };
    const V y_bed = seventh_root((a * w_bed + b) * w_bed / c_b);  // if all flowed through it
    y = select(occupied & (y_bed < y_above), y_bed, y_above);
  }

  /// dw/dy
  FIXDEM_INLINE V slope_in_bed(V y3, V root) const {
    return select(occupied, 7.0 * c_b * y3 * y3 / max(root, splat<V>(1e-300)), V{});
  }

  /// w and the residual at the present y; `moves`: and the next y.
  FIXDEM_INLINE void newton_step(bool moves) {
    const V zero{}, y2 = y * y, y3 = y2 * y, gradient = c_b * (y2 * y2 * y3);
    const V root = sqrt(b * b + 4.0 * a * gradient);
    w = select(occupied, 2.0 * gradient / max(root + b, splat<V>(1e-300)), zero);
    residual = area_above * y2 * y2 + bed_area * w - demand;
    if (!moves) return;
    y = max(y - residual / max(4.0 * area_above * y3 + bed_area * slope_in_bed(y3, root), splat<V>(1e-300)), zero);
  }

  /// What the slices from `first` on hold then. Returns the maximum residual.
  FIXDEM_INLINE double put(SliceArrays<Case>& gas, int first, const Gas& coming) const {
    const auto U = coming.velocity;
    const V one = splat<V>(1.0), zero{};
    const V sign = select(flow < 0.0, -one, one);
    const V y2 = y * y;
    V gradient = sign * c_b * (y2 * y2 * y2 * y);
    V in_bed = mean_velocity + sign * w, above = sign * (y2 * y2);

    // A full slice lets nothing pass above the bed.
    const V through = U - mean_velocity;
    const Mask plugged = occupied & full;
    gradient = select(plugged, a * through * abs(through) + b * through, gradient);
    in_bed = select(plugged, V{} + U, select(occupied, in_bed, zero));
    above = select(plugged, V{} + U, above);

    store(gas.bed_area + first, bed_area);
    store(gas.void_fraction + first, void_fraction);
    store(gas.pressure_gradient + first, gradient);
    store(gas.velocity_in_bed + first, in_bed);
    store(gas.velocity_above + first, above);
    if constexpr (is_compressible<Case>) {  // dG/dU = dG/dy / (dU/dy)
      const V y3 = y2 * y, root = sqrt(b * b + 4.0 * a * (c_b * (y2 * y2 * y3)));
      const V demand_slope = 4.0 * area_above * y3 + bed_area * slope_in_bed(y3, root);
      const V split = 7.0 * c_b * y3 * y3 * section_of<Case> / max(demand_slope, splat<V>(1e-300));
      store(gas.pressures.slope + first, select(plugged, 2.0 * a * abs(through) + b, split));
    }
    return largest_lane<W>(select(plugged, zero, abs(residual) / max(demand, splat<V>(1e-30))));
  }
};

/// Flow of the slices from `first` to `end`, multiples of W; reads particles, sums and heights, writes the rest.
/// Returns the maximum residual. `set_velocity`: the bulk velocity where it is no constant of the case.
///
/// A step of Newton's method waits for a root and two quotients, so several groups take it side by side.
template <class Case, int W>
double solve_slices(SliceArrays<Case>& gas, int first, int end, [[maybe_unused]] double set_velocity = 0) {
  using Flow = std::conditional_t<Derived<Case>::is_steep, SteepFlow<Case, W>, SplitFlow<Case, W>>;
  double maximum = 0;
  const auto coming = [&](int at) FIXDEM_INLINE_LAMBDA { return stream_at<Case, W>(gas, at, set_velocity); };
  const auto side_by_side = [&](auto... group) FIXDEM_INLINE_LAMBDA {
    Flow flows[] = {Flow(gas, first + group * W, coming(first + group * W))...};
    for (int step = 0; step <= newton_steps; ++step)
      for (Flow& flow : flows) flow.newton_step(step < newton_steps);
    int at = first;
    for (const Flow& flow : flows) {
      const double residual = flow.put(gas, at, coming(at));
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
