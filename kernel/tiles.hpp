// Several steps at once, so that a long pipe passes through the cache once for all of them.
//
// A front runs along the pipe; behind it chunk c is one step further than chunk c + 1. Step t of chunk c needs chunk
// c + 1 after step t - 1, which the front has just left in the cache, and the rows of chunk c - 1 in the ring of step
// t. Everything a chunk does, its checks and the renewal of its near list included, depends on itself and its
// neighbours only, so the state after a tile is that of plain steps to the last bit (tests/tiles_test.cpp).
//
// The ends of a periodic pipe depend on each other, so a tile has two phases:
//
//   step 2      . . 2 2 2 2 2 . . .      first the numbered chunks, step t from chunk t on, losing one chunk a step at
//   step 1      . 1 1 1 1 1 1 1 . .      the far end as well;
//   step 0      0 0 0 0 0 0 0 0 0 0      then the dots, step by step: the wedge around the cut.
//
// What the second phase needs of the first is the far end's last rows, which are still in their rings, and the rows of
// the chunk before chunk t in step t, which the first phase has to compute anyway and keeps.
#pragma once

#include "step.hpp"

namespace fixdem {

/// Steps that can be done together from the present one on: up to the next decision about the order along the pipe or
/// the next update of the gas. One while the scene is in haste.
template <class Case>
int tile_depth(const State<Case>& s, long long steps) {
  constexpr int greatest = Capacity<Case>::tile_steps;
  static_assert(greatest >= 1 && greatest <= order_interval, "fixdem: [capacity] tile_steps must lie between 1 and 16");
  static_assert(Capacity<Case>::chunks >= chunks_for_tile(greatest),
                "fixdem: tiles need a pipe of many chunks: lower [capacity] tile_steps");
  if (greatest == 1 || s.near_list.in_haste) return 1;
  long long depth = steps < greatest ? steps : greatest;
  const auto end_before = [&](int interval) {
    const long long left = interval - s.step % interval;
    if (left < depth) depth = left;
  };
  end_before(order_interval);
  if constexpr (Case::has_gas) {
    end_before(Case::gas_update_interval);
    end_before(Case::gas_floater_interval);
  }
  return static_cast<int>(depth);
}

/// Chunks between the front and what is fetched for it.
inline constexpr int prefetch_lead = 2;

namespace detail {

/// Asks for an array's bytes ahead of their use.
template <class T>
FIXDEM_INLINE void prefetch(const T* from, int count) {
  const char* bytes = reinterpret_cast<const char*>(from);
  for (int k = 0; k < count * static_cast<int>(sizeof(T)); k += 64) __builtin_prefetch(bytes + k, 1);
}

/// Fetches what the front will need of a chunk. Regions of chunks have gaps between them (capacities are larger than
/// what is used), so the machine does not see by itself what comes next.
template <class Case>
void prefetch_chunk(const State<Case>& s, int chunk) {
  if (chunk >= Capacity<Case>::chunks) return;
  const int base = chunk * Capacity<Case>::chunk_size, particles = particles_in<Case>(chunk);
  prefetch(s.particles.position[base], 4 * particles);
  prefetch(s.particles.motion[base], Particles<Case>::motion_width * particles);
  if constexpr (is_mixed<Case>)
    prefetch(s.particles.motion_as_float.row[base], Particles<Case>::motion_width * particles);
  const auto batches = [](const auto& kind, int range) {
    const int first = kind.first(range), count = batches_for<Case>(kind.count[range]);
    prefetch(kind.owner + first, count);
    if constexpr (requires { kind.partner; }) prefetch(kind.partner + first, count);
    if constexpr (keeps_history<Case>) prefetch(kind.history.value + first, count);
  };
  batches(s.contacts.pairs, chunk);
  if constexpr (Case::has_wall) batches(s.contacts.pipe, chunk);
  int entries = 0;
  for (int k = 0; k <= Contacts<Case>::max_slots; ++k) entries += s.contacts.bucket[chunk][k] * (2 * k + 1);
  prefetch(s.contacts.slots[chunk], entries);
}

/// Copies the rows that a chunk has written, between a ring and the rows kept for the second phase.
template <class Case>
void copy_rows(const Contacts<Case>& contacts, int chunk, const Real<Case>* from, Real<Case>* to) {
  int rows = first_end_row(contacts, chunk) - Rows<Case>::first(chunk);
  if constexpr (Derived<Case>::has_ends) rows += Capacity<Case>::batch * batches_for<Case>(contacts.ends.count[chunk]);
  for (int k = 0; k < rows * Contacts<Case>::row_width; ++k) to[k] = from[k];
}

}  // namespace detail

/// `depth` steps of the whole pipe; depth as tile_depth says.
template <class Case, int W>
void tile(State<Case>& s, int depth) {
  constexpr int chunks = Capacity<Case>::chunks;
  constexpr bool is_periodic = Derived<Case>::is_periodic;
  const auto ring = [&](int t) { return s.contacts.rows[t]; };
  const auto rows_of = [&](int t, int chunk) { return ring(t) + Rows<Case>::first(chunk) * Contacts<Case>::row_width; };
  const auto first_chunk = [](int t) { return is_periodic ? t : 0; };
  const auto end_chunk = [](int t) { return is_periodic && t > 0 ? chunks - 1 - t : chunks; };

  if constexpr (is_periodic) write_rows<Case, W>(s, chunks, ring(0), s.step);
  for (int front = 0; front < chunks + depth - 1; ++front) {
    detail::prefetch_chunk(s, front + prefetch_lead);
    for (int t = 0; t < depth; ++t) {
      const int chunk = front - t;
      if (chunk < first_chunk(t) || chunk >= end_chunk(t)) continue;
      if (is_periodic && t > 0 && chunk == first_chunk(t)) {
        write_rows<Case, W>(s, chunk - 1, ring(t), s.step + t);
        detail::copy_rows(s.contacts, chunk - 1, rows_of(t, chunk - 1), s.contacts.edge.rows[t]);
      }
      write_rows<Case, W>(s, chunk, ring(t), s.step + t);
      move_chunk<Case, W>(s, chunk, ring(t), s.step + t);
    }
  }
  if constexpr (is_periodic) {
    for (int t = 1; t < depth; ++t) {
      write_rows<Case, W>(s, chunks, ring(t), s.step + t);
      for (int chunk = end_chunk(t); chunk < chunks; ++chunk) {
        write_rows<Case, W>(s, chunk, ring(t), s.step + t);
        move_chunk<Case, W>(s, chunk, ring(t), s.step + t);
      }
      for (int chunk = 0; chunk < first_chunk(t); ++chunk) {
        if (chunk + 1 == first_chunk(t))
          detail::copy_rows(s.contacts, chunk, s.contacts.edge.rows[t], rows_of(t, chunk));
        else
          write_rows<Case, W>(s, chunk, ring(t), s.step + t);
        move_chunk<Case, W>(s, chunk, ring(t), s.step + t);
      }
    }
  }
  s.step += depth;
}

/// Advances by `steps` steps, or to the first fault.
template <class Case, int W>
void advance(State<Case>& s, long long steps) {
  const long long end = s.step + steps;
  while (s.step < end && s.status.ok()) {
    begin_step<Case, W>(s);
    if (!s.status.ok()) return;
    const int depth = tile_depth(s, end - s.step);
    if (depth == 1) {
      step<Case, W>(s);
    } else if constexpr (Capacity<Case>::tile_steps > 1) {
      tile<Case, W>(s, depth);
    }
  }
}

}  // namespace fixdem
