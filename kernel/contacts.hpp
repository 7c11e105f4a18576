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

/// Near pairs. Range c holds those of chunk c; range `chunks` those across the periodic ends, whose owners count from
/// the first particle and whose partners from `Contacts::wrap_base`.
template <class Case>
struct PairBatches {
  using Cap = Capacity<Case>;
  static constexpr int history_size = ContactLaw<Case, false>::history_size;
  static constexpr int ranges = Cap::chunks + (Derived<Case>::is_periodic ? 1 : 0);
  static constexpr int batches =
      Cap::chunks * Cap::chunk_pairs / 8 + (Derived<Case>::is_periodic ? Cap::wrap_pairs / 8 : 0);

  alignas(64) RowOffset owner[batches][8];
  alignas(64) RowOffset partner[batches][8];
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

  alignas(64) RowOffset owner[batches][8];
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

  static constexpr int chunk_rows =
      Cap::chunk_pairs + (Case::has_wall ? Cap::chunk_size : 0) + (D::has_ends ? Cap::chunk_size : 0);
  static constexpr int wrap_first_row = 2 * chunk_rows;
  static constexpr int zero_row = wrap_first_row + (D::is_periodic ? Cap::wrap_pairs : 0);
  static_assert(zero_row < nameable_rows, "fixdem: too many force rows in a chunk: lower [capacity] neighbours");
  alignas(64) double rows[(zero_row + 1) * row_width];

  /// First force row of a chunk's contacts.
  static constexpr int first_row(int chunk) { return (chunk & 1) * chunk_rows; }
  static constexpr int wrap_base = Case::particle_count > nameable_rows ? Case::particle_count - nameable_rows : 0;

  /// Rows a particle can own: its near pairs, the pipe wall and an end wall.
  static constexpr int max_slots = Cap::neighbours + (Case::has_wall ? 1 : 0) + (D::has_ends ? 1 : 0);
  /// Slot entries: particle, k own rows, k incoming rows. Bucket k of a chunk has `bucket[chunk][k]` particles.
  RowOffset slots[Case::particle_count * (2 * max_slots + 1)];
  int first_slot[Cap::chunks];
  int bucket[Cap::chunks][max_slots + 1];
  int near_count[Case::particle_count];  ///< near pairs of each particle
};

}  // namespace fixdem
