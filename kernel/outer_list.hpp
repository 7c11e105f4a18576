// The outer list: all pairs that were closer than d + outer margin when particles were last sorted.
//
// Pairs lie in ranges as those of the near list do, which is made out of it (near_list.hpp). It lasts until two
// particles can have come its margin nearer to each other, whatever their chunks. How pairs are found:
// outer_search.hpp.
#pragma once

#include "contacts.hpp"
#include "status.hpp"

namespace fixdem {

inline constexpr double least_outer_margin = 0.02;  ///< that can be used up, in diameters

/// Range c holds those of chunk c; behind the last come those across the periodic ends. Row numbers as in the batches
/// (contacts.hpp).
template <class Case>
struct OuterList {
  using Cap = Capacity<Case>;
  using Offset = typename Rows<Case>::Offset;
  static constexpr int capacity(int range) {
    return (range == Cap::chunks ? Cap::outer_wrap_pairs : Cap::outer_pairs) - Cap::batch;
  }
  static constexpr int first(int range) { return range * Cap::outer_pairs; }
  static constexpr int size = Cap::chunks * Cap::outer_pairs + (Derived<Case>::is_periodic ? Cap::outer_wrap_pairs : 0);

  alignas(64) Offset owner[size], partner[size];  ///< the last ones are repeated up to a full batch
  int pairs[PairBatches<Case>::ranges];
  double margin;                    ///< m
  int span;                         ///< chunks behind its own in which the partners of a chunk lie
  int reach;                        ///< particles between one and its last partner at most
  int last_at_start, first_at_end;  ///< chunks up to and from which particles have pairs across the periodic ends
  int slabs;                        ///< of cells in use: all but in a line, which may be empty towards its outlet
  int cell_start[Cells<Case>::count + 1];  ///< first particle of each cell in use, at the last sort
  /// How far a particle may come, m. With gas the list must go on holding what makes a bed (floaters.hpp).
  double allowed_travel() const {
    return 0.5 * (margin - (Case::has_gas ? (near_reach - 1) * smallest_diameter<Case> : 0));
  }
  bool concerns_ends(int chunk) const { return chunk <= last_at_start || chunk >= first_at_end; }
};

namespace detail {

/// Pairs on their way into the list, and what is learned of them.
template <class Case>
struct FoundPairs {
  using Cap = Capacity<Case>;
  using R = Rows<Case>;
  OuterList<Case>& outer;
  int span = Cap::chunks > 1 ? 1 : 0, farthest = 0;
  int crowded = -1;  ///< a particle whose pair is one too many

  explicit FoundPairs(OuterList<Case>& list) : outer(list) {
    outer.last_at_start = -1, outer.first_at_end = Cap::chunks;
    for (int& pairs : outer.pairs) pairs = 0;
  }
  static int chunk_of(int particle) { return Cap::chunks > 1 ? particle / Cap::chunk_size : 0; }

  FIXDEM_INLINE void add(int range, int owner, int partner) {
    int& pairs = outer.pairs[range];
    if (pairs == outer.capacity(range)) {
      crowded = range == Cap::chunks ? owner : range * Cap::chunk_size + owner;
      return;
    }
    outer.owner[outer.first(range) + pairs] = R::offset(owner);
    outer.partner[outer.first(range) + pairs++] = R::offset(partner);
  }
  /// Two particles, i before j in the order.
  FIXDEM_INLINE void add_pair(int i, int j) {
    const int range = chunk_of(i), base = range * Cap::chunk_size;
    add(range, i - base, j - base);
  }
  /// How far the last partner of a particle is from it.
  FIXDEM_INLINE void note_distance(int i, int last) {
    farthest = last - i > farthest ? last - i : farthest;
    const int chunks = last / Cap::chunk_size - chunk_of(i);
    span = chunks > span ? chunks : span;
  }
  /// One at the start of a periodic pipe, one at its end.
  FIXDEM_INLINE void add_across(int at_start, int at_end) {
    if (at_end < R::wrap_base || at_start >= Cap::in_reach) farthest = Cap::in_reach + 1;
    add(Cap::chunks, at_start, at_end - R::wrap_base);
    const int first = at_start / Cap::chunk_size, last = chunk_of(at_end);
    outer.last_at_start = first > outer.last_at_start ? first : outer.last_at_start;
    outer.first_at_end = last < outer.first_at_end ? last : outer.first_at_end;
  }
};

}  // namespace detail

}  // namespace fixdem
