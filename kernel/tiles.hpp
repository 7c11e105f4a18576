// Several steps at once, so that a long pipe passes through the cache once for all of them.
//
// A front runs along the pipe; behind it chunk c is one step further than chunk c + span, the span being the chunks
// behind its own in which partners of a chunk lie. Step t of chunk c needs the chunks up to c + span after step t - 1,
// which the front has just left in the cache, and the rows of the span before it in the ring of step t. Everything a
// chunk does, its checks and listings included, depends on itself and its neighbours only, so the state after a tile is
// that of plain steps bit for bit (tests/tiles_test.cpp).
//
// The ends of a periodic pipe depend on each other, so a tile has two phases (here with a span of 1):
//
//   step 2      . . 2 2 2 2 2 . . .      first the numbered chunks, step t from `first_chunk(t)` on, losing the span at
//   step 1      . 1 1 1 1 1 1 1 . .      either end with each step;
//   step 0      0 0 0 0 0 0 0 0 0 0      then the dots, step by step: the wedge around the cut.
//
// What the second phase needs of the first is the far end's last rows, which are still in their rings, and the rows of
// the span before the first chunk of each step, which the first phase has to compute anyway and keeps.
#pragma once

#include "step.hpp"

namespace fixdem {

/// The chunks of a tile's steps, with the span and the ends as they are since the last sort.
template <class Case>
struct TileShape {
  int span, last_at_start, first_at_end, chunks;
  explicit TileShape(const State<Case>& s)
      : span(s.near_list.outer.span),
        last_at_start(s.near_list.outer.last_at_start),
        first_at_end(s.near_list.outer.first_at_end),
        chunks(chunks_in_use(s.particles)) {}
  /// Chunks that step t moves in the first phase.
  int first_chunk(int t) const { return Derived<Case>::is_periodic && t > 0 ? last_at_start + 1 + (t - 1) * span : 0; }
  int end_chunk(int t) const { return Derived<Case>::is_periodic && t > 0 ? first_at_end - (t - 1) * span : chunks; }
  bool fits(int depth) const {
    return depth == 1 || (first_chunk(depth - 1) + span < end_chunk(depth - 1) &&
                          Contacts<Case>::rows_for(span, depth) <= Contacts<Case>::row_count);
  }
};

/// Steps that can be done together from the present one on: up to the next decision about the order or the next update
/// of the gas, as the pipe is long enough and there is room for rows.
template <class Case>
int tile_depth(const State<Case>& s, long long steps) {
  constexpr int maximum = Capacity<Case>::tile_steps;
  static_assert(maximum >= 1 && maximum <= order_interval, "fixdem: [capacity] tile_steps must lie between 1 and 16");
  static_assert(Capacity<Case>::chunks >= chunks_for_tile(maximum),
                "fixdem: tiles need a pipe of many chunks: lower [capacity] tile_steps");
  if (maximum == 1) return 1;
  if constexpr (is_line<Case> && !requires { Case::tile_steps; })
    if (s.particles.rows() < scene_beyond_caches) return 1;
  long long depth = steps < maximum ? steps : maximum;
  const auto end_before = [&](long long left) { depth = left < depth ? left : depth; };
  end_before(s.near_list.next_decision - s.step);
  if constexpr (is_line<Case>) end_before(Case::feed_interval - s.step % Case::feed_interval);
  if constexpr (Case::has_gas) {
    end_before(Case::gas_update_interval - s.step % Case::gas_update_interval);
    end_before(Case::gas_floater_interval - s.step % Case::gas_floater_interval);
  }
  const TileShape<Case> shape(s);
  while (!shape.fits(static_cast<int>(depth))) --depth;
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
  if (chunk >= chunks_in_use(s.particles)) return;
  const int base = chunk * Capacity<Case>::chunk_size, particles = particles_in(s.particles, chunk);
  prefetch(s.particles.position[base], 4 * particles);
  prefetch(s.particles.motion[base], Particles<Case>::motion_width * particles);
  if constexpr (is_mixed<Case>)
    prefetch(s.particles.motion_as_float.row[base], Particles<Case>::motion_width * particles);
  const auto batches = [](const auto& kind, int range) {
    const int first = kind.first(range), count = batches_for<Case>(kind.count[range]);
    prefetch(kind.owner + first, count);
    if constexpr (requires { kind.partner; }) prefetch(kind.partner + first, count);
    if constexpr (std::remove_cvref_t<decltype(kind)>::history_size > 0)
      prefetch(kind.history_of(range, 0).first, count * Capacity<Case>::batch * kind.history.row_width);
  };
  batches(s.contacts.pairs, chunk);
  for_each_wall(s.contacts, [&](const auto& walls) { batches(walls, chunk); });
  if (!s.contacts.has_rows[chunk]) return;
  int entries = 0;
  for (int k = 0; k <= Contacts<Case>::max_slots; ++k) entries += s.contacts.bucket[chunk][k] * (2 * k + 1);
  prefetch(s.contacts.slots[chunk], entries);
}

/// Copies the dense rows of a chunk from one place of a ring to another.
template <class Case>
void copy_rows(Contacts<Case>& contacts, int chunk, Real<Case>* ring, int from, int to) {
  const int rows = for_each_wall_row<Case>(contacts, chunk, [](const auto&, int) {}) - contacts.first_row(chunk);
  constexpr int width = Contacts<Case>::row_width;
  __builtin_memcpy(ring + to * width, ring + from * width, static_cast<std::size_t>(rows * width) * sizeof(Real<Case>));
  if constexpr (has_partner_torques<Case>)
    __builtin_memcpy(contacts.torque_at(ring + to * width), contacts.torque_at(ring + from * width),
                     static_cast<std::size_t>(rows * 4) * sizeof(Real<Case>));
}

}  // namespace detail

/// `depth` steps of the whole pipe; depth as tile_depth says.
template <class Case, int W>
void tile(State<Case>& s, int depth) {
  const int chunks = chunks_in_use(s.particles);
  constexpr bool is_periodic = Derived<Case>::is_periodic;
  Contacts<Case>& contacts = s.contacts;
  const TileShape<Case> shape(s);
  const auto step_chunk = [&](int chunk, int t) {
    compute_range<Case, W>(s, chunk, contacts.ring(t), s.step + t);
    move_chunk<Case, W>(s, chunk, t);
  };
  // Contacts of a chunk of the span before the first one: for the particles that move in the first phase now, and for
  // the others, with the dense rows, in the second.
  const auto compute_and_keep = [&](int chunk, int t) {
    const RowsForLater<Case> later = contacts.chunk_for_later(t, chunk);
    compute_range<Case, W>(s, chunk, contacts.ring(t), s.step + t, &later);
    add_later<Case, W>(later, contacts.sum[0], shape.first_chunk(t), chunks);
    detail::copy_rows(contacts, chunk, contacts.ring(t), contacts.first_row(chunk), contacts.first_kept_row(chunk));
  };
  const auto take_kept = [&](int chunk, int t) {
    add_later<Case, W>(contacts.chunk_for_later(t, chunk), contacts.sum[0], 0, shape.first_chunk(t));
    detail::copy_rows(contacts, chunk, contacts.ring(t), contacts.first_kept_row(chunk), contacts.first_row(chunk));
    move_chunk<Case, W>(s, chunk, t);
  };

  if constexpr (is_periodic) compute_across<Case, W>(s);
  for (int front = 0; front < chunks + (depth - 1) * shape.span; ++front) {
    detail::prefetch_chunk(s, front + prefetch_lead);
    for (int t = 0; t < depth; ++t) {
      const int chunk = front - t * shape.span, first = shape.first_chunk(t);
      if (chunk >= first && chunk < shape.end_chunk(t)) {
        step_chunk(chunk, t);
      } else if (is_periodic && chunk >= 0 && chunk < first && chunk >= first - shape.span) {
        compute_and_keep(chunk, t);
      }
    }
  }
  if constexpr (is_periodic) {
    for (int t = 1; t < depth; ++t) {
      compute_across<Case, W>(s, t);
      for (int chunk = shape.end_chunk(t); chunk < chunks; ++chunk) step_chunk(chunk, t);
      for (int chunk = 0; chunk < shape.first_chunk(t); ++chunk) {
        if (chunk < shape.first_chunk(t) - shape.span)
          step_chunk(chunk, t);
        else
          take_kept(chunk, t);
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
