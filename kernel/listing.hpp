// Listing of one range of pairs, or of the walls of one chunk, while everything else stays.
//
// Pairs are chosen out of the outer list, W at a time; walls are looked for among all particles of the chunk. Histories
// are carried over by kept_history.hpp. Every capacity is checked before it is used, and the first that does not
// suffice ends the run.
#pragma once

#include "kept_history.hpp"
#include "near_list.hpp"

namespace fixdem {

/// Share of touching pairs below which a range counts as sparse (sparse_contacts.hpp).
inline constexpr double sparse_below = 0.7;

/// Room for what listing slots (slots.hpp) needs for its duration.
template <class Case>
struct ListingScratch {
  using Cap = Capacity<Case>;
  using Offset = typename Rows<Case>::SlotOffset;
  unsigned char own[Cap::chunk_size], incoming[Cap::chunk_size], neighbours[Cap::chunk_size];
  Offset own_row[Cap::chunk_size][Contacts<Case>::max_slots], incoming_row[Cap::chunk_size][Cap::neighbours];
};

namespace detail {

/// Histories of the contacts of a range just listed, `owner(k)` and `partner(k)` being their input numbers; the lanes
/// behind the last one repeat it, without history, and nobody sums their rows. Lanes with a history are noted: in a
/// sparse range they lose it if they do not touch.
template <class Case, class Batches, class Owner, class Partner>
void restore_histories(Batches& batches, const KeptHistory<Case>& kept, int range, Owner&& owner, Partner&& partner) {
  constexpr int lanes = Capacity<Case>::batch;
  const int first = Batches::first(range), count = batches.count[range];
  for (int b = 0; b < batches_for<Case>(count); ++b) batches.touching[first + b] = 0;
  for (int k = 0; k < count; ++k)
    if (kept.restore(owner(k), partner(k), batches.history_of(range, k))) batches.note_history(range, k);
  for (int k = count; k % lanes != 0; ++k) {
    const int b = first + k / lanes, lane = k % lanes;
    batches.owner[b][lane] = batches.owner[b][lane - 1];
    if constexpr (requires { batches.partner; }) batches.partner[b][lane] = batches.partner[b][lane - 1];
    for (int c = 0; c < Batches::history_size; ++c) batches.history_of(range, k)[c] = 0;
  }
}

}  // namespace detail

/// Lists the walls of one kind of a chunk: those nearer than the margin. As far as the nearest of those that are not
/// listed lies farther away, the list holds for longer.
template <class Case, class Walls>
void list_walls(Walls& walls, const NearList<Case>& near, const Particles<Case>& p, const KeptHistory<Case>& kept,
                int chunk, bool pairs_are_sparse) {
  const int base = chunk * Capacity<Case>::chunk_size, first = Walls::first(chunk);
  Validity& validity = walls.validity[chunk];
  validity.renew(walls.surface.speed(near.velocities[chunk]) * Case::time_step, maximum_wall_margin,
                 smallest_diameter<Case>);
  double nearest_unlisted = 1e300;
  int k = 0, touching = 0;
  for (int i = 0; i < particles_in(p, chunk); ++i) {
    const double gap = walls.surface.gap(p.position[base + i]);
    if (!(gap < validity.margin)) {
      nearest_unlisted = min(gap, nearest_unlisted);
      continue;
    }
    touching += gap < 0;
    const int batch = first + k / Capacity<Case>::batch, lane = k % Capacity<Case>::batch;
    walls.owner[batch][lane] = Rows<Case>::offset(i);
    ++k;
  }
  validity.margin = nearest_unlisted;
  walls.count[chunk] = k;
  walls.sparse[chunk] = pairs_are_sparse || touching <= sparse_below * k;
  const auto owner = [&](int j) {
    return p.id[base + Rows<Case>::number(walls.owner[first + j / Capacity<Case>::batch][j % Capacity<Case>::batch])];
  };
  detail::restore_histories<Case>(walls, kept, chunk, owner, [](int) { return Walls::Surface::kept_as; });
}

/// Lists the pairs of a range. A fault names the particle whose pair is one too many.
template <class Case, int W>
Status list_pairs(Contacts<Case>& contacts, NearList<Case>& near, const Particles<Case>& p,
                  const KeptHistory<Case>& kept, int range) {
  using Cap = Capacity<Case>;
  using V = Lanes<W>;
  PairBatches<Case>& pairs = contacts.pairs;
  const OuterList<Case>& outer = near.outer;
  const PairRange<Case> at(range);
  const int first = PairBatches<Case>::first(range), candidates = outer.pairs[range];
  const auto *owners = outer.owner + outer.first(range), *partners = outer.partner + outer.first(range);
  pairs.validity[range].renew(near.velocities_of(range).spread() * Case::time_step, maximum_margin,
                              smallest_diameter<Case>);
  const double margin = pairs.validity[range].margin;
  int k = 0, touching = 0;
  for (int c = 0; c < candidates; c += W) {
    const Separation<V> s = separation_of_pairs<Case, W>(p.position[at.partner_base], partners + c,
                                                         p.position[at.owner_base], owners + c, at.shift);
    const V touch = reach_of<Case>(s, largest_diameter<Case>), cut_off = touch + margin;
    const unsigned valid = candidates - c < W ? (1u << (candidates - c)) - 1 : ~0u;
    unsigned hits = bits_below(s.gap_square, cut_off * cut_off) & valid;
    touching += __builtin_popcount(bits_below(s.gap_square, touch * touch) & hits);
    for (; hits != 0; hits &= hits - 1) {
      const int from = c + __builtin_ctz(hits), batch = first + k / Cap::batch, lane = k % Cap::batch;
      const int owner = at.owner_base + Rows<Case>::number(owners[from]);
      if (k++ == pairs.capacity(range)) return {Fault::pair_capacity, p.id[owner], 0, 1.0 * k, k - 1.0};
      pairs.owner[batch][lane] = owners[from];
      pairs.partner[batch][lane] = partners[from];
    }
  }
  pairs.count[range] = k;
  pairs.sparse[range] = touching <= sparse_below * k;
  const auto id_of = [&](const auto& rows, int base) {
    return [&rows, &p, base, first](int j) {
      return p.id[base + Rows<Case>::number(rows[first + j / Cap::batch][j % Cap::batch])];
    };
  };
  detail::restore_histories<Case>(pairs, kept, range, id_of(pairs.owner, at.owner_base),
                                  id_of(pairs.partner, at.partner_base));
  int& most = range == Cap::chunks ? near.most_wrap_pairs : near.most_chunk_pairs;
  if (k > most) most = k;
  return {};
}

/// Before a step of a range, in which its particles have come `travel` at most relative to each other: lists again what
/// no longer holds. Particles have kept their numbers since the last time.
template <class Case, int W>
Status keep_listed(Contacts<Case>& contacts, NearList<Case>& near, const Particles<Case>& p, KeptHistory<Case>& kept,
                   int range, double travel) {
  using Cap = Capacity<Case>;
  Status status;
  if (!contacts.pairs.validity[range].still_holds(travel)) {
    ++near.listings;
    keep_pair_histories(contacts, p, kept, range);
    status = list_pairs<Case, W>(contacts, near, p, kept, range);
    if (status.ok()) status = kept.status();
    kept.forget();
    if (range == Cap::chunks)
      for (int c = 0; c < Cap::chunks; ++c) contacts.slots_are_stale[c] |= near.outer.concerns_ends(c);
    else
      for (int c = range; c <= range + contacts.span && c < Cap::chunks; ++c) contacts.slots_are_stale[c] = true;
  }
  if (range == Cap::chunks) return status;
  for_each_wall(contacts, [&](auto& walls) {
    if (walls.validity[range].still_holds(walls.surface.speed(near.velocities[range]) * Case::time_step)) return;
    keep_wall_histories(walls, p, kept, range);
    list_walls(walls, near, p, kept, range, contacts.pairs.sparse[range]);
    kept.forget();
    contacts.slots_are_stale[range] = true;
  });
  return status;
}

}  // namespace fixdem
