// The gas of the whole pipe at one update, as it changes in time and, where it is compressible, along the pipe.
//
// Slice k lies between nodes k and k + 1 of pressures p; the last node is the outlet. The mean pressure p_m of a slice
// at the update before gives its density p_m/(R T), its viscosity mu/density and, with the mass flow Phi = p U, its
// velocity Phi/p_m. Unknown are a pressure and a flow for every node and slice:
//   p_k - p_(k+1) = dz G_k(Phi_k/p_m)                                        along a slice
//   c_k (p_k - p_k before) = Phi_(k-1) - Phi_k                               at a node; c = 0 without storage
//   c_k = (eps_(k-1) + eps_k)/2 dz/dt, at the inlet (eps_0 dz/2 + V/A)/dt with the supply volume V
//   Phi_(-1) = p_L U, or p_L Q/A (1 - (p_0 - p_L)/p_b) of a blower, or instead p_0 as given
// and all are found together: Newton's method with a full matrix, slopes of G by differences. Without storage only the
// share 1/(1 + |p_0 - p_L|/p_L) of the change of pressures is made; at the first update this is repeated until nothing
// changes. SI units; p_L is the outlet's pressure.
#pragma once

#include <algorithm>
#include <vector>

#include "gas_steep_reference.hpp"

namespace fixdem::reference {

/// Bulk velocity at a time: constant, or linear between the rows of a table and constant outside.
template <class Case, class Scalar>
Scalar velocity_at([[maybe_unused]] Scalar time) {
  if constexpr (requires { Case::gas_velocity_in_time; }) {
    const auto& table = Case::gas_velocity_in_time;
    const int rows = static_cast<int>(std::size(table));
    if (time <= Scalar(table[0].time)) return table[0].value;
    for (int k = 1; k < rows; ++k) {
      const Scalar t0 = table[k - 1].time, t1 = table[k].time, u0 = table[k - 1].value, u1 = table[k].value;
      if (time <= t1) return (u0 * (t1 - time) + u1 * (time - t0)) / (t1 - t0);
    }
    return table[rows - 1].value;
  } else {
    return Case::gas_velocity;
  }
}

template <class Case>
constexpr bool gas_is_compressible() {
  if constexpr (requires { Case::gas_compressible; }) return Case::gas_compressible;
  return false;
}

/// x of A x = b for a full matrix: elimination with the largest pivot of each column.
template <class Scalar>
std::vector<Scalar> solution(std::vector<std::vector<Scalar>> A, std::vector<Scalar> b) {
  const std::size_t n = b.size();
  for (std::size_t column = 0; column < n; ++column) {
    std::size_t pivot = column;
    for (std::size_t row = column; row < n; ++row)
      if (std::abs(A[row][column]) > std::abs(A[pivot][column])) pivot = row;
    std::swap(A[column], A[pivot]), std::swap(b[column], b[pivot]);
    for (std::size_t row = column + 1; row < n; ++row) {
      const Scalar factor = A[row][column] / A[column][column];
      if (factor == 0) continue;
      for (std::size_t k = column; k < n; ++k) A[row][k] -= factor * A[column][k];
      b[row] -= factor * b[column];
    }
  }
  for (std::size_t row = n; row-- > 0;) {
    for (std::size_t k = row + 1; k < n; ++k) b[row] -= A[row][k] * b[k];
    b[row] /= A[row][row];
  }
  return b;
}

/// Pressures and flows along the pipe; `present`: whether the gas is compressible.
template <class Case, class Scalar, bool present = gas_is_compressible<Case>()>
class GasInPipe {
 public:
  using Beds = std::vector<SliceBed<Scalar>>;
  using Flows = std::vector<SliceFlow<Scalar>>;

  /// The flow in every slice before a step of this number.
  Flows update(const Beds& beds, long long step) {
    Gas<Scalar> gas = gas_of_case<Case, Scalar>();
    gas.velocity = velocity_at<Case>(Scalar(step) * Scalar(Case::time_step));
    Flows flows;
    for (const auto& bed : beds) flows.push_back(any_slice_flow<Case>(bed, gas));
    return flows;
  }
};

template <class Case, class Scalar>
class GasInPipe<Case, Scalar, true> {
 public:
  using Beds = std::vector<SliceBed<Scalar>>;
  using Flows = std::vector<SliceFlow<Scalar>>;

  Flows update(const Beds& beds, long long step) {
    velocity_ = velocity_at<Case>(Scalar(step) * Scalar(Case::time_step));
    if (step > 0) return advance(beds, stores());
    pressure_.assign(K + 1, outlet);
    flow_.assign(K, outlet * (velocity_ != 0 ? velocity_ : Scalar(1)));
    Flows flows;
    for (int sweep = 0; sweep < 1000; ++sweep) {
      const Column before = pressure_;
      flows = advance(beds, false);
      Scalar change = 0;
      for (int k = 0; k < K; ++k) change = std::max(change, std::abs(pressure_[k] - before[k]));
      if (change < outlet * 100 * std::numeric_limits<Scalar>::epsilon()) break;
    }
    return flows;
  }

  Scalar pressure(int node) const { return pressure_[node]; }  ///< Pa
  Scalar flow(int slice) const { return flow_[slice]; }        ///< p U, Pa m/s
  Scalar supply() const { return supply_; }                    ///< what flows in, the same

 private:
  using Column = std::vector<Scalar>;
  static constexpr int K = Case::slice_count;

  static constexpr bool stores() {
    if constexpr (requires { Case::gas_storage; }) return Case::gas_storage;
    return false;
  }

  /// Of a slice in which the gas flows; its mean pressure says how.
  SliceFlow<Scalar> slice(const SliceBed<Scalar>& bed, Scalar mean, Scalar flow) const {
    const Scalar share = mean / outlet;
    return any_slice_flow<Case>(bed,
                                {flow / mean, Scalar(Case::gas_density) * share, Scalar(Case::gas_viscosity) / share});
  }

  /// Flow into the first node at pressure p there, and its slope over p; where that pressure is given, nothing.
  std::pair<Scalar, Scalar> inflow([[maybe_unused]] Scalar p) const {
    if constexpr (requires { Case::gas_blower_flow; }) {
      const Scalar most = outlet * Scalar(Case::gas_blower_flow) / section, limit = Case::gas_blower_pressure;
      return {most * (1 - (p - outlet) / limit), -most / limit};
    } else {
      return {outlet * velocity_, 0};
    }
  }

  Flows advance(const Beds& beds, bool stores) {
    Column p = pressure_, phi = flow_, c(K, 0);
    Flows flows(K);
    for (int iteration = 0; iteration < 60; ++iteration) {
      std::vector<Column> slope(2 * K, Column(2 * K, 0));  // rows and columns: K pressures, then K flows
      Column error(2 * K);
      for (int k = 0; k < K; ++k) {
        const Scalar mean = (pressure_[k] + pressure_[k + 1]) / 2;
        flows[k] = slice(beds[k], mean, phi[k]);
        const Scalar step = std::max(std::abs(phi[k]), outlet * Scalar(1e-3L)) * Scalar(1e-6L);
        const Scalar rise = slice(beds[k], mean, phi[k] + step).pressure_gradient -
                            slice(beds[k], mean, phi[k] - step).pressure_gradient;
        error[K + k] = dz * flows[k].pressure_gradient - (p[k] - p[k + 1]);
        slope[K + k][k] = 1;
        if (k + 1 < K) slope[K + k][k + 1] = -1;
        slope[K + k][K + k] = -dz * rise / (2 * step);
      }
      for (int k = 0; k < K && stores; ++k) c[k] = capacity(flows, k);
      for (int k = 0; k < K; ++k) {
        const auto [in, in_slope] = k > 0 ? std::pair<Scalar, Scalar>(phi[k - 1], 0) : inflow(p[0]);
        error[k] = in - phi[k] - c[k] * (p[k] - pressure_[k]);
        slope[k][k] = c[k] - in_slope;
        if (k > 0) slope[k][K + k - 1] = -1;
        slope[k][K + k] = 1;
      }
      if constexpr (requires { Case::gas_inlet_pressure; }) {
        slope[0].assign(2 * K, 0);
        slope[0][0] = 1, error[0] = Scalar(Case::gas_inlet_pressure) - p[0];
      }
      const Column change = solution(slope, error);
      Scalar moved = 0, largest = outlet * Scalar(1e-3L);
      for (int k = 0; k < K; ++k) {
        p[k] += change[k], phi[k] += change[K + k];
        moved = std::max(moved, std::abs(change[K + k])), largest = std::max(largest, std::abs(phi[k]));
      }
      if (moved < largest * 1000 * std::numeric_limits<Scalar>::epsilon()) break;
    }
    supply_ = phi[0] + c[0] * (p[0] - pressure_[0]);
    const Scalar share = stores ? 1 : 1 / (1 + std::abs(p[0] - outlet) / outlet);
    for (int k = 0; k < K; ++k) pressure_[k] += share * (p[k] - pressure_[k]);
    flow_ = phi;
    return flows;
  }

  /// c of a node; void fractions are those of whole sections.
  Scalar capacity(const Flows& flows, int k) const {
    const auto half = [&](int s) { return dz / 2 * (1 - (1 - flows[s].void_fraction) * flows[s].bed_area / section); };
    Scalar supply = 0;
    if constexpr (requires { Case::gas_supply_volume; }) supply = Case::gas_supply_volume;
    return (half(k) + (k > 0 ? half(k - 1) : supply / section)) / (Case::gas_update_interval * Scalar(Case::time_step));
  }

  static inline const Scalar outlet = Case::gas_outlet_pressure, dz = Scalar(Case::pipe_length) / K;
  static inline const Scalar section =
      std::acos(Scalar(-1)) * Scalar(Case::pipe_diameter) * Scalar(Case::pipe_diameter) / 4;
  Column pressure_, flow_;
  Scalar velocity_ = 0, supply_ = 0;
};

}  // namespace fixdem::reference
