// What every step checks: maximum overlap, minimum and maximum velocities, finiteness, and the energy ledger.
//
// One monitor for each range of contacts and its chunk, so that chunks can be computed in any order. Eight partial
// values each (as many as a batch has lanes), whatever the register width, so that sums have one order everywhere.
// Overlap and speed are of the step just done; the ledger runs from the start. Scaled as in contact_law.hpp: times mass
// gives joules.
#pragma once

#include "capacity.hpp"
#include "lanes.hpp"

namespace fixdem {

/// Entries that contacts book: damping_power, scaled force times velocity, over steps and contacts; sliding_work and
/// law_work, scaled force times displacement, and with rolling resistance rolling_work, likewise.
enum LedgerEntry { damping_power, sliding_work, law_work, rolling_work };
template <class Case>
inline constexpr int ledger_entries = Derived<Case>::has_rolling ? 4 : 3;

/// Energy booked so far; absent in a case without ledger.
template <class Case, bool present = Case::energy_ledger>
struct Ledger {
  alignas(64) double entry[ledger_entries<Case>][Capacity<Case>::batch];
  alignas(64) double gas_work[8];  ///< scaled force times velocity
};
template <class Case>
struct Ledger<Case, false> {};

template <class Case>
struct StepMonitor {
  alignas(64) Real<Case> overlap[Capacity<Case>::batch];  ///< maximum overlaps, m
  alignas(64) double low[8], high[8];                     ///< minimum and maximum of each column of motion
  alignas(64) double square_sum[8];  ///< sum of their squares; not finite as soon as one value is not
  [[no_unique_address]] Ledger<Case> ledger;

  void begin_step() {
    for (auto& maximum : overlap) maximum = 0;
    for (int k = 0; k < 8; ++k) low[k] = 1e300, high[k] = -1e300, square_sum[k] = 0;
  }
};

template <int Size>
constexpr double sum_of(const double (&a)[Size]) {
  double sum = 0;
  for (int k = 0; k < Size; k += 8)
    sum += ((a[k] + a[k + 1]) + (a[k + 2] + a[k + 3])) + ((a[k + 4] + a[k + 5]) + (a[k + 6] + a[k + 7]));
  return sum;
}
template <class T, int Size>
double maximum_of(const T (&a)[Size]) {
  T maximum = 0;
  for (T x : a) maximum = max(x, maximum);
  return maximum;
}

/// Partial values of the monitor in registers, for the length of a loop.
template <int W, int Count, class T = double>
struct Partials {
  using V = Lanes<W, T>;
  V part[Count / W];
  FIXDEM_INLINE explicit Partials(const T* from) {
    for (int p = 0; p < Count / W; ++p) part[p] = load<V>(from + p * W);
  }
  FIXDEM_INLINE void put_back(T* to) const {
    for (int p = 0; p < Count / W; ++p) store(to + p * W, part[p]);
  }
};

}  // namespace fixdem
