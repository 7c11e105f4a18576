// Energies that contacts take and make, summed while the contact loop runs; nothing in a case without ledger.
//
// A force F that acts over a step of length dt changes the kinetic energy by exactly F.(v + v')/2 dt, v and v' the
// velocities before and after the step. Booked are, with u the surface velocity and a bar for the mean of before and
// after, as far as this contact changes it (what other contacts do to it meanwhile is not known here):
//   damping   D.u dt with its mean, D the force of both dampings;
//   sliding   (s + s')/2 . (slip that the spring did not take up), s and s' the spring's force now and a step ago;
//   law       the change of the spring's energy s^2 / (2 k_t), less the work (s + s')/2 . slip done on it, plus what
//             sliding took: what the law makes (above zero) or loses because k_t follows the overlap;
//   rolling   damping and sliding of the rolling spring (rolling.hpp); what its stiffness makes is part of law.
// For conservative forms all three are of second order in the step; what other contacts change is of first order.
//
// Summed in double always: of dense ranges per lane of a batch, of sparse ranges in eight partial sums by the number of
// the contact in its range, so that the sums depend neither on how many lanes the machine has nor on packing. Lanes
// behind the last contact repeat it (listing.hpp): the ledger is the only one that must not see them.
#pragma once

#include "contact_law.hpp"
#include "contacts.hpp"
#include "step_monitor.hpp"

namespace fixdem {

namespace detail {
/// What a contact books, in the order of LedgerEntry.
template <class Case, class V, class F>
FIXDEM_INLINE void for_each_entry(const ContactForce<V>& f, F&& book) {
  book(damping_power, f.damping_power);
  book(sliding_work, f.sliding_work);
  if constexpr (Derived<Case>::has_rolling) {
    book(law_work, f.law_work + f.rolling.law_work);
    book(rolling_work, f.rolling.work);
  } else {
    book(law_work, f.law_work);
  }
}
}  // namespace detail

template <class Case, int W, bool present = Case::energy_ledger>
struct BookedEnergy {
  static constexpr int lanes = Capacity<Case>::batch, doubles = is_mixed<Case> && W > 1 ? W / 2 : W;
  static constexpr int entries = ledger_entries<Case>, parts = lanes / doubles;
  Lanes<doubles> part[entries][parts];
  FIXDEM_INLINE explicit BookedEnergy(const StepMonitor<Case>& monitor) {
    for (int e = 0; e < entries; ++e)
      for (int p = 0; p < parts; ++p) part[e][p] = load<Lanes<doubles>>(monitor.ledger.entry[e] + p * doubles);
  }
  FIXDEM_INLINE void put_back(StepMonitor<Case>& monitor) const {
    for (int e = 0; e < entries; ++e)
      for (int p = 0; p < parts; ++p) store(monitor.ledger.entry[e] + p * doubles, part[e][p]);
  }
  /// Of W contacts from `lane` of their batch on, the first `valid`: lanes behind the last contact of a range repeat
  /// it.
  template <class V>
  FIXDEM_INLINE void book(int lane, int valid, const ContactForce<V>& f) {
    const auto counts = load<V>(lane_numbers) < splat<V>(valid);
    detail::for_each_entry<Case>(
        f, [&](int entry, V value) FIXDEM_INLINE_LAMBDA { add(part[entry], lane, where(counts, value)); });
  }

 private:
  alignas(64) static constexpr Real<Case> lane_numbers[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};

  template <class V>
  static FIXDEM_INLINE void add(Lanes<doubles> (&sums)[parts], int lane, V value) {
    if constexpr (is_mixed<Case>) {
      alignas(64) float values[W];
      store(values, value);
      for (int k = 0; k < W; k += doubles)
        sums[(lane + k) / doubles] = sums[(lane + k) / doubles] + load_wide<doubles>(values + k);
    } else {
      sums[lane / W] = sums[lane / W] + value;
    }
  }
};
template <class Case, int W>
struct BookedEnergy<Case, W, false> {
  FIXDEM_INLINE explicit BookedEnergy(const StepMonitor<Case>&) {}
  FIXDEM_INLINE void put_back(StepMonitor<Case>&) const {}
  template <class V>
  FIXDEM_INLINE void book(int, int, const ContactForce<V>&) {}
};

/// Entries of packed contacts, until they are summed.
template <class Case, int Room, bool present = Case::energy_ledger>
struct EnergyEntries {
  alignas(64) Real<Case> entry[ledger_entries<Case>][(Room + 15) / 16 * 16];  // each begins at 64 bytes
  template <class V>
  FIXDEM_INLINE void put(int k, const ContactForce<V>& f) {
    detail::for_each_entry<Case>(f, [&](int e, V value) FIXDEM_INLINE_LAMBDA { store(entry[e] + k, value); });
  }
  /// Those of the contacts from `begin` to `end`, which are of one range; the first of them is its `number`-th. Each
  /// goes to the partial sum of its number, eight at a time.
  void sum(int begin, int end, int number, StepMonitor<Case>& monitor) const {
    for (int e = 0; e < ledger_entries<Case>; ++e) add(entry[e], begin, end, number, monitor.ledger.entry[e]);
  }

 private:
  static void add(const Real<Case>* entry, int begin, int end, int number, double* sum) {
    double partial[8];
    for (int j = 0; j < 8; ++j) partial[j] = sum[j];
    int k = begin;
    for (int j = number % 8; j > 0 && j < 8 && k < end; ++j, ++k) partial[j] += entry[k];
    for (; k + 8 <= end; k += 8)
      for (int j = 0; j < 8; ++j) partial[j] += entry[k + j];
    for (int j = 0; k + j < end; ++j) partial[j] += entry[k + j];
    for (int j = 0; j < 8; ++j) sum[j] = partial[j];
  }
};
template <class Case, int Room>
struct EnergyEntries<Case, Room, false> {
  template <class V>
  FIXDEM_INLINE void put(int, const ContactForce<V>&) {}
  void sum(int, int, int, StepMonitor<Case>&) const {}
};

}  // namespace fixdem
