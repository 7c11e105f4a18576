// Contact histories by particle number, while contacts are listed again.
//
// Listing moves contacts to other lanes, and sorting moves them to other chunks and can exchange owner and partner.
// Before, every history that is not zero is kept here under the input numbers of its contact (walls have negative
// ones); after, each listed contact asks for its own. Seen from the other side the tangential displacement changes
// sign: slip and normal both do.
#pragma once

#include "contacts.hpp"
#include "status.hpp"

namespace fixdem {

template <class Case, bool present = keeps_history<Case>>
class KeptHistory {
 public:
  /// Once, before the first use.
  void clear() {
    entries_ = lost_ = 0;
    for (int& newest : newest_) newest = -1;
  }

  void keep(int owner, int partner, const HistoryNumbers<const Real<Case>>& numbers) {
    bool is_zero = true;
    const int size = size_of(partner);
    for (int c = 0; c < size; ++c) is_zero = is_zero && numbers[c] == 0;
    if (is_zero) return;
    if (entries_ == Capacity<Case>::histories) {
      ++lost_;
      return;
    }
    Entry& e = entry_[entries_];
    e.partner = partner, e.older = newest_[owner] >= 0 ? newest_[owner] : -1 - owner;
    for (int c = 0; c < size; ++c) e.value[c] = numbers[c];
    newest_[owner] = entries_++;
  }

  /// Writes the history of the contact; zero, and false, when it has none.
  bool restore(int owner, int partner, const HistoryNumbers<Real<Case>>& numbers) const {
    if (copy(owner, partner, 1, numbers)) return true;
    if (partner >= 0 && copy(partner, owner, -1, numbers)) return true;
    for (int c = 0; c < size_of(partner); ++c) numbers[c] = 0;
    return false;
  }

  /// Whether there is nothing in it; a state from outside may have any bytes here.
  bool is_empty() const {
    bool is_empty = entries_ == 0 && lost_ == 0;
    for (int newest : newest_) is_empty = is_empty && newest == -1;
    return is_empty;
  }

  int count() const { return entries_; }
  /// Fault once more histories have been kept than there is room for.
  Status status() const {
    constexpr double room = Capacity<Case>::histories;
    return lost_ > 0 ? Status{Fault::history_capacity, -1, 0, room + lost_, room} : Status{};
  }

  void forget() {
    while (entries_ > 0)
      if (const int older = entry_[--entries_].older; older < 0) newest_[-1 - older] = -1;
  }

 private:
  static constexpr int of_pair = ContactLaw<Case, false>::history_size, of_wall = ContactLaw<Case, true>::history_size;
  static constexpr int vectors = 3 * ContactLaw<Case, false>::history_vectors;  ///< numbers that change sign
  static constexpr int size_of(int partner) { return partner >= 0 ? of_pair : of_wall; }

  bool copy(int owner, int partner, Real<Case> sign, const HistoryNumbers<Real<Case>>& numbers) const {
    for (int k = newest_[owner]; k >= 0; k = entry_[k].older) {
      if (entry_[k].partner != partner) continue;
      for (int c = 0; c < size_of(partner); ++c) numbers[c] = (c < vectors ? sign : Real<Case>{1}) * entry_[k].value[c];
      return true;
    }
    return false;
  }

  struct Entry {
    int partner, older;  ///< of the same owner; its oldest entry has -1 - owner there
    Real<Case> value[of_pair > of_wall ? of_pair : of_wall];
  };
  Entry entry_[Capacity<Case>::histories];
  int newest_[Case::particle_count];
  int entries_, lost_;
};

/// Without history there is nothing to keep.
template <class Case>
class KeptHistory<Case, false> {
 public:
  void clear() {}
  void keep(int, int, const HistoryNumbers<const Real<Case>>&) {}
  bool restore(int, int, const HistoryNumbers<Real<Case>>&) const { return false; }
  bool is_empty() const { return true; }
  int count() const { return 0; }
  Status status() const { return {}; }
  void forget() {}
};

/// Visits every near pair of one range: f(range, number in the range, owner row, partner row).
template <class Case, class F>
void for_each_near_pair_in(const Contacts<Case>& contacts, int range, F&& f) {
  const bool wraps = range == Capacity<Case>::chunks;
  const int owner_base = wraps ? 0 : range * Capacity<Case>::chunk_size;
  const int partner_base = wraps ? Rows<Case>::wrap_base : owner_base;
  for (int k = 0; k < contacts.pairs.count[range]; ++k) {
    const int batch = PairBatches<Case>::first(range) + k / Capacity<Case>::batch, lane = k % Capacity<Case>::batch;
    f(range, k, owner_base + Rows<Case>::number(contacts.pairs.owner[batch][lane]),
      partner_base + Rows<Case>::number(contacts.pairs.partner[batch][lane]));
  }
}

template <class Case, class F>
void for_each_near_pair(const Contacts<Case>& contacts, F&& f) {
  for (int range = 0; range < PairBatches<Case>::ranges; ++range) for_each_near_pair_in(contacts, range, f);
}

/// Visits every near wall of one kind in one chunk: f(chunk, number in the chunk, owner row).
template <class Case, class Walls, class F>
void for_each_near_wall_in(const Walls& walls, int chunk, F&& f) {
  for (int k = 0; k < walls.count[chunk]; ++k) {
    const int batch = Walls::first(chunk) + k / Capacity<Case>::batch, lane = k % Capacity<Case>::batch;
    f(chunk, k, chunk * Capacity<Case>::chunk_size + Rows<Case>::number(walls.owner[batch][lane]));
  }
}

template <class Case, class Walls, class F>
void for_each_near_wall(const Walls& walls, F&& f) {
  for (int chunk = 0; chunk < Capacity<Case>::chunks; ++chunk) for_each_near_wall_in<Case>(walls, chunk, f);
}

/// Keeps the histories of a range of pairs, or of the walls of one kind of a chunk.
template <class Case>
void keep_pair_histories(const Contacts<Case>& contacts, const Particles<Case>& p, KeptHistory<Case>& kept, int range) {
  if constexpr (PairBatches<Case>::history_size > 0)
    for_each_near_pair_in(contacts, range, [&](int, int k, int owner, int partner) {
      kept.keep(p.id[owner], p.id[partner], contacts.pairs.history_of(range, k));
    });
}
template <class Case, class Walls>
void keep_wall_histories(const Walls& walls, const Particles<Case>& p, KeptHistory<Case>& kept, int chunk) {
  if constexpr (Walls::history_size > 0)
    for_each_near_wall_in<Case>(walls, chunk, [&](int, int k, int owner) {
      kept.keep(p.id[owner], Walls::Surface::kept_as, walls.history_of(chunk, k));
    });
}

}  // namespace fixdem
