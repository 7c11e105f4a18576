// The gas in a pipe steeper than 80 degrees, as formulas are printed: Ergun's law in a dense slice, Wen & Yu's total
// force on each particle in a thin one, linear in the void fraction from 0.70 to 0.85 in between.
//
//   Wen & Yu   F = C_d (pi d^2/8) rho w|w| eps^(-4.65), w = U - V_s, C_d = 24/Re (1 + 0.15 Re^0.687) but at least 0.44,
//              Re = |w| d/nu
// The gas takes the whole section. SI units.
#pragma once

#include "direction_reference.hpp"
#include "gas_reference.hpp"

namespace fixdem::reference {

template <class Scalar>
Scalar wen_yu_force(Scalar w, Scalar eps, Scalar d, const Gas<Scalar>& gas) {
  if (w == 0) return 0;
  const Scalar pi = std::acos(Scalar(-1)), Re = std::abs(w) * d / gas.viscosity;
  const Scalar C_d = std::max(24 / Re * (1 + Scalar(0.15L) * std::pow(Re, Scalar(0.687L))), Scalar(0.44L));
  return C_d * (pi * d * d / 8) * gas.density * w * std::abs(w) * std::pow(eps, Scalar(-4.65L));
}

template <class Case, class Scalar>
SliceFlow<Scalar> steep_slice_flow(const SliceBed<Scalar>& bed, const Gas<Scalar>& gas = gas_of_case<Case, Scalar>()) {
  if (bed.count == 0) return slice_flow<Case>(bed, gas);
  const Scalar pi = std::acos(Scalar(-1)), R = Scalar(Case::pipe_diameter) / 2;
  const Scalar d = 2 * largest_radius<Case, Scalar>(), d_32 = bed.sauter_diameter * d;
  const Scalar d_g = Case::gas_bed_diameter > 0 ? Scalar(Case::gas_bed_diameter) : d_32;
  const Scalar volume = pi * R * R * Scalar(Case::pipe_length) / Case::slice_count;
  const Scalar solids = bed.count * (pi * d * d * d / 6) / volume, w = gas.velocity - bed.velocity;

  SliceFlow<Scalar> flow;
  flow.gas = gas;
  flow.bed_area = pi * R * R;
  flow.void_fraction = std::clamp(1 - solids, lists_sizes<Case> ? Scalar(0.20L) : Scalar(0.35L), Scalar(0.999L));
  flow.velocity_in_bed = flow.velocity_above = gas.velocity;
  flow.full = true;
  flow.sauter_diameter = bed.sauter_diameter;

  const Scalar spheres = solids / (pi * d_32 * d_32 * d_32 / 6);  // per volume, of the Sauter diameter
  const Scalar ergun = bed_gradient(w, flow.void_fraction, d_g, gas);
  const Scalar wen_yu = spheres * wen_yu_force(w, flow.void_fraction, d_32, gas);
  const Scalar thin =
      std::clamp((flow.void_fraction - Scalar(0.70L)) / (Scalar(0.85L) - Scalar(0.70L)), Scalar(0), Scalar(1));
  flow.pressure_gradient = (1 - thin) * ergun + thin * wen_yu;
  flow.mean_force = flow.pressure_gradient * volume / bed.count;
  return flow;
}

/// In whichever pipe it is.
template <class Case, class Scalar>
SliceFlow<Scalar> any_slice_flow(const SliceBed<Scalar>& bed, const Gas<Scalar>& gas = gas_of_case<Case, Scalar>()) {
  return has_no_bed<Case>() ? steep_slice_flow<Case>(bed, gas) : slice_flow<Case>(bed, gas);
}

}  // namespace fixdem::reference
