// Histories of contacts that come from outside, at a start.
#pragma once

#include "step.hpp"

namespace fixdem::detail {

/// Gives the near contact of two rows its history, seen from `i`; `j` is a row, or a wall (surfaces.hpp). Metres, or
/// newtons with the incremental forms; `rolling` may be null.
template <class Case>
void restore_history(State<Case>& s, int i, int j, const double* history, const double* rolling) {
  constexpr double unit =
      Case::tangential == TangentialLaw::displacement ? 1 : Case::time_step / Derived<Case>::reference_mass;
  s.histories_given_at = s.step;
  const auto set = [&](auto& batches, int range, int k, double sign) {
    using Law = typename std::remove_reference_t<decltype(batches)>::Law;
    if constexpr (Law::history_vectors > 0) {
      const auto numbers = batches.history_of(range, k);
      for (int c = 0; c < 3; ++c) numbers[c] = static_cast<Real<Case>>(sign * unit * history[c]);
      if constexpr (Law::has_rolling)  // the same from either side
        for (int c = 0; c < 3; ++c)
          numbers[Law::rolling_place + c] = static_cast<Real<Case>>(rolling != nullptr ? unit * rolling[c] : 0);
      batches.note_history(range, k);
    }
  };
  if (j >= 0) {
    const int low = i < j ? i : j, high = i < j ? j : i;
    const auto set_pair = [&](int range, int k, int a, int b) {
      if (a == low && b == high) set(s.contacts.pairs, range, k, i < j ? 1 : -1);
    };
    for_each_near_pair_in(s.contacts, low / Capacity<Case>::chunk_size, set_pair);
    if constexpr (Derived<Case>::is_periodic) for_each_near_pair_in(s.contacts, Capacity<Case>::chunks, set_pair);
    return;
  }
  for_each_wall(s.contacts, [&](auto& walls) {
    if ((j == pipe_wall) != (walls.surface.kept_as == pipe_wall)) return;
    for_each_near_wall_in<Case>(walls, i / Capacity<Case>::chunk_size, [&](int chunk, int k, int row) {
      if (row == i) set(walls, chunk, k, 1);
    });
  });
}

/// Contacts that exist at the start have not begun in the first step (impulse_law.hpp).
template <class Case>
void mark_contacts_as_found(Contacts<Case>& contacts) {
  const auto mark = [](auto& batches) {
    return [&batches](int range, int k, int, int = 0) {
      constexpr int place = std::remove_reference_t<decltype(batches)>::Law::state_function_place;
      batches.history_of(range, k)[place] = found_at_start;
      batches.note_history(range, k);
    };
  };
  for_each_near_pair(contacts, mark(contacts.pairs));
  for_each_wall(contacts, [&](auto& walls) { for_each_near_wall<Case>(walls, mark(walls)); });
}

}  // namespace fixdem::detail
