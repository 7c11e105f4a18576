// What every step keeps an eye on: greatest overlap, greatest speed, finiteness, and the energy ledger.
//
// One watch for each range of contacts and its chunk, so that chunks can be worked off in any order. Eight partial
// values each, whatever the register width, so that sums have one order everywhere. Overlap and speed are of the step
// just done; the ledger runs from the start. Scaled as in contact_law.hpp: times mass gives joules.
#pragma once

#include "lanes.hpp"

namespace fixdem {

/// Energy booked so far; absent in a case without ledger.
template <bool present>
struct Ledger {
  alignas(64) double damping_power[8];  ///< scaled force times velocity, summed over steps and contacts
  alignas(64) double sliding_work[8];   ///< scaled force times displacement
  alignas(64) double gas_work[8];       ///< scaled force times velocity
};
template <>
struct Ledger<false> {};

template <class Case>
struct Watch {
  alignas(64) double overlap[8];        ///< greatest overlaps, m
  alignas(64) double motion_square[8];  ///< greatest squares of each column of motion
  alignas(64) double square_sum[8];     ///< sum of the same; not finite as soon as one value is not
  [[no_unique_address]] Ledger<Case::energy_ledger> ledger;

  void begin_step() {
    for (int k = 0; k < 8; ++k) overlap[k] = motion_square[k] = square_sum[k] = 0;
  }
  /// Bound on the speed of every particle, m/s: the root of the sum of the greatest squares of each component.
  double speed_bound() const { return sqrt(motion_square[0] + motion_square[1] + motion_square[2]); }
};

constexpr double sum_of(const double (&a)[8]) {
  return ((a[0] + a[1]) + (a[2] + a[3])) + ((a[4] + a[5]) + (a[6] + a[7]));
}
inline double greatest_of(const double (&a)[8]) {
  double greatest = 0;
  for (double x : a) greatest = max(x, greatest);
  return greatest;
}

/// Eight partial values of the watch in registers, for the length of a loop.
template <int W, int Count = 8>
struct Partials {
  using V = Lanes<W>;
  V part[Count / W];
  FIXDEM_INLINE explicit Partials(const double* from) {
    for (int p = 0; p < Count / W; ++p) part[p] = load<V>(from + p * W);
  }
  FIXDEM_INLINE void put_back(double* to) const {
    for (int p = 0; p < Count / W; ++p) store(to + p * W, part[p]);
  }
};

}  // namespace fixdem
