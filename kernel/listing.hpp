// Listing one range anew: the pairs of a chunk, with its walls, or those across the periodic ends.
//
// Candidates come from the order along the pipe (near_list.hpp): a particle is compared with its followers up to the
// end of its reach, W at a time. Pairs are listed by increasing numbers, so as long as nobody is renumbered old and new
// list are both sorted, and histories are carried over in one pass through both; after a sort they come from
// kept_history.hpp. Nothing but this range is touched. Every capacity is checked before it is used, and the first that
// does not suffice ends the run.
#pragma once

#include "kept_history.hpp"
#include "near_list.hpp"

namespace fixdem {

/// Share of touching pairs below which a range counts as sparse (sparse_contacts.hpp).
inline constexpr double sparse_below = 0.5;

/// Room for what one listing needs for its duration.
template <class Case>
struct ListingScratch {
  using Cap = Capacity<Case>;
  using Offset = typename Rows<Case>::Offset;
  static constexpr int size = ContactLaw<Case, false>::history_size;
  static constexpr int span = 2 * Cap::chunk_size;  ///< particles in which the pairs of a chunk lie
  static constexpr int kept_pairs = size > 0 ? Cap::chunk_pairs : 1;
  static constexpr int kept_numbers = size > 0 ? size : 1;

  alignas(64) double x[span + 8], y[span + 8], z[span + 8];
  int key[kept_pairs];  ///< of the old pairs or walls, increasing
  Real<Case> history[kept_pairs][kept_numbers];
  Offset own_row[Cap::chunk_size][Contacts<Case>::max_slots], incoming_row[Cap::chunk_size][Cap::neighbours];
};

namespace detail {

/// Fills the lanes behind the last contact of a range with copies of the last one, history zero. Nobody sums their
/// rows.
template <class Case, int Size, class Batches>
void fill_last_batch(Batches& batches, int first_batch, int contacts) {
  for (int k = contacts; k % Capacity<Case>::batch != 0; ++k) {
    const int batch = first_batch + k / Capacity<Case>::batch, lane = k % Capacity<Case>::batch;
    batches.owner[batch][lane] = batches.owner[batch][lane - 1];
    if constexpr (requires { batches.partner; }) batches.partner[batch][lane] = batches.partner[batch][lane - 1];
    if constexpr (Size > 0)
      for (int c = 0; c < Size; ++c) batches.history.value[batch][c][lane] = 0;
  }
}

/// Histories of an old list whose particles still have their numbers: asked for by increasing keys.
template <class Case>
class OldHistories {
 public:
  explicit OldHistories(ListingScratch<Case>& scratch) : scratch_(scratch) {}

  template <class Batches>
  void keep(const Batches& batches, int first_batch, int k, int key) {
    scratch_.key[k] = key;
    for (int c = 0; c < size; ++c)
      scratch_.history[k][c] =
          batches.history.value[first_batch + k / Capacity<Case>::batch][c][k % Capacity<Case>::batch];
    kept_ = k + 1;
  }
  void restore(int key, Real<Case> (*value)[Capacity<Case>::batch], int lane) {
    while (next_ < kept_ && scratch_.key[next_] < key) ++next_;
    const bool found = next_ < kept_ && scratch_.key[next_] == key;
    for (int c = 0; c < size; ++c) value[c][lane] = found ? scratch_.history[next_][c] : 0;
  }

 private:
  static constexpr int size = ListingScratch<Case>::size;
  ListingScratch<Case>& scratch_;
  int kept_ = 0, next_ = 0;
};

/// Number of a pair that increases in the order of listing.
template <class Case>
constexpr int pair_key(int range, int owner, int partner) {
  constexpr int span = 4 * Capacity<Case>::chunk_size;
  return range == Capacity<Case>::chunks ? partner * span + owner : owner * span + partner;
}

/// Calls found(j, square of the distance) for the centres `from` to `to` of the scratch within the cut-off of (x, y,
/// z).
template <class Case, int W, class Found>
FIXDEM_INLINE void search(const ListingScratch<Case>& at, double x, double y, double z, int from, int to,
                          double square_cut, Found&& found) {
  using V = Lanes<W>;
  for (int j = from; j < to; j += W) {
    const V dx = load_any<V>(at.x + j) - x, dy = load_any<V>(at.y + j) - y, dz = load_any<V>(at.z + j) - z;
    const V square = fused(dz, dz, fused(dy, dy, dx * dx));
    if (!any(square < square_cut)) continue;
    alignas(64) double squares[W];
    store(squares, square);
    for (int lane = 0; lane < W && j + lane < to; ++lane)
      if (squares[lane] < square_cut) found(j + lane, squares[lane]);
  }
}

/// Centres of `particles` particles from number `first` on, shifted along the pipe, into the scratch.
template <class Case>
void gather_centres(ListingScratch<Case>& scratch, const Particles<Case>& p, int first, int particles, double shift) {
  for (int k = 0; k < particles; ++k) {
    const double* centre = p.position[first + k];
    scratch.x[k] = centre[0], scratch.y[k] = centre[1], scratch.z[k] = centre[2] + shift;
  }
}

/// Lists the walls of one kind of a chunk: those nearer than `margin`, by `is_near(margin, position)`; `restore(number
/// in the chunk, history, lane)` fills histories.
template <class Case, class Walls, class IsNear, class Restore>
void list_walls(Walls& walls, const Particles<Case>& p, int chunk, double margin, IsNear&& is_near, Restore&& restore) {
  constexpr int size = Walls::history_size;
  const int first = Walls::first(chunk);
  int k = 0, touching = 0;
  for (int i = 0; i < particles_in<Case>(chunk); ++i) {
    const double* position = p.position[chunk * Capacity<Case>::chunk_size + i];
    if (!is_near(margin, position)) continue;
    touching += is_near(0, position);
    const int batch = first + k / Capacity<Case>::batch, lane = k % Capacity<Case>::batch;
    walls.owner[batch][lane] = Rows<Case>::offset(i);
    if constexpr (size > 0) restore(i, walls.history.value[batch], lane);
    ++k;
  }
  walls.count[chunk] = k;
  walls.sparse[chunk] = touching < sparse_below * k;
  for (int b = 0; b < batches_for<Case>(k); ++b) walls.touching[first + b] = Capacity<Case>::all_lanes;
  fill_last_batch<Case, size>(walls, first, k);
}

}  // namespace detail

/// Lists the pairs of a range. `restore(owner, partner, history, lane)` fills histories, numbers counted from the
/// range's bases. A fault names the particle whose pair is one too many.
template <class Case, int W, class Restore>
Status list_pairs(Contacts<Case>& contacts, NearList<Case>& near, const Particles<Case>& p,
                  ListingScratch<Case>& scratch, int range, Restore&& restore) {
  using Cap = Capacity<Case>;
  constexpr int count = Case::particle_count;
  PairBatches<Case>& pairs = contacts.pairs;
  const bool wraps = range == Cap::chunks;
  const int first = PairBatches<Case>::first(range);
  const double cut_off = Case::diameter + near.promise[range].margin, square_cut = cut_off * cut_off;
  int k = 0, touching = 0;
  bool is_full = false;
  const auto add = [&](int owner, int partner, double square) {
    if (k == Cap::chunk_pairs) is_full = true;
    if (is_full) return;
    const int batch = first + k / Capacity<Case>::batch, lane = k % Capacity<Case>::batch;
    pairs.owner[batch][lane] = Rows<Case>::offset(owner);
    pairs.partner[batch][lane] = Rows<Case>::offset(partner);
    if constexpr (PairBatches<Case>::history_size > 0) restore(owner, partner, pairs.history.value[batch], lane);
    touching += square < Case::diameter * Case::diameter;
    ++k;
  };
  int i = wraps ? Rows<Case>::wrap_base : range * Cap::chunk_size;
  if (wraps) {
    detail::gather_centres(scratch, p, 0, NearList<Case>::copies, Case::pipe_length);
    for (; i < count && !is_full; ++i) {
      const double* x = p.position[i];
      detail::search<Case, W>(scratch, x[0], x[1], x[2], 0, near.end_of_reach[i] - count, square_cut,
                              [&](int j, double square) { add(j, i - Rows<Case>::wrap_base, square); });
    }
  } else {
    const int base = i, end = base + particles_in<Case>(range);
    const int seen = base + ListingScratch<Case>::span < count ? ListingScratch<Case>::span : count - base;
    detail::gather_centres(scratch, p, base, seen, 0);
    for (; i < end && !is_full; ++i) {
      const int own = i - base, to = (near.end_of_reach[i] < count ? near.end_of_reach[i] : count) - base;
      detail::search<Case, W>(scratch, scratch.x[own], scratch.y[own], scratch.z[own], own + 1, to, square_cut,
                              [&](int j, double square) { add(own, j, square); });
    }
  }
  if (is_full) return {Fault::pair_capacity, p.id[i - 1], 0, Cap::chunk_pairs + 1, Cap::chunk_pairs};
  pairs.count[range] = k;
  pairs.sparse[range] = touching < sparse_below * k;
  for (int b = 0; b < batches_for<Case>(k); ++b) pairs.touching[first + b] = Cap::all_lanes;  // as far as is known
  detail::fill_last_batch<Case, PairBatches<Case>::history_size>(pairs, first, k);
  int& most = wraps ? near.most_wrap_pairs : near.most_chunk_pairs;
  if (k > most) most = k;
  return {};
}

/// Whether a place is nearer to the pipe's wall than a sphere that touches it plus the margin.
template <class Case>
bool is_near_pipe(double margin, const double* x) {
  const double q = Derived<Case>::pipe_radius - Derived<Case>::radius - margin;
  return x[0] * x[0] + x[1] * x[1] > (q > 0 ? q * q : -1);
}
/// The same of an end.
template <class Case>
bool is_near_end(double margin, const double* x) {
  const double reach = Derived<Case>::radius + margin;
  return x[2] < reach || x[2] > Case::pipe_length - reach;
}

/// Lists a range anew from the present places; particles have kept their numbers since it was listed last.
template <class Case, int W>
Status list_again(Contacts<Case>& contacts, NearList<Case>& near, const Particles<Case>& p,
                  ListingScratch<Case>& scratch, int range) {
  using Cap = Capacity<Case>;
  near.promise_anew(range);
  ++near.listings;
  contacts.slots_are_stale[range == Cap::chunks ? 0 : range] = true;
  if (range == Cap::chunks) {
    contacts.slots_are_stale[Cap::chunks - 1] = true;
    if constexpr (Cap::chunks > 1) contacts.slots_are_stale[Cap::chunks - 2] = true;
  } else if (range + 1 < Cap::chunks) {
    contacts.slots_are_stale[range + 1] = true;
  }

  constexpr bool has_history = PairBatches<Case>::history_size > 0;
  detail::OldHistories<Case> old(scratch);
  if constexpr (has_history) {
    const int first = PairBatches<Case>::first(range);
    for (int k = 0; k < contacts.pairs.count[range]; ++k)
      old.keep(
          contacts.pairs, first, k,
          detail::pair_key<Case>(
              range,
              Rows<Case>::number(contacts.pairs.owner[first + k / Capacity<Case>::batch][k % Capacity<Case>::batch]),
              Rows<Case>::number(
                  contacts.pairs.partner[first + k / Capacity<Case>::batch][k % Capacity<Case>::batch])));
  }
  const Status status =
      list_pairs<Case, W>(contacts, near, p, scratch, range,
                          [&](int owner, int partner, Real<Case>(*value)[Capacity<Case>::batch], int lane) {
                            old.restore(detail::pair_key<Case>(range, owner, partner), value, lane);
                          });
  if (!status.ok() || range == Cap::chunks) return status;

  const auto walls = [&](auto& kind, auto is_near) {
    detail::OldHistories<Case> old_walls(scratch);
    if constexpr (has_history)
      for (int k = 0; k < kind.count[range]; ++k)
        old_walls.keep(
            kind, kind.first(range), k,
            Rows<Case>::number(kind.owner[kind.first(range) + k / Capacity<Case>::batch][k % Capacity<Case>::batch]));
    detail::list_walls(
        kind, p, range, near.promise[range].margin, is_near,
        [&](int i, Real<Case>(*value)[Capacity<Case>::batch], int lane) { old_walls.restore(i, value, lane); });
  };
  if constexpr (Case::has_wall) walls(contacts.pipe, is_near_pipe<Case>);
  if constexpr (Derived<Case>::has_ends) walls(contacts.ends, is_near_end<Case>);
  return status;
}

}  // namespace fixdem
