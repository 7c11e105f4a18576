// The outer list: all pairs that were closer than d + outer margin when particles were last sorted.
//
// Each particle is compared with those behind it in its own cell and in the neighbouring ones, which are five runs of
// consecutive particles: the rest of its row, the next row, and three rows of the next slab, behind the last slab of a
// periodic pipe the first. Pairs lie in ranges as those of the near list do, which is made out of it (near_list.hpp).
// It lasts until two particles can have come its margin nearer to each other, whatever their chunks.
#pragma once

#include "contacts.hpp"
#include "status.hpp"

namespace fixdem {

inline constexpr double least_outer_margin = 0.02;  ///< that can be used up, in diameters
inline constexpr double near_reach = 1.1;  ///< centres nearer than this, in diameters, make a particle part of the bed

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
  int cell_start[Cells<Case>::count + 1];  ///< first particle of each cell, at the last sort
  /// How far a particle may come, m. With gas the list must go on holding what makes a bed (floaters.hpp).
  double allowed_travel() const { return 0.5 * (margin - (Case::has_gas ? (near_reach - 1) * Case::diameter : 0)); }
  bool concerns_ends(int chunk) const { return chunk <= last_at_start || chunk >= first_at_end; }
};

namespace detail {

/// Calls found(j) for the particles `from` to `to` whose centres lie within the cut-off of (x, y, z).
template <int W, class Case, class Found>
FIXDEM_INLINE void search(const SortScratch<Case>& at, double x, double y, double z, int from, int to,
                          double square_cut, Found&& found) {
  using V = Lanes<W>;
  for (int j = from; j < to; j += W) {
    const V dx = load_any<V>(at.x + j) - x, dy = load_any<V>(at.y + j) - y, dz = load_any<V>(at.z + j) - z;
    unsigned hits = bits_below(fused(dz, dz, fused(dy, dy, dx * dx)), splat<V>(square_cut));
    if (to - j < W) hits &= (1u << (to - j)) - 1;
    for (; hits != 0; hits &= hits - 1) found(j + __builtin_ctz(hits));
  }
}

/// Runs of particles in the cells around one, of which its particles are compared with all.
template <class Case>
struct Runs {
  int from[3], to[3], count = 0;
  /// Those of row `iy` of slab `iz`, up to a cell to the left and right of ix.
  FIXDEM_INLINE void add(const int* cell_start, int ix, int iy, int iz) {
    constexpr int across = Cells<Case>::across;
    if (iy < 0 || iy >= across) return;
    const int row = (iz * across + iy) * across;
    from[count] = cell_start[row + (ix > 0 ? ix - 1 : 0)];
    to[count] = cell_start[row + (ix + 2 < across ? ix + 2 : across)];
    count += from[count] < to[count];
  }
};

/// Finds all pairs nearer than d + margin, and the chunks they join. A fault tells that there is not enough room.
template <class Case, int W>
Status find_outer_pairs(OuterList<Case>& outer, const SortScratch<Case>& at, const Particles<Case>& p, double margin) {
  using Cap = Capacity<Case>;
  using C = Cells<Case>;
  using R = Rows<Case>;
  const double square_cut = (Case::diameter + margin) * (Case::diameter + margin);
  int span = Cap::chunks > 1 ? 1 : 0, farthest = 0, crowded = -1;
  outer.last_at_start = -1, outer.first_at_end = Cap::chunks;
  for (int& pairs : outer.pairs) pairs = 0;
  const auto add = [&](int range, int owner, int partner) FIXDEM_INLINE_LAMBDA {
    int& pairs = outer.pairs[range];
    if (pairs == outer.capacity(range)) {
      crowded = range == Cap::chunks ? owner : range * Cap::chunk_size + owner;
      return;
    }
    outer.owner[outer.first(range) + pairs] = R::offset(owner);
    outer.partner[outer.first(range) + pairs++] = R::offset(partner);
  };
  for (int iz = 0; iz < C::along && crowded < 0; ++iz)
    for (int iy = 0; iy < C::across; ++iy)
      for (int ix = 0; ix < C::across; ++ix) {
        const int* const start = outer.cell_start + (iz * C::across + iy) * C::across + ix;
        if (start[0] == start[1]) continue;
        const int end_of_row = start[ix + 1 < C::across ? 2 : 1];
        Runs<Case> row, slab;
        row.add(outer.cell_start, ix, iy + 1, iz);
        const bool is_last = iz + 1 == C::along;
        if (!is_last || Derived<Case>::is_periodic)
          for (int dy = -1; dy <= 1; ++dy) slab.add(outer.cell_start, ix, iy + dy, is_last ? 0 : iz + 1);
        for (int i = start[0]; i < start[1]; ++i) {
          const int range = Cap::chunks > 1 ? i / Cap::chunk_size : 0, base = range * Cap::chunk_size;
          const double x = at.x[i], y = at.y[i], z = at.z[i];
          int last = i;
          const auto found = [&](int j) FIXDEM_INLINE_LAMBDA {
            add(range, i - base, j - base);
            last = j;
          };
          search<W>(at, x, y, z, i + 1, end_of_row, square_cut, found);
          for (int k = 0; k < row.count; ++k) search<W>(at, x, y, z, row.from[k], row.to[k], square_cut, found);
          if (!is_last)
            for (int k = 0; k < slab.count; ++k) search<W>(at, x, y, z, slab.from[k], slab.to[k], square_cut, found);
          else if constexpr (Derived<Case>::is_periodic)
            for (int k = 0; k < slab.count; ++k)
              search<W>(at, x, y, z - Case::pipe_length, slab.from[k], slab.to[k], square_cut, [&](int j) {
                if (i < R::wrap_base || j >= Cap::in_reach) farthest = Cap::in_reach + 1;
                add(Cap::chunks, j, i - R::wrap_base);
                outer.last_at_start =
                    j / Cap::chunk_size > outer.last_at_start ? j / Cap::chunk_size : outer.last_at_start;
                outer.first_at_end = range < outer.first_at_end ? range : outer.first_at_end;
              });
          if (last - i > farthest) farthest = last - i;
          if (last / Cap::chunk_size - range > span) span = last / Cap::chunk_size - range;
          if (farthest > Cap::in_reach) return {Fault::chunk_capacity, p.id[i], 0, 1.0 * farthest, 1.0 * Cap::in_reach};
        }
      }
  outer.span = span, outer.reach = farthest;
  if (crowded >= 0) return {Fault::pair_capacity, p.id[crowded], 0, Cap::outer_pairs + 1.0, 1.0 * Cap::outer_pairs};
  return {};
}

}  // namespace detail

/// The outer list of a new order. Where pairs are more than it has room for, with a smaller margin.
template <class Case, int W>
Status list_outer(OuterList<Case>& outer, SortScratch<Case>& at, const Particles<Case>& p) {
  for (int i = 0; i < Case::particle_count; ++i)
    at.x[i] = p.position[i][0], at.y[i] = p.position[i][1], at.z[i] = p.position[i][2];
  for (int i = Case::particle_count; i < Case::particle_count + 8; ++i) at.x[i] = at.y[i] = at.z[i] = 0;
  outer.margin = outer_margin<Case> * Case::diameter;
  for (;; outer.margin *= 0.9) {
    const Status status = detail::find_outer_pairs<Case, W>(outer, at, p, outer.margin);
    if (status.fault != Fault::pair_capacity) {
      for (int range = 0; range < PairBatches<Case>::ranges; ++range)
        for (int k = outer.pairs[range]; k % Capacity<Case>::batch != 0; ++k) {
          const int place = outer.first(range) + k;
          outer.owner[place] = outer.owner[place - 1], outer.partner[place] = outer.partner[place - 1];
        }
      return status;
    }
    if (outer.allowed_travel() < least_outer_margin * Case::diameter) return status;
  }
}

}  // namespace fixdem
