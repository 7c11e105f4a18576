// Slot lists: which force rows each particle of a chunk adds and subtracts.
//
// Made from the batches of the chunk itself, of its predecessor (whose pairs reach into it) and of the periodic ends.
// Rows are named by offsets into the ring of a step: those of the chunk's pairs come first, then its walls. Particles
// are bucketed by the greater of their own and incoming rows, short ones first, so that the loop over a bucket
// (motion.hpp) has a fixed length; what is missing is padded with the row of zeros.
#pragma once

#include "listing.hpp"

namespace fixdem {

/// First row of the walls of a chunk, behind its pairs; of the ends, behind the pipe's.
template <class Case>
int first_pipe_row(const Contacts<Case>& contacts, int chunk) {
  return Rows<Case>::first(chunk) + Capacity<Case>::batch * batches_for<Case>(contacts.pairs.count[chunk]);
}
template <class Case>
int first_end_row(const Contacts<Case>& contacts, int chunk) {
  int row = first_pipe_row(contacts, chunk);
  if constexpr (Case::has_wall) row += Capacity<Case>::batch * batches_for<Case>(contacts.pipe.count[chunk]);
  return row;
}

/// Slot lists of one chunk. A fault names a particle with too many near neighbours.
template <class Case>
Status list_slots(Contacts<Case>& contacts, NearList<Case>& near, const Particles<Case>& p,
                  ListingScratch<Case>& scratch, int chunk) {
  using Cap = Capacity<Case>;
  using R = Rows<Case>;
  constexpr int kinds = Contacts<Case>::max_slots + 1;
  const int base = chunk * Cap::chunk_size, particles = particles_in<Case>(chunk);
  unsigned char own[Cap::chunk_size] = {}, incoming[Cap::chunk_size] = {}, neighbours[Cap::chunk_size] = {};
  int crowded = -1;
  const auto book = [&](int i, auto& rows, unsigned char* used, int row) {
    if (neighbours[i] == Cap::neighbours) {
      crowded = i;
      return;
    }
    ++neighbours[i];
    rows[i][used[i]++] = R::offset(row);
  };
  // Pairs of one range, as far as they concern this chunk.
  const auto book_range = [&](int range, int owner_base, int partner_base, int first_row) {
    const int first = PairBatches<Case>::first(range);
    for (int k = 0; k < contacts.pairs.count[range]; ++k) {
      const int batch = first + k / Capacity<Case>::batch, lane = k % Capacity<Case>::batch;
      const int owner = owner_base + R::number(contacts.pairs.owner[batch][lane]) - base;
      const int partner = partner_base + R::number(contacts.pairs.partner[batch][lane]) - base;
      if (owner >= 0 && owner < particles) book(owner, scratch.own_row, own, first_row + k);
      if (partner >= 0 && partner < particles) book(partner, scratch.incoming_row, incoming, first_row + k);
    }
  };
  if (chunk > 0) book_range(chunk - 1, base - Cap::chunk_size, base - Cap::chunk_size, R::first(chunk - 1));
  book_range(chunk, base, base, R::first(chunk));
  const auto book_walls = [&](const auto& walls, int first_row) {
    for (int k = 0; k < walls.count[chunk]; ++k) {
      const int i = R::number(walls.owner[walls.first(chunk) + k / Capacity<Case>::batch][k % Capacity<Case>::batch]);
      scratch.own_row[i][own[i]++] = R::offset(first_row + k);
    }
  };
  if constexpr (Case::has_wall) book_walls(contacts.pipe, first_pipe_row(contacts, chunk));
  if constexpr (Derived<Case>::has_ends) book_walls(contacts.ends, first_end_row(contacts, chunk));
  if constexpr (Derived<Case>::is_periodic)
    if (chunk == 0 || chunk + 2 >= Cap::chunks) book_range(Cap::chunks, 0, R::wrap_base, R::wrap_first);
  if (crowded >= 0) return {Fault::neighbour_capacity, p.id[base + crowded], 0, Cap::neighbours + 1, Cap::neighbours};

  const auto length = [&](int i) { return own[i] > incoming[i] ? own[i] : incoming[i]; };
  int* bucket = contacts.bucket[chunk];
  for (int k = 0; k < kinds; ++k) bucket[k] = 0;
  for (int i = 0; i < particles; ++i) ++bucket[length(i)];
  int next[kinds];
  for (int k = 0, entry = 0; k < kinds; ++k) {
    next[k] = entry;
    entry += bucket[k] * (2 * k + 1);
  }
  for (int i = 0; i < particles; ++i) {
    const int k = length(i);
    auto* slot = contacts.slots[chunk] + next[k];
    next[k] += 2 * k + 1;
    *slot++ = R::offset(i);
    for (int s = 0; s < k; ++s) *slot++ = s < own[i] ? scratch.own_row[i][s] : R::offset(R::zero);
    for (int s = 0; s < k; ++s) *slot++ = s < incoming[i] ? scratch.incoming_row[i][s] : R::offset(R::zero);
    contacts.near_count[base + i] = neighbours[i];
    if (neighbours[i] > near.most_neighbours) near.most_neighbours = neighbours[i];
  }
  contacts.slots_are_stale[chunk] = false;
  return {};
}

}  // namespace fixdem
