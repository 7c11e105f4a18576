// The pressures of a compressible, isothermal gas along the pipe, and the mass flow in every slice.
//
// Slice k lies between nodes k and k + 1; node K is the outlet, whose pressure is given. With Phi = p U the mass flow,
// P the pressure above that of the outlet, and p_m the mean pressure of a slice at the update before, by which its
// density, viscosity and velocity U = Phi/p_m go, so that all slices are independent:
//   along a slice   P_k - P_(k+1) = dz G(U_k)                                                       (G2, G3)
//   at a node       c_k (P_k - P_k before) = Phi_(k-1) - Phi_k, c_k = (eps_(k-1) + eps_k)/2 dz/dt     (G4)
// c is zero without storage; the first node has half a slice and the supply volume before it. What flows in there is
// the case's velocity at outlet pressure, or what a blower gives against P_0, or whatever a given P_0 drives (G5).
//
// Newton's method: G is linear about the flow held, so P_k = e_k + z_k Phi_(k-1), carried from the outlet upstream, has
// its two numbers at every node by sums, products and one quotient above one; the inlet then gives the flow, and what
// is carried back downstream keeps the mass of every node to rounding. Where the flow is known beforehand (velocity
// given, no storage) that is one sum of G dz and nothing is repeated.
//
// Without storage pressures have no memory of their own, and the density follows them one update later. A pressure that
// is dp too high then comes out too low by about dp times the loss over the outlet pressure, so this share of the way
// is taken back (`relaxation`). The first update repeats that until nothing changes: a state starts from the steady
// pressures of its flow.
#pragma once

#include "gas_flow.hpp"

namespace fixdem::detail {

inline constexpr int maximum_iterations = 40;   ///< 2 to 4 are usual
inline constexpr int maximum_sweeps = 400;      ///< of the first update
inline constexpr double steady_within = 1e-13;  ///< pressures of the first update, of that at the outlet

/// What flows in at the inlet is source - leak P_0; or P_0 is given.
struct Inlet {
  double source, leak;
};
template <class Case>
Inlet inlet_of([[maybe_unused]] double bulk_velocity) {
  constexpr double per_area = Case::gas_outlet_pressure / section_of<Case>;
  if constexpr (has_blower<Case>)
    return {Case::gas_blower_flow * per_area, Case::gas_blower_flow * per_area / Case::gas_blower_pressure};
  else if constexpr (has_inlet_pressure<Case>)
    return {Case::gas_inlet_pressure - Case::gas_outlet_pressure, 0};
  else
    return {Case::gas_outlet_pressure * bulk_velocity, 0};
}

/// Void fraction of the whole section of a slice.
template <class Case>
double share_of_gas(const SliceArrays<Case>& gas, int s) {
  return 1 - (1 - gas.void_fraction[s]) * (gas.bed_area[s] * (1 / section_of<Case>));
}

/// c of a node. `per_time`: one over the time between updates, zero without storage.
template <class Case>
double capacity_of_node(const SliceArrays<Case>& gas, int node, double per_time) {
  constexpr double half_slice = 0.5 * Derived<Case>::slice_length;
  const double before = node > 0 ? half_slice * share_of_gas(gas, node - 1) : supply_volume<Case> / section_of<Case>;
  return (before + half_slice * share_of_gas(gas, node)) * per_time;
}

/// One step of Newton's method, from G and its slope in every slice at the flow held. New pressures go to `offset`, new
/// flows to where they are. Returns the maximum change of flow relative to the maximum flow.
template <class Case>
double settle(SliceArrays<Case>& gas, Inlet inlet, double per_time) {
  constexpr double dz = Derived<Case>::slice_length, least_flow = 1e-3 * Case::gas_outlet_pressure;
  auto& n = gas.pressures;
  double e = 0, z = 0;  // P = e + z Phi
  for (int k = Case::slice_count - 1; k >= 0; --k) {
    const double per_flow = dz * n.slope[k] / n.mean[k], c = capacity_of_node(gas, k, per_time);
    e += dz * gas.pressure_gradient[k] - per_flow * n.flow[k];
    z += per_flow;
    const double share = 1 / (1 + z * c);
    e = n.offset[k] = (e + z * c * n.above_outlet[k]) * share;
    z = n.resistance[k] = z * share;
  }
  if constexpr (has_inlet_pressure<Case>)
    n.supply = (inlet.source - e) / max(z, 1e-300);
  else
    n.supply = (inlet.source - inlet.leak * e) / (1 + inlet.leak * z);

  double flow = n.supply, change = 0, largest = least_flow;
  for (int k = 0; k < Case::slice_count; ++k) {
    const double pressure = n.offset[k] + n.resistance[k] * flow;
    flow -= capacity_of_node(gas, k, per_time) * (pressure - n.above_outlet[k]);
    const double moved = abs(flow - n.flow[k]);
    change = change >= moved || change != change ? change : moved;  // a NaN is kept
    largest = max(largest, abs(flow));
    n.offset[k] = pressure, n.flow[k] = flow;
  }
  return change / largest;
}

/// Flow and pressures that belong to the mean pressures held. Returns the maximum residual.
template <class Case, int W>
double solve_flow(SliceArrays<Case>& gas, Inlet inlet, double per_time) {
  double residual = 1;
  for (int iteration = 0; iteration < maximum_iterations && residual > maximum_residual; ++iteration) {
    residual = solve_slices<Case, W>(gas, 0, gas.padded);
    if (!(residual < maximum_residual)) return residual;
    residual = settle(gas, inlet, per_time);
  }
  return residual;
}

/// Takes over the pressures in `offset`, a share of the way. Returns the maximum change, relative to the outlet
/// pressure.
template <class Case>
double take_over(SliceArrays<Case>& gas, double share) {
  auto& n = gas.pressures;
  double change = 0;
  for (int k = 0; k < Case::slice_count; ++k) {
    const double step = share * (n.offset[k] - n.above_outlet[k]);
    n.above_outlet[k] += step;
    change = max(change, abs(step));
  }
  return change / Case::gas_outlet_pressure;
}

/// Returns the least of them.
template <class Case>
double set_mean_pressures(SliceArrays<Case>& gas) {
  auto& n = gas.pressures;
  double least = Case::gas_outlet_pressure;
  for (int k = 0; k < gas.padded; ++k) {
    n.mean[k] = Case::gas_outlet_pressure + 0.5 * (n.above_outlet[k] + n.above_outlet[k + 1]);
    least = min(least, n.mean[k]);
  }
  return least;
}

/// Before the first update: no pressure, and the flow that is known, or a guess of 10 m/s.
template <class Case>
void begin_pressures(SliceArrays<Case>& gas, Inlet inlet) {
  constexpr double guess = 10 * Case::gas_outlet_pressure;
  for (double& flow : gas.pressures.flow)
    flow = has_inlet_pressure<Case> ? (inlet.source < 0 ? -guess : guess) : inlet.source;
  for (double& pressure : gas.pressures.above_outlet) pressure = 0;
}

/// New flow and pressures. Returns the maximum residual; 1 where no pressure above zero carries the flow.
template <class Case, int W>
double solve_pressures(SliceArrays<Case>& gas, double bulk_velocity, bool is_first) {
  constexpr double per_time = 1 / (Case::gas_update_interval * Case::time_step);
  const Inlet inlet = inlet_of<Case>(bulk_velocity);
  const bool stores = stores_gas<Case> && !is_first;
  if (is_first) begin_pressures(gas, inlet);
  if constexpr (!stores_gas<Case> && !has_inlet_pressure<Case> && !has_blower<Case>)
    for (double& flow : gas.pressures.flow) flow = inlet.source;

  double change = 1;
  for (int sweep = 0; sweep < maximum_sweeps && change > steady_within; ++sweep) {
    if (!(set_mean_pressures(gas) > 0)) return 1;
    const double residual = solve_flow<Case, W>(gas, inlet, stores ? per_time : 0);
    if (!(residual < maximum_residual)) return residual;
    change = take_over(gas, stores ? 1 : 1 / (1 + abs(gas.pressures.offset[0]) / Case::gas_outlet_pressure));
    if (!is_first) return residual;
  }
  return change;
}

}  // namespace fixdem::detail

namespace fixdem {

/// What the gas loses from a node to the outlet by the gradients of the slices, Pa.
template <class Case>
double loss_from_node(const SliceArrays<Case>& gas, int node) {
  double loss = 0;
  for (int s = node; s < Case::slice_count; ++s) loss += gas.pressure_gradient[s] * Derived<Case>::slice_length;
  return loss;
}

/// Pressure at node 0 (inlet) to slice_count (outlet) above that of the outlet, Pa.
template <class Case>
double pressure_at_node(const SliceArrays<Case>& gas, int node) {
  if constexpr (is_compressible<Case>)
    return gas.pressures.above_outlet[node];
  else
    return loss_from_node(gas, node);
}

/// U of a slice, m/s: the flow through the bed and above it, eq. (38).
template <class Case>
double bulk_velocity_in(const SliceArrays<Case>& gas, int s) {
  const double share = gas.bed_area[s] / section_of<Case>;
  return share * gas.velocity_in_bed[s] + (1 - share) * gas.velocity_above[s];
}

/// Density of the gas in a slice, kg/m3.
template <class Case>
double gas_density_in(const SliceArrays<Case>& gas, int s) {
  return stream_at<Case, 1>(gas, s).density;
}

/// Gas that enters at the inlet, kg/s.
template <class Case>
double gas_supply(const SliceArrays<Case>& gas) {
  if constexpr (is_compressible<Case>)
    return gas.pressures.supply * (section_of<Case> * Case::gas_density / Case::gas_outlet_pressure);
  else
    return section_of<Case> * Case::gas_density * bulk_velocity_in(gas, 0);
}

}  // namespace fixdem
