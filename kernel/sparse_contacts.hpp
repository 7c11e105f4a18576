// The contact loop of sparse ranges, in which most listed contacts do not touch.
//
// In a scene in motion a near list holds several times as many pairs as touch, and yet most batches hold one that does.
// So the separations of all are looked at first, and those that touch are gathered into full batches; each lane then
// computes exactly what it would have in place (contact_loop.hpp), and its row and history go back there. Rows of the
// others are zero. A bit for each lane remembers who touched in the last step, so that a contact that opens forgets.
// (Rows added to sums of owner and partner at once, with no row for who does not touch, were slower: agitated 259
// million particle-steps/s instead of 290, because every particle then adds two sums.)
#pragma once

#include "contact_loop.hpp"

namespace fixdem {

namespace detail {

/// Contacts that touch, gathered from the batches of a sparse range.
template <class Case>
struct Gathered {
  static constexpr int size = Capacity<Case>::chunk_pairs + Capacity<Case>::batch;
  using Offset = typename Rows<Case>::Offset;
  alignas(64) Offset owner[size], partner[size];
  int number[size];  ///< in the range
  int count = 0;
};

/// History and rows of W contacts from all over a range.
template <class Case, int W, int size>
struct Scattered {
  static constexpr int lanes = Capacity<Case>::batch, width = Particles<Case>::motion_width;
  Real<Case> (*history)[lanes];
  Real<Case>*rows, *written;  ///< `written`: room for the rows of W contacts
  const int* number;
  FIXDEM_INLINE Real<Case>& component(int j, int c) const {
    return history[number[j] / lanes * size + c][number[j] % lanes];
  }
  template <class V>
  FIXDEM_INLINE V kept(int c) const {
    alignas(64) Real<Case> value[W];
    for (int j = 0; j < W; ++j) value[j] = component(j, c);
    return load<V>(value);
  }
  template <class V>
  FIXDEM_INLINE void keep_in_mind(int c, V v) const {
    alignas(64) Real<Case> value[W];
    store(value, v);
    for (int j = 0; j < W; ++j) component(j, c) = value[j];
  }
  FIXDEM_INLINE Real<Case>* first_row() const { return written; }
  FIXDEM_INLINE void rows_are_written() const {
    for (int j = 0; j < W; ++j)
      __builtin_memcpy(rows + number[j] * width, written + j * width, width * sizeof(Real<Case>));
  }
};

}  // namespace detail

/// The same rows as dense_contacts; only the contacts that touch are computed.
template <class Case, int W, class Side, class Batches>
void sparse_contacts(const Side side, Batches& batches, int first, int count, Real<Case>* rows, Watch<Case>& watch) {
  using V = Lanes<W, Real<Case>>;
  constexpr int width = Particles<Case>::motion_width, lanes = Capacity<Case>::batch;
  constexpr int size = Side::Law::history_size;
  const int last = first + batches_for<Case>(count);
  detail::Gathered<Case> list;
  for (int b = first; b < last; ++b) {
    const auto *owner = batches.owner[b], *partner = detail::partners_of(batches, b);
    unsigned touching = 0;
    for (int lane = 0; lane < lanes; lane += W)
      touching |= bits(side.touches(side.template separation<W>(owner + lane, partner + lane))) << lane;
    const int valid = count - lanes * (b - first);
    const unsigned within = valid < lanes ? (1u << valid) - 1 : Capacity<Case>::all_lanes;
    touching &= within;
    Real<Case>* row = rows + (b - first) * lanes * width;
    for (int k = 0; k < lanes * width; k += W) store(row + k, V{});
    const unsigned now_touching = touching;
    if constexpr (looks_back<Case>)  // and it forgets by itself
      touching |= batches.touching[b] & within;
    else if constexpr (size > 0)  // a contact that has opened forgets
      for (unsigned opened = batches.touching[b] & ~touching; opened != 0; opened &= opened - 1)
        for (auto& component : batches.history.value[b]) component[__builtin_ctz(opened)] = 0;
    batches.touching[b] = static_cast<std::uint16_t>(now_touching);
    for (; touching != 0; touching &= touching - 1) {
      const int lane = __builtin_ctz(touching);
      list.owner[list.count] = owner[lane];
      list.partner[list.count] = partner[lane];
      list.number[list.count++] = lanes * (b - first) + lane;
    }
  }
  if (list.count == 0) return;
  for (int k = list.count; k % W != 0; ++k)  // the last one again: written twice, the same
    list.owner[k] = list.owner[k - 1], list.partner[k] = list.partner[k - 1], list.number[k] = list.number[k - 1];
  Partials<W, lanes, Real<Case>> overlap(watch.overlap);
  BookedEnergy<Case, W> energy(watch);
  alignas(64) Real<Case> written[W * width];
  auto* history = detail::history_of<Case, size>(batches, first);
  detail::all_contacts<Case, W, SlidingLanes::computed>(
      side, list.owner, list.partner, list.count,
      [&](int k) FIXDEM_INLINE_LAMBDA {
        return detail::Scattered<Case, W, size>{history, rows, written, list.number + k};
      },
      overlap, energy);
  overlap.put_back(watch.overlap);
  energy.put_back(watch);
}

}  // namespace fixdem
