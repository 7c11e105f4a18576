// Where contacts live: batches of near pairs and near walls, the force rows they write, and who sums which rows.
//
// The pipe is cut into chunks of consecutive particles. A chunk owns the pairs whose lower-numbered particle is its
// own; the partner is in the same chunk or one of the next, the span. Pairs stand in batches of 8 (16 in mixed
// precision) with 16-bit row numbers relative to the chunk, and their history beside them, in a region of its own for
// each chunk, so that one chunk can be listed again while the others stay. Each contact of a dense range writes one
// force row (those of sparse ones are added to a sum for each particle: sparse_contacts.hpp); a chunk needs the rows
// of its own contacts and of the span before it, so a ring of as many sets of rows and one is enough and stays in the
// cache; steps that are computed together (tiles.hpp) have a ring each. Pairs across the periodic ends have rows of
// their own. A particle's slot list names the rows it adds (its own contacts) and subtracts (those of lower-numbered
// partners), padded with a row of zeros to equal lengths; particles of one chunk are bucketed by that length. There is
// no scatter, and the order of every sum is fixed.
#pragma once

#include "force_rows.hpp"
#include "validity.hpp"

namespace fixdem {

/// The numbers that one contact keeps, wherever they lie.
template <class T>
struct HistoryNumbers {
  T* first;
  int stride;
  HistoryNumbers(T* first_number, int numbers_between) : first(first_number), stride(numbers_between) {}
  template <class U>
  HistoryNumbers(const HistoryNumbers<U>& from) : first(from.first), stride(from.stride) {}
  T& operator[](int c) const { return first[c * stride]; }
};

namespace detail {
/// Histories of a kind of contact. Where all contacts of a range are computed (dense), number c of the lanes of a batch
/// lies side by side; where only those that touch are (sparse), the numbers of one contact do, in rows of a multiple
/// of 4.
template <class Case, int Batches, int Numbers>
struct HistoryBatches {
  static constexpr int batch = Capacity<Case>::batch, row_width = (Numbers + 3) / 4 * 4;
  alignas(64) Real<Case> value[Batches * batch * row_width];

  /// Batch `b` of a dense range whose first one is `first`.
  Real<Case> (*lanes(int first, int b))[batch] {
    return reinterpret_cast<Real<Case>(*)[batch]>(value + (first * row_width + (b - first) * Numbers) * batch);
  }
  /// Row of contact `number`, counted from the first one of all ranges.
  Real<Case>* row(int number) { return value + std::size_t(number) * row_width; }

  /// Contact k of the range that begins at batch `first`.
  HistoryNumbers<Real<Case>> of(bool is_sparse, int first, int k) {
    if (is_sparse) return {row(first * batch + k), 1};
    return {lanes(first, first + k / batch)[0] + k % batch, batch};
  }
  HistoryNumbers<const Real<Case>> of(bool is_sparse, int first, int k) const {
    return const_cast<HistoryBatches*>(this)->of(is_sparse, first, k);
  }
};
template <class Case, int Batches>
struct HistoryBatches<Case, Batches, 0> {
  HistoryNumbers<Real<Case>> of(bool, int, int) const { return {nullptr, 0}; }
};

}  // namespace detail

/// Near pairs. Range c holds those of chunk c; range `chunks` those across the periodic ends, whose owners count from
/// the first particle and whose partners from `Rows::wrap_base`.
template <class Case>
struct PairBatches {
  using Cap = Capacity<Case>;
  using Law = ContactLaw<Case, false>;
  static constexpr int history_size = Law::history_size;
  static constexpr int ranges = Cap::chunks + (Derived<Case>::is_periodic ? 1 : 0);
  static constexpr int batches_per_range = Cap::chunk_pairs / Cap::batch;
  static constexpr int batches =
      Cap::chunks * batches_per_range + (Derived<Case>::is_periodic ? Cap::wrap_pairs / Cap::batch : 0);
  static constexpr int capacity(int range) { return range == Cap::chunks ? Cap::wrap_pairs : Cap::chunk_pairs; }
  /// First batch of a range.
  static constexpr int first(int range) { return range * batches_per_range; }

  alignas(64) typename Rows<Case>::Offset owner[batches][Cap::batch];
  alignas(64) typename Rows<Case>::Offset partner[batches][Cap::batch];
  [[no_unique_address]] detail::HistoryBatches<Case, batches, history_size> history;
  std::uint16_t touching[batches];  ///< sparse ranges: a bit for each lane that touched, or was given a history
  Validity validity[ranges];
  int count[ranges];    ///< pairs in each range; the last batch is filled up with copies of its last pair
  bool sparse[ranges];  ///< so few of them touch that those are looked up first (sparse_contacts.hpp)

  auto history_of(int range, int k) { return history.of(sparse[range], first(range), k); }
  auto history_of(int range, int k) const { return history.of(sparse[range], first(range), k); }
  void note_history(int range, int k) {
    touching[first(range) + k / Cap::batch] |= static_cast<std::uint16_t>(1u << k % Cap::batch);
  }
};

/// Where the two sides of a range of pairs start, and the shift of the partner along z.
template <class Case>
struct PairRange {
  int owner_base, partner_base;
  double shift;
  explicit PairRange(int range) {
    const bool wraps =
        range == Capacity<Case>::chunks;  // the owner is at the start of the pipe, its partner at the end
    owner_base = wraps ? 0 : range * Capacity<Case>::chunk_size;
    partner_base = wraps ? Rows<Case>::wrap_base : owner_base;
    shift = wraps ? -Case::pipe_length : 0;
  }
};

/// From owners to partners, the square of the distance, and with several sizes r_i + r_j. Offsets count from the two
/// rows.
template <class Case, int W, class Offset>
FIXDEM_INLINE Separation<Lanes<W>> separation_of_pairs(const double* partner_position, const Offset* partner,
                                                       const double* owner_position, const Offset* owner,
                                                       double shift) {
  Separation<Lanes<W>> s{};
  if constexpr (has_sizes<Case>) {
    const Vec4<Lanes<W>> r = load_separations<W>(partner_position, partner, owner_position, owner);
    s.separation = {r.x, r.y, r.z}, s.reach = r.w;
  } else {
    s.separation = load_differences<W>(partner_position, partner, owner_position, owner);
  }
  s.separation.z = s.separation.z + shift;
  s.gap_square = dot(s.separation, s.separation);
  return s;
}

/// Near walls of one kind; at most one contact of a kind per particle.
template <class Case, class WallSurface, bool is_present = WallSurface::is_present>
struct WallBatches {
  using Surface = WallSurface;
  using Cap = Capacity<Case>;
  static constexpr Surface surface{};
  using Law = ContactLaw<Case, true>;
  static constexpr int history_size = Law::history_size;
  static constexpr int batches_per_chunk = Cap::chunk_size / Cap::batch;
  static constexpr int batches = Cap::chunks * batches_per_chunk;
  /// First batch of a chunk.
  static constexpr int first(int chunk) { return chunk * batches_per_chunk; }

  alignas(64) typename Rows<Case>::Offset owner[batches][Cap::batch];
  [[no_unique_address]] detail::HistoryBatches<Case, batches, history_size> history;
  std::uint16_t touching[batches];
  Validity validity[Cap::chunks];
  int count[Cap::chunks];
  bool sparse[Cap::chunks];

  auto history_of(int chunk, int k) { return history.of(sparse[chunk], first(chunk), k); }
  auto history_of(int chunk, int k) const { return history.of(sparse[chunk], first(chunk), k); }
  void note_history(int chunk, int k) {
    touching[first(chunk) + k / Cap::batch] |= static_cast<std::uint16_t>(1u << k % Cap::batch);
  }
};
template <class Case, class Surface>
struct WallBatches<Case, Surface, false> {};

/// Batches that hold so many contacts.
template <class Case>
constexpr int batches_for(int contacts) {
  return (contacts + Capacity<Case>::batch - 1) / Capacity<Case>::batch;
}

namespace detail {
template <int Count, bool present>
struct RadiiIfSeveral {
  alignas(64) double of[Count];
};
template <int Count>
struct RadiiIfSeveral<Count, false> {};
}  // namespace detail

/// What sorting (order.hpp) and the outer list (outer_list.hpp) need for their duration.
template <class Case>
struct SortScratch {
  static constexpr int count = Case::particle_count;
  int source[count];                                            ///< present number of the particle that goes there
  alignas(64) double x[count + 8], y[count + 8], z[count + 8];  ///< places in the new order
  [[no_unique_address]] detail::RadiiIfSeveral<count + 8, has_sizes<Case>> radius;
};

template <class Case>
struct Contacts {
  using D = Derived<Case>;
  using Cap = Capacity<Case>;
  static constexpr int row_width = Particles<Case>::motion_width;
  PairBatches<Case> pairs;
  [[no_unique_address]] WallBatches<Case, PipeSurface<Case>> pipe;
  [[no_unique_address]] WallBatches<Case, EndSurfaces<Case>> ends;

  /// A ring of force rows for each step of a tile, with the rows that it keeps for its second phase. They are dealt out
  /// by the span as it is at the last sort; the deepest tile has room for all at the span of a pipe that is a third
  /// full.
  static constexpr int rows_for(int span, int steps) {
    return steps == 1 ? Rows<Case>::ring(span + 1) : steps * Rows<Case>::ring(2 * span + 1);
  }
  static constexpr int row_count = rows_for(Cap::span, 1) > rows_for(Cap::usual_span, Cap::tile_steps)
                                       ? rows_for(Cap::span, 1)
                                       : rows_for(Cap::usual_span, Cap::tile_steps);
  alignas(64) Real<Case> rows[row_count * row_width];
  [[no_unique_address]] detail::PartnerTorques<Case, row_count> torques;
  std::uint32_t row_owner[row_count], row_partner[row_count];  ///< of rows that are added later
  int rows_for_later[Cap::tile_steps][Cap::span + 1];          ///< the last ones of the pairs across the ends
  int span;  ///< chunks behind its own in which the partners of a chunk lie

  Real<Case>* ring(int step) { return rows + step * Rows<Case>::ring(2 * span + 1) * row_width; }
  /// On the partner of the contact with that force row.
  Real<Case>* torque_at(const Real<Case>* row) { return torques.at((row - rows) / row_width); }
  const Real<Case>* torque_at(const Real<Case>* row) const { return torques.at((row - rows) / row_width); }
  /// Visits the row of zeros of each ring that there is room for.
  template <class F>
  void for_each_row_of_zeros(F&& f) const {
    for (int at = Rows<Case>::zero, step = 0; step < Cap::tile_steps && at < row_count; ++step) {
      f(rows + at * row_width);
      at += Rows<Case>::ring(2 * span + 1);
    }
  }
  /// Another span moves the rings, and with them the rows of zeros onto rows that have been in use.
  void set_span(int chunks) {
    span = chunks;
    for_each_row_of_zeros([&](const Real<Case>* row) {
      for (int c = 0; c < row_width; ++c) rows[row - rows + c] = 0;
      if constexpr (has_partner_torques<Case>)
        for (int c = 0; c < 4; ++c) torque_at(row)[c] = 0;
    });
  }
  /// First force row of a chunk's contacts, and of what a tile keeps.
  int first_row(int chunk) const { return Rows<Case>::ring(chunk % (span + 1)); }
  int first_kept_row(int chunk) const { return Rows<Case>::ring(span + 1 + chunk % span); }
  /// Where sparse contacts put what is added later: those across the ends, and those of a chunk that a tile keeps.
  RowsForLater<Case> across_for_later(int step) { return for_later(step, Rows<Case>::zero - 1, Cap::span); }
  RowsForLater<Case> chunk_for_later(int step, int chunk) {
    return for_later(step, first_kept_row(chunk) + Rows<Case>::of_chunk - 1, chunk % span);
  }

  /// Velocity change of each particle by the sparse contacts so far; zero again once it has moved.
  alignas(64) Real<Case> sum[Case::particle_count][row_width];

  /// Rows a particle can own: its near pairs, the pipe wall and an end wall.
  static constexpr int max_slots = Cap::neighbours + kinds_of_wall<Case>;
  /// Slot entries: particle, k own rows, k incoming rows; read four numbers at a time, beyond the last too. Bucket k of
  /// a chunk has `bucket[chunk][k]` particles.
  union {
    typename Rows<Case>::SlotOffset slots[Cap::chunks][Cap::chunk_size * (2 * max_slots + 1) + 3];
    SortScratch<Case> sort;  ///< in the same place: after a sort all slot lists are made again
  };
  int bucket[Cap::chunks][max_slots + 1];
  bool slots_are_stale[Cap::chunks];  ///< a range that the chunk sums has been listed again
  bool has_rows[Cap::chunks];         ///< some such range is dense
  bool has_sums[Cap::chunks];         ///< some such range is sparse

 private:
  RowsForLater<Case> for_later(int step, int last, int place) {
    const int at = step * Rows<Case>::ring(2 * span + 1) + last;
    return {rows + at * row_width, torques.at(at), row_owner + at, row_partner + at, &rows_for_later[step][place]};
  }
};

/// Calls f(walls) for each kind of wall that the case has; `contacts` may be const.
template <class Case, class F>
FIXDEM_INLINE void for_each_wall(Contacts<Case>& contacts, F&& f) {
  if constexpr (PipeSurface<Case>::is_present) f(contacts.pipe);
  if constexpr (EndSurfaces<Case>::is_present) f(contacts.ends);
}
template <class Case, class F>
FIXDEM_INLINE void for_each_wall(const Contacts<Case>& contacts, F&& f) {
  for_each_wall(const_cast<Contacts<Case>&>(contacts), [&](const auto& walls) FIXDEM_INLINE_LAMBDA { f(walls); });
}

/// Chunks in use, the first ones, and the particles of a chunk; all but the last in use are full.
template <class Case>
int chunks_in_use(const Particles<Case>& p) {
  return (p.rows() + Capacity<Case>::chunk_size - 1) / Capacity<Case>::chunk_size;
}
template <class Case>
int particles_in(const Particles<Case>& p, int chunk) {
  constexpr int size = Capacity<Case>::chunk_size;
  const int rest = p.rows() - chunk * size;
  if (is_line<Case> && rest < 0) return 0;
  return rest < size ? rest : size;
}

}  // namespace fixdem
