// Slot lists: which force rows each particle of a chunk adds and subtracts.
//
// Only dense contacts have rows (sparse_contacts.hpp); a chunk without any has no lists. Made from the batches of the
// chunk itself, of the span before it (whose pairs reach into it) and of the periodic ends. Rows are named by offsets
// into the ring of a step: those of the chunk's pairs come first, then its walls. Particles are bucketed by the
// greater of their own and incoming rows, short ones first, so that the loop over a bucket (motion.hpp) has a fixed
// length; what is missing is padded with the row of zeros.
#pragma once

#include "listing.hpp"

namespace fixdem {

/// Rows of the dense contacts of one kind in a chunk: whole batches, or none where they are sparse.
template <class Case, class Batches>
int rows_of(const Batches& batches, int chunk) {
  return batches.sparse[chunk] ? 0 : Capacity<Case>::batch * batches_for<Case>(batches.count[chunk]);
}
/// Calls f(walls, first row) for each kind of wall; their rows lie behind those of the pairs of the chunk. Returns the
/// row behind the last.
template <class Case, class C, class F>
int for_each_wall_row(C& contacts, int chunk, F&& f) {
  int row = contacts.first_row(chunk) + rows_of<Case>(contacts.pairs, chunk);
  for_each_wall(contacts, [&](auto& walls) {
    f(walls, row);
    row += rows_of<Case>(walls, chunk);
  });
  return row;
}

/// Slot lists of one chunk. A fault names a particle with too many near neighbours.
template <class Case>
Status list_slots(Contacts<Case>& contacts, NearList<Case>& near, const Particles<Case>& p,
                  ListingScratch<Case>& scratch, int chunk) {
  using Cap = Capacity<Case>;
  using R = Rows<Case>;
  constexpr int kinds = Contacts<Case>::max_slots + 1;
  const int base = chunk * Cap::chunk_size, particles = particles_in(p, chunk);
  auto &own = scratch.own, &incoming = scratch.incoming, &neighbours = scratch.neighbours;
  for (int i = 0; i < particles; ++i) own[i] = incoming[i] = neighbours[i] = 0;
  int crowded = -1;
  const auto count = [&](int i) {
    if (neighbours[i] == Cap::neighbours) {
      crowded = i;
      return false;
    }
    ++neighbours[i];
    return true;
  };
  bool has_rows = false, has_sums = false;
  const auto is_dense = [&](const auto& batches, int range) {
    (batches.sparse[range] ? has_sums : has_rows) |= batches.count[range] > 0;
    return !batches.sparse[range];
  };
  // Pairs of one range, as far as they concern this chunk; sparse ones have no rows, but count as neighbours.
  const auto book_range = [&](int range, int owner_base, int partner_base, int first_row) {
    const bool dense = is_dense(contacts.pairs, range);
    const int first = PairBatches<Case>::first(range);
    for (int k = 0; k < contacts.pairs.count[range]; ++k) {
      const int batch = first + k / Capacity<Case>::batch, lane = k % Capacity<Case>::batch;
      const int i = owner_base + R::number(contacts.pairs.owner[batch][lane]) - base;
      const int j = partner_base + R::number(contacts.pairs.partner[batch][lane]) - base;
      if (i >= 0 && i < particles && count(i) && dense) scratch.own_row[i][own[i]++] = R::slot_offset(first_row + k);
      if (j >= 0 && j < particles && count(j) && dense)
        scratch.incoming_row[j][incoming[j]++] = R::slot_offset(first_row + k);
    }
  };
  for (int c = chunk > contacts.span ? chunk - contacts.span : 0; c <= chunk; ++c)
    book_range(c, c * Cap::chunk_size, c * Cap::chunk_size, contacts.first_row(c));
  for_each_wall_row<Case>(contacts, chunk, [&](const auto& walls, int first_row) {
    if (!is_dense(walls, chunk)) return;
    for (int k = 0; k < walls.count[chunk]; ++k) {
      const int i = R::number(walls.owner[walls.first(chunk) + k / Capacity<Case>::batch][k % Capacity<Case>::batch]);
      scratch.own_row[i][own[i]++] = R::slot_offset(first_row + k);
    }
  });
  if constexpr (Derived<Case>::is_periodic)
    if (near.outer.concerns_ends(chunk)) book_range(Cap::chunks, 0, R::wrap_base, R::wrap_first);
  contacts.has_rows[chunk] = has_rows, contacts.has_sums[chunk] = has_sums;
  contacts.slots_are_stale[chunk] = false;
  if (crowded >= 0) contacts.has_rows[chunk] = false;  // the last step goes without: its lists are not made
  if (crowded >= 0) return {Fault::neighbour_capacity, p.id[base + crowded], 0, Cap::neighbours + 1, Cap::neighbours};
  for (int i = 0; i < particles; ++i)
    near.most_neighbours = neighbours[i] > near.most_neighbours ? neighbours[i] : near.most_neighbours;
  if (!has_rows) return {};

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
    *slot++ = R::slot_offset(i);
    for (int s = 0; s < k; ++s) *slot++ = s < own[i] ? scratch.own_row[i][s] : R::slot_offset(R::zero);
    for (int s = 0; s < k; ++s) *slot++ = s < incoming[i] ? scratch.incoming_row[i][s] : R::slot_offset(R::zero);
  }
  return {};
}

}  // namespace fixdem
