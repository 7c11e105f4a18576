// Contact histories by particle number, while contacts are renumbered.
//
// Sorting moves contacts to other batches and can exchange owner and partner. Before, every history that is not zero is
// put here under the input number of its owner; after, each new pair asks for its own. Seen from the
// other side the tangential displacement changes sign: slip and normal both do. Capacity is that of the batches
// themselves.
#pragma once

#include "contacts.hpp"

namespace fixdem {

template <class Case, bool present = keeps_history<Case>>
class KeptHistory {
 public:
  static constexpr int size = ContactLaw<Case, false>::history_size;

  void clear() {
    entries_ = 0;
    for (int i = 0; i < Case::particle_count; ++i) {
      newest_[i] = -1;
      for (int c = 0; c < size; ++c) pipe[i][c] = ends[i][c] = 0;
    }
  }

  void keep(int owner, int partner, const Real<Case> (*value)[Capacity<Case>::batch], int lane) {
    bool is_zero = true;
    for (int c = 0; c < size; ++c) is_zero = is_zero && value[c][lane] == 0;
    if (is_zero) return;
    Entry& e = entry_[entries_];
    e.partner = partner;
    e.older = newest_[owner];
    for (int c = 0; c < size; ++c) e.value[c] = value[c][lane];
    newest_[owner] = entries_++;
  }

  /// Writes the history of the pair into a lane; zero when it has none.
  void restore(int owner, int partner, Real<Case> (*value)[Capacity<Case>::batch], int lane) const {
    if (copy(owner, partner, 1, value, lane) || copy(partner, owner, -1, value, lane)) return;
    for (int c = 0; c < size; ++c) value[c][lane] = 0;
  }

  const Real<Case>* of_pipe(int id) const { return pipe[id]; }
  const Real<Case>* of_end(int id) const { return ends[id]; }

  Real<Case> pipe[Case::particle_count][size];  ///< of the pipe wall, by input number
  Real<Case> ends[Case::particle_count][size];  ///< of an end wall

 private:
  static constexpr int vectors = 3 * ContactLaw<Case, false>::history_vectors;  ///< numbers that change sign

  bool copy(int owner, int partner, Real<Case> sign, Real<Case> (*value)[Capacity<Case>::batch], int lane) const {
    for (int k = newest_[owner]; k >= 0; k = entry_[k].older) {
      if (entry_[k].partner != partner) continue;
      for (int c = 0; c < size; ++c) value[c][lane] = (c < vectors ? sign : Real<Case>{1}) * entry_[k].value[c];
      return true;
    }
    return false;
  }

  struct Entry {
    int partner, older;
    Real<Case> value[size];
  };
  Entry entry_[PairBatches<Case>::batches * Capacity<Case>::batch];
  int newest_[Case::particle_count];
  int entries_;
};

/// Without history there is nothing to keep.
template <class Case>
class KeptHistory<Case, false> {
 public:
  const Real<Case>* of_pipe(int) const { return nullptr; }
  const Real<Case>* of_end(int) const { return nullptr; }
};

/// Visits every real lane of one range of the pair batches: f(batch, lane, owner row, partner row).
template <class Case, class F>
void for_each_near_pair_in(const Contacts<Case>& contacts, int range, F&& f) {
  const bool wraps = range == Capacity<Case>::chunks;
  const int owner_base = wraps ? 0 : range * Capacity<Case>::chunk_size;
  const int partner_base = wraps ? Rows<Case>::wrap_base : owner_base;
  for (int k = 0; k < contacts.pairs.count[range]; ++k) {
    const int batch = PairBatches<Case>::first(range) + k / Capacity<Case>::batch, lane = k % Capacity<Case>::batch;
    f(batch, lane, owner_base + Rows<Case>::number(contacts.pairs.owner[batch][lane]),
      partner_base + Rows<Case>::number(contacts.pairs.partner[batch][lane]));
  }
}

template <class Case, class F>
void for_each_near_pair(const Contacts<Case>& contacts, F&& f) {
  for (int range = 0; range < PairBatches<Case>::ranges; ++range) for_each_near_pair_in(contacts, range, f);
}

/// Visits every real lane of the batches of one kind of wall in one chunk: f(batch, lane, owner row).
template <class Case, class Walls, class F>
void for_each_near_wall_in(const Walls& walls, int chunk, F&& f) {
  for (int k = 0; k < walls.count[chunk]; ++k) {
    const int batch = Walls::first(chunk) + k / Capacity<Case>::batch, lane = k % Capacity<Case>::batch;
    f(batch, lane, chunk * Capacity<Case>::chunk_size + Rows<Case>::number(walls.owner[batch][lane]));
  }
}

template <class Case, class Walls, class F>
void for_each_near_wall(const Walls& walls, F&& f) {
  for (int chunk = 0; chunk < Capacity<Case>::chunks; ++chunk) for_each_near_wall_in<Case>(walls, chunk, f);
}

}  // namespace fixdem
