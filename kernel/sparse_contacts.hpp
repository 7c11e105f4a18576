// The contacts of sparse ranges, in which most listed contacts do not touch.
//
// In a scene in motion a near list holds several times as many pairs as touch, and yet most batches hold one that does.
// So the separations of all are looked at first, and the numbers of those that touch are packed without a branch: each
// mask of 8 lanes has its set bits listed in a table, eight numbers are written always, and the count grows by as many
// as are set. The law then takes full batches of packed contacts; each lane computes what it would in place
// (contact_loop.hpp). Their histories are rows, one for each contact.
//
// There are no force rows in a ring and no slot lists here: the row of a contact is added to the sum of its owner and
// subtracted from that of its partner at once, in the order of the list. That takes 17 cycles for a contact that
// touches and nothing for one that does not; a row written for all and summed by slot lists takes 9 for each that is
// near, which suits a dense range. A bit for each lane remembers who touched in the last step, so that a contact that
// opens forgets.
#pragma once

#include "contact_loop.hpp"

namespace fixdem {

/// Chunks whose sparse contacts are computed together. A chunk alone fills few batches: million particle-steps/s of the
/// plug with AVX-512 103 with 1, 110 with 2, 112 with 4, 111 with 8.
inline constexpr int chunks_together = 4;

namespace detail {

/// For each mask of 8 bits, 8 times the numbers of those that are set.
struct SetBits {
  alignas(32) std::uint32_t offset[256][8];
};
constexpr SetBits set_bits() {
  SetBits table{};
  for (unsigned mask = 0; mask < 256; ++mask)
    for (unsigned bit = 0, k = 0; bit < 8; ++bit)
      if (mask >> bit & 1) table.offset[mask][k++] = 8 * bit;
  return table;
}
inline constexpr SetBits set_bits_of = set_bits();

/// Contacts that touch, by 8 times their numbers among all contacts of their kind and 8 times those of their particles.
template <class Case>
struct TouchingContacts {
  static constexpr int enough = 96;  ///< for the law to take them
  static constexpr int room = enough + Capacity<Case>::batch + 8;
  alignas(64) std::uint32_t number[room], owner[room], partner[room];
  int count = 0;

  /// Adds those of 8 contacts from `first` on whose bits are set; writes 8 numbers always.
  FIXDEM_INLINE void pack(unsigned mask, int first) {
    typedef std::uint32_t Numbers __attribute__((vector_size(32)));
    Numbers numbers;
    __builtin_memcpy(&numbers, set_bits_of.offset[mask], sizeof numbers);
    numbers += static_cast<std::uint32_t>(8 * first);
    __builtin_memcpy(number + count, &numbers, sizeof numbers);
    count += __builtin_popcount(mask);
  }
  void repeat_last(int k) { number[k] = number[k - 1], owner[k] = owner[k - 1], partner[k] = partner[k - 1]; }
};

/// History, force rows and ledger of W packed contacts, of which the first is the k-th.
template <class Case, int W, int RowWidth, class Entries>
struct Packed {
  Real<Case>* history;
  const std::uint32_t* number;
  Real<Case>*row, *partner_torque;
  Entries* entries;
  int k;
  template <class V>
  FIXDEM_INLINE void book(const ContactForce<V>& f) const {
    entries->put(k, f);
  }
  template <class V, int Count>
  FIXDEM_INLINE KeptNumbers<V, Count> loaded_numbers() const {
    KeptNumbers<V, Count> numbers{};
    for (int c = 0; c < Count; c += 4) {
      const Vec4<V> four = load_columns<W, RowWidth>(history + c, number);
      numbers.value[c] = four.x;
      if (c + 1 < Count) numbers.value[c + 1] = four.y;
      if (c + 2 < Count) numbers.value[c + 2] = four.z;
      if (c + 3 < Count) numbers.value[c + 3] = four.w;
    }
    return numbers;
  }
  template <class V, int Count>
  FIXDEM_INLINE void store_numbers(const KeptNumbers<V, Count>& numbers) const {
    const auto value = [&](int c) FIXDEM_INLINE_LAMBDA { return c < Count ? numbers.value[c] : V{}; };
    for (int c = 0; c < Count; c += 4)
      store_columns<W, RowWidth>(history + c, number, Vec4<V>{value(c), value(c + 1), value(c + 2), value(c + 3)});
  }
};

/// Adds a row to the sum of its owner, or of its partner.
template <int Width, int W, class T>
FIXDEM_INLINE void add_row(T* sum, const T* row) {
  constexpr int step = W < Width ? W : Width;
  using V = Lanes<step, T>;
  for (int p = 0; p < Width; p += step) store(sum + p, load<V>(sum + p) + load<V>(row + p));
}
template <class Case, int W, class T>
FIXDEM_INLINE void add_incoming_row(T* sum, const T* row, const T* torque) {
  constexpr int width = Particles<Case>::motion_width, step = W < width ? W : width;
  using V = Lanes<step, T>;
  for (int p = 0; p < width; p += step)
    store(sum + p, fused(load<V>(incoming_sign<T> + p), incoming_part<Case, V>(row, torque, p), load<V>(sum + p)));
}

}  // namespace detail

/// The sparse contacts of one kind, range after range: looked at, packed, computed and added to the sums of particles.
/// `Side` counts from the first particle. `later`: where rows go instead if it is not null.
template <class Case, int W, class Side, class Batches>
class SparseContacts {
  static constexpr int width = Particles<Case>::motion_width, lanes = Capacity<Case>::batch;
  static constexpr int size = Side::Law::history_size;
  static constexpr bool has_partners = requires(Batches & b) { b.partner; };
  using Touching = detail::TouchingContacts<Case>;

 public:
  /// `monitor`: of each range.
  SparseContacts(const Side& side, Batches& batches, Real<Case>* sum, StepMonitor<Case>* monitor,
                 const RowsForLater<Case>* later)
      : side_(side), batches_(batches), sum_(sum), monitors_(monitor), later_(later) {}

  /// Packs what touches in one range, whose particles count from those bases; so does `side`.
  void look_at(const Side& side, int range, int owner_base, int partner_base) {
    int known = list_.count;
    found_ = 0;
    for (int b = Batches::first(range), left = batches_.count[range]; left > 0; ++b, left -= lanes) {
      const auto *owner = batches_.owner[b], *partner = detail::partners_of(batches_, b);
      unsigned touching = 0;
      for (int lane = 0; lane < lanes; lane += W)
        touching |= side.touching(side.template separation<W>(owner + lane, partner + lane)) << lane;
      const unsigned within = left < lanes ? (1u << left) - 1 : Capacity<Case>::all_lanes;
      touching &= within;
      const unsigned before = batches_.touching[b] & within;
      batches_.touching[b] = static_cast<std::uint16_t>(touching);
      if constexpr (looks_back<Case>)
        touching |= before;  // one that has opened is looked at once more, and forgets by itself
      else
        forget(b, before & ~touching);
      for (int lane = 0; lane < lanes; lane += 8) list_.pack(touching >> lane & 255, b * lanes + lane);
      if (list_.count >= Touching::enough) {
        name_particles(known, range, owner_base, partner_base);
        compute();
        known = 0;
      }
    }
    name_particles(known, range, owner_base, partner_base);
  }

  /// The law for what has been packed.
  void compute() {
    if (list_.count == 0) {
      parts_ = 0;
      return;
    }
    for (int k = list_.count; k % W != 0; ++k) list_.repeat_last(k);  // written twice, the same
    Partials<W, lanes, Real<Case>> overlap(monitors_[part_[0].range].overlap);
    alignas(64) Real<Case> rows[Touching::room][width];
    alignas(64) Real<Case> torques[Side::has_partner_torques ? Touching::room : 1][4];
    EnergyEntries<Case, Touching::room> entries;
    Real<Case>* history = nullptr;
    if constexpr (size > 0) history = batches_.history.value;
    detail::all_contacts<Case, W, SlidingLanes::computed>(
        side_, list_.owner, list_.partner, list_.count,
        [&](int k) FIXDEM_INLINE_LAMBDA {
          return detail::Packed<Case, W, (size + 3) / 4 * 4, decltype(entries)>{
              history, list_.number + k, rows[k], torques[Side::has_partner_torques ? k : 0], &entries, k};
        },
        overlap);
    overlap.put_back(monitors_[part_[0].range].overlap);
    for (int p = 0; p < parts_; ++p)
      entries.sum(part_[p].begin, part_[p].end, part_[p].number, monitors_[part_[p].range]);
    for (int k = 0; k < list_.count; ++k) {
      const Real<Case>* torque = Side::has_partner_torques ? torques[k] : nullptr;
      if (later_ != nullptr) {
        later_->put(rows[k], torque, list_.owner[k], has_partners ? list_.partner[k] : RowsForLater<Case>::nobody);
        continue;
      }
      detail::add_row<width, W>(row_at<width>(sum_, list_.owner[k]), rows[k]);
      if constexpr (has_partners)
        detail::add_incoming_row<Case, W>(row_at<width>(sum_, list_.partner[k]), rows[k], torque);
    }
    list_.count = parts_ = 0;
  }

 private:
  /// Particles of the packed contacts from number `from` on.
  void name_particles(int from, int range, int owner_base, int partner_base) {
    part_[parts_++] = {range, from, list_.count, found_};
    found_ += list_.count - from;
    const auto offset = [](const auto& of_batches, std::uint32_t number, int base) {
      const std::uint32_t contact = number / 8;
      return static_cast<std::uint32_t>(8 * base) + of_batches[contact / lanes][contact % lanes];
    };
    for (int k = from; k < list_.count; ++k) {
      list_.owner[k] = offset(batches_.owner, list_.number[k], owner_base);
      if constexpr (has_partners) list_.partner[k] = offset(batches_.partner, list_.number[k], partner_base);
    }
  }

  /// Clears the histories of the lanes that have opened.
  void forget(int b, unsigned opened) {
    if constexpr (size > 0)
      for (; opened != 0; opened &= opened - 1) {
        Real<Case>* row = batches_.history.row(b * lanes + __builtin_ctz(opened));
        for (int c = 0; c < size; ++c) row[c] = 0;
      }
  }

  const Side side_;
  Batches& batches_;
  Real<Case>* sum_;
  StepMonitor<Case>* monitors_;
  const RowsForLater<Case>* later_;
  Touching list_;
  struct Part {
    int range, begin, end, number;  ///< of its first contact in the range
  };
  Part part_[chunks_together];  ///< of the list, by range
  int parts_ = 0, found_ = 0;   ///< contacts of the present range so far
};

/// Adds rows that were kept to the sums of the particles of the chunks from `begin` to `end`. `W`: doubles per
/// register.
template <class Case, int W>
void add_later(const RowsForLater<Case>& later, Real<Case>* sum, int begin, int end) {
  constexpr int width = Particles<Case>::motion_width, lanes = contact_lanes<Case, W>;
  constexpr std::uint32_t of_chunk = 8 * Capacity<Case>::chunk_size;
  const std::uint32_t first = static_cast<std::uint32_t>(begin) * of_chunk;
  const std::uint32_t span = static_cast<std::uint32_t>(end - begin) * of_chunk;
  for (int k = 0; k < *later.count; ++k) {
    const Real<Case>*row = later.last_row - k * width, *torque = nullptr;
    if constexpr (has_partner_torques<Case>) torque = later.last_torque - k * 4;
    const std::uint32_t owner = later.last_owner[-k], partner = later.last_partner[-k];
    if (owner - first < span) detail::add_row<width, lanes>(row_at<width>(sum, owner), row);
    if (partner - first < span) detail::add_incoming_row<Case, lanes>(row_at<width>(sum, partner), row, torque);
  }
}

}  // namespace fixdem
