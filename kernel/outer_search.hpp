// Finding the pairs of the outer list, cell by cell.
//
// Equal spheres: each is compared with those behind it in its own cell and in the neighbouring ones, which are five
// runs of consecutive particles: the rest of its row, the next row, and three rows of the next slab, behind the last
// slab of a periodic pipe the first.
//
// Several sizes: cells are made for the smallest spheres, and each pair is found by the larger of its two, which looks
// into as many cells around it as its own size makes necessary (Cells::reach_of), behind and before it; so no small
// sphere is tested against the reach of a large one. The smallest, which find each other only, look behind as equal
// ones do. Of two equal spheres the first in the order finds the other.
#pragma once

#include "outer_list.hpp"

namespace fixdem {

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

/// The partners of the particles of a cell, all of one size.
template <int W, class Case>
FIXDEM_INLINE void search_around(FoundPairs<Case>& pairs, const SortScratch<Case>& at, int ix, int iy, int iz,
                                 double margin) {
  using C = Cells<Case>;
  const int* const cells = pairs.outer.cell_start;
  const int* const start = cells + (iz * C::across + iy) * C::across + ix;
  const double cut = outer_reach<Case>(largest_diameter<Case>, margin), square_cut = cut * cut;
  const int end_of_row = start[ix + 1 < C::across ? 2 : 1];
  Runs<Case> row, slab;
  row.add(cells, ix, iy + 1, iz);
  const bool is_last = iz + 1 == pairs.outer.slabs;
  if (!is_last || Derived<Case>::is_periodic)
    for (int dy = -1; dy <= 1; ++dy) slab.add(cells, ix, iy + dy, is_last ? 0 : iz + 1);
  for (int i = start[0]; i < start[1]; ++i) {
    const double x = at.x[i], y = at.y[i], z = at.z[i];
    int last = i;
    const auto found = [&](int j) FIXDEM_INLINE_LAMBDA {
      pairs.add_pair(i, j);
      last = j;
    };
    search<W>(at, x, y, z, i + 1, end_of_row, square_cut, found);
    for (int k = 0; k < row.count; ++k) search<W>(at, x, y, z, row.from[k], row.to[k], square_cut, found);
    if (!is_last)
      for (int k = 0; k < slab.count; ++k) search<W>(at, x, y, z, slab.from[k], slab.to[k], square_cut, found);
    else if constexpr (Derived<Case>::is_periodic)
      for (int k = 0; k < slab.count; ++k)
        search<W>(at, x, y, z - Case::pipe_length, slab.from[k], slab.to[k], square_cut,
                  [&](int j) { pairs.add_across(j, i); });
    pairs.note_distance(i, last);
  }
}

/// The smaller partners of particle i, and the equal ones behind it, among those from `from` to `to`; calls found(j).
/// `z`: of i as the run sees it. `all_equal`: whether equal ones before it count, too (seen across the ends).
template <int W, class Case, class Found>
FIXDEM_INLINE void search_smaller(const SortScratch<Case>& at, int i, double z, int from, int to, double margin,
                                  bool all_equal, Found&& found) {
  using V = Lanes<W>;
  const double r = at.radius.of[i];
  for (int j = from; j < to; j += W) {
    const V dx = load_any<V>(at.x + j) - at.x[i], dy = load_any<V>(at.y + j) - at.y[i], dz = load_any<V>(at.z + j) - z;
    const V radius = load_any<V>(at.radius.of + j), cut = outer_reach<Case>(radius + r, margin);
    unsigned hits = bits_below(fused(dz, dz, fused(dy, dy, dx * dx)), cut * cut) & ~bits_below(splat<V>(r), radius);
    if (to - j < W) hits &= (1u << (to - j)) - 1;
    for (; hits != 0; hits &= hits - 1)
      if (const int k = j + __builtin_ctz(hits); at.radius.of[k] < r || all_equal || k > i) found(k);
  }
}

/// The partners of the particles of a cell, of several sizes.
template <int W, class Case>
void search_by_sizes(FoundPairs<Case>& pairs, const SortScratch<Case>& at, int ix, int iy, int iz, double margin) {
  using C = Cells<Case>;
  constexpr double length = Case::pipe_length;
  const int* const cells = pairs.outer.cell_start;
  const int* const start = cells + (iz * C::across + iy) * C::across + ix;
  for (int i = start[0]; i < start[1]; ++i) {
    const double r = at.radius.of[i];
    const bool is_smallest = 2 * r <= Case::smallest_diameter;
    const int reach = C::reach_of(2 * r);
    const int left = ix > reach ? ix - reach : 0, right = ix + reach + 1 < C::across ? ix + reach + 1 : C::across;
    for (int dz = is_smallest ? 0 : -reach; dz <= reach; ++dz) {
      const bool from_start = iz + dz < 0,
                 from_end = iz + dz >= pairs.outer.slabs;  // of the pipe, seen across its ends
      if ((from_start || from_end) && !Derived<Case>::is_periodic) continue;
      const int slab = iz + dz + (from_start ? C::along : 0) - (from_end ? C::along : 0);
      if (slab < 0 || slab >= C::along) continue;
      for (int dy = is_smallest && dz == 0 ? 0 : -reach; dy <= reach; ++dy) {
        if (iy + dy < 0 || iy + dy >= C::across) continue;
        const int row = (slab * C::across + iy + dy) * C::across;
        const int from = is_smallest && dz == 0 && dy == 0 ? i + 1 : cells[row + left], to = cells[row + right];
        if (from_start)
          search_smaller<W>(at, i, at.z[i] + length, from, to, margin, false, [&](int j) {
            if (at.radius.of[j] < r) pairs.add_across(i, j);
          });
        else if (from_end)
          search_smaller<W>(at, i, at.z[i] - length, from, to, margin, true, [&](int j) { pairs.add_across(j, i); });
        else
          search_smaller<W>(at, i, at.z[i], from, to, margin, false, [&](int j) {
            const int low = i < j ? i : j, high = i < j ? j : i;
            pairs.add_pair(low, high);
            pairs.note_distance(low, high);
          });
      }
    }
  }
}

/// Finds all pairs nearer than the margin allows, and the chunks they join. A fault tells that there is not enough
/// room.
template <class Case, int W>
Status find_outer_pairs(OuterList<Case>& outer, const SortScratch<Case>& at, const Particles<Case>& p, double margin) {
  using Cap = Capacity<Case>;
  using C = Cells<Case>;
  FoundPairs<Case> pairs(outer);
  for (int iz = 0; iz < outer.slabs && pairs.crowded < 0; ++iz)
    for (int iy = 0; iy < C::across; ++iy)
      for (int ix = 0; ix < C::across; ++ix) {
        const int* const start = outer.cell_start + (iz * C::across + iy) * C::across + ix;
        if (start[0] == start[1]) continue;
        if constexpr (has_sizes<Case>)
          search_by_sizes<W>(pairs, at, ix, iy, iz, margin);
        else
          search_around<W>(pairs, at, ix, iy, iz, margin);
        if (pairs.farthest > Cap::in_reach)
          return {Fault::chunk_capacity, p.id[start[0]], 0, 1.0 * pairs.farthest, 1.0 * Cap::in_reach};
      }
  outer.span = pairs.span, outer.reach = pairs.farthest;
  if (pairs.crowded >= 0)
    return {Fault::pair_capacity, p.id[pairs.crowded], 0, Cap::outer_pairs + 1.0, 1.0 * Cap::outer_pairs};
  return {};
}

}  // namespace detail

/// The outer list of a new order. Where pairs are more than it has room for, with a smaller margin.
template <class Case, int W>
Status list_outer(OuterList<Case>& outer, SortScratch<Case>& at, const Particles<Case>& p) {
  const int count = p.rows();
  for (int i = 0; i < count; ++i) at.x[i] = p.position[i][0], at.y[i] = p.position[i][1], at.z[i] = p.position[i][2];
  for (int i = count; i < count + 8; ++i) at.x[i] = at.y[i] = at.z[i] = 0;
  if constexpr (has_sizes<Case>)
    for (int i = 0; i < count + 8; ++i) at.radius.of[i] = i < count ? p.position[i][3] : 0;
  outer.margin = outer_margin<Case> * smallest_diameter<Case>;
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
    if (outer.allowed_travel() < least_outer_margin * smallest_diameter<Case>) return status;
  }
}

}  // namespace fixdem
