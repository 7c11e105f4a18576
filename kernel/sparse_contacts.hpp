// The contact loop of sparse ranges, in which most listed contacts do not touch.
//
// In a scene in motion a near list holds several times as many pairs as touch, and yet most batches hold one that does.
// So the separations of all are looked at first, and those that touch are gathered into full batches; each lane then
// computes exactly what it would have in place (contact_loop.hpp), and its row and history go back there. Rows of the
// others are zero. A bit for each lane remembers who touched in the last step, so that a contact that opens forgets.
#pragma once

#include "contact_loop.hpp"

namespace fixdem {

/// Contacts that touch, gathered from the batches of a sparse range.
template <class Case>
struct Gathered {
  static constexpr int size = (batches_per_group + 1) * Capacity<Case>::batch;
  using Offset = typename Rows<Case>::Offset;
  alignas(64) Offset owner[size], partner[size];
  int number[size];  ///< in the range
  int count = 0;
};

/// Second half of sparse_contacts: law and rows of the gathered contacts, histories taken from and put back to their
/// places.
template <class Case, int W, class Side, class Batches>
void gathered_contacts(const Side& side, Batches& batches, int first, Gathered<Case>& list, int count, Real<Case>* rows,
                       Partials<W, Capacity<Case>::batch, Real<Case>>& overlap, BookedEnergy<Case, W>& energy) {
  constexpr int width = Particles<Case>::motion_width, lanes = Capacity<Case>::batch;
  constexpr int size = Side::Law::history_size;
  for (int k = count; k % W != 0; ++k) list.owner[k] = list.owner[k - 1], list.partner[k] = list.partner[k - 1];
  ContactGeometry<Case> geometry[batches_per_group];
  for (int k = 0; k < count; k += W) {
    const Real<Case>* limit = Side::limits.of(count - k / lanes * lanes);
    detail::store_geometry<Case, W>(side, side.template separation<W>(list.owner + k, list.partner + k), limit,
                                    k % lanes, geometry[k / lanes], overlap);
  }
  alignas(64) Real<Case> kept[4][lanes], row[lanes * width];
  for (int k = 0; k < count; k += W) {
    const int lane = k % lanes, end = count - k < W ? count - k : W;
    for (int j = 0; j < W; ++j)
      for (int c = 0; c < size; ++c) {
        const int number = list.number[j < end ? k + j : k];
        kept[c][lane + j] = detail::history_of<Case, size>(batches, first + number / lanes)[c][number % lanes];
      }
    detail::sliding_contact_rows<Case, W>(side, geometry[k / lanes], lane, list.owner + k, list.partner + k, kept, row,
                                          energy);
    for (int j = 0; j < end; ++j) {
      const int number = list.number[k + j];
      for (int c = 0; c < size; ++c)
        detail::history_of<Case, size>(batches, first + number / lanes)[c][number % lanes] = kept[c][lane + j];
      __builtin_memcpy(rows + number * width, row + (lane + j) * width, width * sizeof(Real<Case>));
    }
  }
}

/// The same rows as dense_contacts; only the contacts that touch are computed.
template <class Case, int W, class Side, class Batches>
void sparse_contacts(const Side& side, Batches& batches, int first, int count, Real<Case>* rows, Watch<Case>& watch) {
  using V = Lanes<W, Real<Case>>;
  constexpr int width = Particles<Case>::motion_width, lanes = Capacity<Case>::batch;
  constexpr int group = batches_per_group * lanes;
  const int last = first + batches_for<Case>(count);
  Partials<W, lanes, Real<Case>> overlap(watch.overlap);
  BookedEnergy<Case, W> energy(watch);
  Gathered<Case> list;
  for (int b = first; b < last; ++b) {
    const auto *owner = batches.owner[b], *partner = detail::partners_of(batches, b);
    unsigned touching = 0;
    for (int lane = 0; lane < lanes; lane += W)
      touching |= bits(side.touches(side.template separation<W>(owner + lane, partner + lane))) << lane;
    if (const int valid = count - lanes * (b - first); valid < lanes) touching &= (1u << valid) - 1;
    Real<Case>* row = rows + (b - first) * lanes * width;
    for (int k = 0; k < lanes * width; k += W) store(row + k, V{});
    if constexpr (Side::Law::history_size > 0)  // a contact that has opened forgets
      for (unsigned opened = batches.touching[b] & ~touching; opened != 0; opened &= opened - 1)
        for (auto& component : batches.history.value[b]) component[__builtin_ctz(opened)] = 0;
    batches.touching[b] = static_cast<std::uint16_t>(touching);
    for (; touching != 0; touching &= touching - 1) {
      const int lane = __builtin_ctz(touching);
      list.owner[list.count] = owner[lane];
      list.partner[list.count] = partner[lane];
      list.number[list.count++] = lanes * (b - first) + lane;
    }
    if (list.count < group) continue;
    gathered_contacts<Case, W>(side, batches, first, list, group, rows, overlap, energy);
    list.count -= group;
    for (int k = 0; k < list.count; ++k)
      list.owner[k] = list.owner[group + k], list.partner[k] = list.partner[group + k],
      list.number[k] = list.number[group + k];
  }
  gathered_contacts<Case, W>(side, batches, first, list, list.count, rows, overlap, energy);
  overlap.put_back(watch.overlap);
  energy.put_back(watch);
}

}  // namespace fixdem
