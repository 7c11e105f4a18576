// The near list: who may touch whom, and for how long that stays true.
//
// A promise in time. Pairs closer than d + margin and particles closer than margin to a wall are listed; nothing else
// can touch until some particle's speed bound has used up half the margin. The margin is what the present speed would
// use up in `horizon_steps`, within bounds, so a bed at rest keeps a list of almost exactly its contacts. Being an
// upper bound, the list causes no error: what it omits does not touch.
//
// Renewal (renewal.hpp) sorts the particles along the pipe, so the candidates of a particle are the next ones in memory
// until z differs by the cut-off.
#pragma once

#include "contacts.hpp"

namespace fixdem {

inline constexpr double horizon_steps = 240;     ///< as long as a list of a bed should last; measured optimum 200-300
inline constexpr double greatest_margin = 0.04;  ///< in diameters; two margins stay below the 0.1 d that floaters need
inline constexpr double least_margin = 1e-5;     ///< in diameters: at rest, before gravity has acted

template <class Case>
struct NearList {
  using D = Derived<Case>;
  using Cap = Capacity<Case>;
  static constexpr int count = Case::particle_count;
  static constexpr int history_size = ContactLaw<Case, false>::history_size;
  /// Copies of the first particles, shifted by a period, behind the last; then a lane group that ends every search.
  static constexpr int copies = D::is_periodic ? (count < Cap::chunk_size ? count : Cap::chunk_size) : 0;

  double margin;  ///< m
  double spent;   ///< way of the fastest particle since renewal, m
  long long renewals;

  alignas(64) double x[count + copies + 16], y[count + copies + 16], z[count + copies + 16];
  typename Rows<Case>::Offset own_row[count][Contacts<Case>::max_slots];
  typename Rows<Case>::Offset incoming_row[count][Cap::neighbours];
  unsigned char own_count[count], incoming_count[count];
  int wrap_owner[Cap::wrap_pairs], wrap_partner[Cap::wrap_pairs];

  // High-water marks of the capacities.
  int most_neighbours, most_chunk_pairs, most_wrap_pairs, most_reach;

  bool expired() const { return !(2 * spent <= margin); }
  void spend(double way) { spent += way; }
  void choose_margin(double speed) {
    const double wanted = 2 * speed * Case::time_step * horizon_steps * 1.2;
    constexpr double least = least_margin * Case::diameter, greatest = greatest_margin * Case::diameter;
    margin = wanted < least ? least : (wanted > greatest ? greatest : wanted);
    spent = 0;
  }
};

}  // namespace fixdem
