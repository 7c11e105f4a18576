// Where contacts live: batches of near pairs and near walls, the force rows they write, and who sums which rows.
//
// The pipe is cut into chunks of consecutive particles. A chunk owns the pairs whose lower-numbered particle is its
// own; the partner is in the same chunk or the next. Pairs stand in batches of 8 with 16-bit row numbers relative to
// the chunk, and their history beside them. Each contact writes one force row; a chunk needs the rows of its own
// contacts and of its predecessor's, so a ring of two sets of rows is enough and stays in the first-level cache. Pairs
// across the periodic ends have rows of their own. A particle's slot list names the rows it adds (its own contacts) and
// subtracts (those of lower-numbered partners), padded with a row of zeros to equal lengths; particles of one chunk are
// bucketed by that length. There is no scatter, and the order of every sum is fixed.
#pragma once

#include "contact_law.hpp"
#include "particles.hpp"
#include "rows.hpp"

namespace fixdem {

namespace detail {
template <int Batches, int Numbers>
struct HistoryBatches {
  alignas(64) double value[Batches][Numbers][8];
};
template <int Batches>
struct HistoryBatches<Batches, 0> {};
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
  static constexpr int batches =
      Cap::chunks * Cap::chunk_pairs / 8 + (Derived<Case>::is_periodic ? Cap::wrap_pairs / 8 : 0);

  alignas(64) typename Rows<Case>::Offset owner[batches][8];
  alignas(64) typename Rows<Case>::Offset partner[batches][8];
  [[no_unique_address]] detail::HistoryBatches<batches, history_size> history;
  int first[ranges + 1];  ///< first batch of each range
  int count[ranges];      ///< pairs in it; the last batch is filled up with copies that are masked out
  bool sparse[ranges];    ///< so few of them touch that whole batches are likely to be open
};

/// Near walls of one kind; at most one contact of a kind per particle.
template <class Case, bool present>
struct WallBatches {
  using Cap = Capacity<Case>;
  static constexpr int history_size = ContactLaw<Case, true>::history_size;
  static constexpr int batches = Cap::chunks * Cap::chunk_size / 8;

  alignas(64) typename Rows<Case>::Offset owner[batches][8];
  [[no_unique_address]] detail::HistoryBatches<batches, history_size> history;
  int first[Cap::chunks + 1];
  int count[Cap::chunks];
};
template <class Case>
struct WallBatches<Case, false> {};

template <class Case>
struct Contacts {
  using D = Derived<Case>;
  using Cap = Capacity<Case>;
  static constexpr int row_width = Particles<Case>::motion_width;

  PairBatches<Case> pairs;
  [[no_unique_address]] WallBatches<Case, Case::has_wall> pipe;
  [[no_unique_address]] WallBatches<Case, D::has_ends> ends;

  alignas(64) double rows[(Rows<Case>::zero + 1) * row_width];

  /// Rows a particle can own: its near pairs, the pipe wall and an end wall.
  static constexpr int max_slots = Cap::neighbours + (Case::has_wall ? 1 : 0) + (D::has_ends ? 1 : 0);
  /// Slot entries: particle, k own rows, k incoming rows. Bucket k of a chunk has `bucket[chunk][k]` particles.
  typename Rows<Case>::Offset slots[Case::particle_count * (2 * max_slots + 1)];
  int first_slot[Cap::chunks];
  int bucket[Cap::chunks][max_slots + 1];
  int near_count[Case::particle_count];  ///< near pairs of each particle
};

}  // namespace fixdem
