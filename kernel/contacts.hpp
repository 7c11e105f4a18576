// Where contacts live: batches of near pairs and near walls, the force rows they write, and who sums which rows.
//
// The pipe is cut into chunks of consecutive particles. A chunk owns the pairs whose lower-numbered particle is its
// own; the partner is in the same chunk or the next. Pairs stand in batches of 8 (16 in mixed precision) with 16-bit
// row numbers relative to the chunk, and their history beside them, in a region of its own for each chunk, so that one
// chunk can be listed anew while the others stay. Each contact writes one force row; a chunk needs the rows of its own
// contacts and of its predecessor's, so a ring of two sets of rows is enough and stays in the cache; steps that are
// worked off together (tiles.hpp) have a ring each. Pairs across the periodic ends have rows of their own. A particle's
// slot list names the rows it adds (its own contacts) and subtracts (those of lower-numbered partners), padded with a
// row of zeros to equal lengths; particles of one chunk are bucketed by that length. There is no scatter, and the order
// of every sum is fixed.
#pragma once

#include "contact_law.hpp"
#include "particles.hpp"
#include "rows.hpp"

namespace fixdem {

namespace detail {
template <class Case, int Batches, int Numbers>
struct HistoryBatches {
  alignas(64) Real<Case> value[Batches][Numbers][Capacity<Case>::batch];
};
template <class Case, int Batches>
struct HistoryBatches<Case, Batches, 0> {};

template <class Case, bool present, int Steps, int Size>
struct EdgeRows {
  alignas(64) Real<Case> rows[Steps][Size];
};
template <class Case, int Steps, int Size>
struct EdgeRows<Case, false, Steps, Size> {};
}  // namespace detail

/// Numbering of the force rows: two chunks in turn, the pairs across the ends, and one row of zeros.
template <class Case>
struct Rows {
  using Cap = Capacity<Case>;
  using D = Derived<Case>;
  static constexpr int of_chunk =
      Cap::chunk_pairs + (Case::has_wall ? Cap::chunk_size : 0) + (D::has_ends ? Cap::chunk_size : 0);
  static constexpr int wrap_first = 2 * of_chunk;
  static constexpr int zero = wrap_first + (D::is_periodic ? Cap::wrap_pairs : 0);
  /// First force row of a chunk's contacts.
  static constexpr int first(int chunk) { return (chunk & 1) * of_chunk; }

  using Offset = RowOffset<zero + 1>;  // force rows outnumber the particles of two chunks
  static constexpr Offset offset(int number) { return static_cast<Offset>(8 * number); }
  static constexpr int number(Offset offset) { return static_cast<int>(offset / 8); }

  /// First particle that partners across the ends are counted from: they lie in the last two chunks.
  static constexpr int wrap_base = Cap::chunks > 2 ? (Cap::chunks - 2) * Cap::chunk_size : 0;
};

/// Near pairs. Range c holds those of chunk c; range `chunks` those across the periodic ends, whose owners count from
/// the first particle and whose partners from `Rows::wrap_base`.
template <class Case>
struct PairBatches {
  using Cap = Capacity<Case>;
  static constexpr int history_size = ContactLaw<Case, false>::history_size;
  static constexpr int ranges = Cap::chunks + (Derived<Case>::is_periodic ? 1 : 0);
  static constexpr int batches_per_range = Cap::chunk_pairs / Cap::batch;
  static constexpr int batches = ranges * batches_per_range;
  /// First batch of a range.
  static constexpr int first(int range) { return range * batches_per_range; }

  alignas(64) typename Rows<Case>::Offset owner[batches][Cap::batch];
  alignas(64) typename Rows<Case>::Offset partner[batches][Cap::batch];
  [[no_unique_address]] detail::HistoryBatches<Case, batches, history_size> history;
  std::uint16_t touching[batches];  ///< sparse ranges: a bit for each lane that touched in the last step
  int count[ranges];                ///< pairs in each range; the last batch is filled up with copies of its last pair
  bool sparse[ranges];              ///< so few of them touch that those are looked up first (sparse_contacts.hpp)
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

/// Near walls of one kind; at most one contact of a kind per particle.
template <class Case, bool present>
struct WallBatches {
  using Cap = Capacity<Case>;
  static constexpr int history_size = ContactLaw<Case, true>::history_size;
  static constexpr int batches_per_chunk = Cap::chunk_size / Cap::batch;
  static constexpr int batches = Cap::chunks * batches_per_chunk;
  /// First batch of a chunk.
  static constexpr int first(int chunk) { return chunk * batches_per_chunk; }

  alignas(64) typename Rows<Case>::Offset owner[batches][Cap::batch];
  [[no_unique_address]] detail::HistoryBatches<Case, batches, history_size> history;
  std::uint16_t touching[batches];
  int count[Cap::chunks];
  bool sparse[Cap::chunks];
};
template <class Case>
struct WallBatches<Case, false> {};

/// Batches that hold so many contacts.
template <class Case>
constexpr int batches_for(int contacts) {
  return (contacts + Capacity<Case>::batch - 1) / Capacity<Case>::batch;
}

template <class Case>
struct Contacts {
  using D = Derived<Case>;
  using Cap = Capacity<Case>;
  static constexpr int row_width = Particles<Case>::motion_width;
  static constexpr int rows_per_ring = (Rows<Case>::zero + 2) / 2 * 2 * row_width;  ///< whole lines of the cache

  PairBatches<Case> pairs;
  [[no_unique_address]] WallBatches<Case, Case::has_wall> pipe;
  [[no_unique_address]] WallBatches<Case, D::has_ends> ends;

  /// A ring of force rows for each step of a tile, and the rows that a tile keeps for its second phase.
  alignas(64) Real<Case> rows[Cap::tile_steps][rows_per_ring];
  [[no_unique_address]] detail::EdgeRows<Case, (Cap::tile_steps > 1), Cap::tile_steps, Rows<Case>::of_chunk * row_width>
      edge;

  /// Rows a particle can own: its near pairs, the pipe wall and an end wall.
  static constexpr int max_slots = Cap::neighbours + (Case::has_wall ? 1 : 0) + (D::has_ends ? 1 : 0);
  /// Slot entries: particle, k own rows, k incoming rows; read four numbers at a time, beyond the last too. Bucket k of
  /// a chunk has `bucket[chunk][k]` particles.
  typename Rows<Case>::Offset slots[Cap::chunks][Cap::chunk_size * (2 * max_slots + 1) + 3];
  int bucket[Cap::chunks][max_slots + 1];
  bool slots_are_stale[Cap::chunks];     ///< a range that the chunk sums has been listed anew
  int near_count[Case::particle_count];  ///< near pairs of each particle
};

/// Particles of a chunk; all but the last are full.
template <class Case>
constexpr int particles_in(int chunk) {
  constexpr int size = Capacity<Case>::chunk_size;
  const int rest = Case::particle_count - chunk * size;
  return rest < size ? rest : size;
}

}  // namespace fixdem
