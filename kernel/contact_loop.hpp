// The contact loop: force rows of the near pairs or near walls of one range, batch by batch.
//
// A contact goes through stages (contact_stages.hpp), handed on in the first-level cache. The roots and the quotient of
// one W contacts, each some 20 cycles long, must pass while others are computed; how depends on the registers.
//
// Registers of 32 bytes or less: three stages interleaved. A step of the loop does the law of W contacts, the geometry
// of the next W and the separation of those after them. Measured on Zen 3 with AVX2, million particle-steps/s in a
// settled bed: geometry of eight batches before the law of these 41, all stages of a batch in one step 41, this 47.
//
// Registers of 64 bytes, twice as many: the geometry of 12 batches, then their law, in which the motion of the next W
// contacts is loaded and transposed ahead of the law of these. Measured on Zen 5 with AVX-512: interleaved 106, groups
// of 8 without motion ahead 106, with it 112, of 12 to 48 batches 115.
//
// A row is written for every near contact, zero where nothing touches. Here all lanes are computed, which suits a bed;
// sparse_contacts.hpp serves ranges in which most listed contacts do not touch.
#pragma once

#include "contact_stages.hpp"

namespace fixdem {

namespace detail {

/// The stages of `count` contacts, three of them interleaved. `place(k)`: of the W contacts from number k on.
template <class Case, int W, SlidingLanes mode, class Side, class Offset, class PlaceOf>
FIXDEM_INLINE void interleaved_contacts(const Side& side, const Offset* owner, const Offset* partner, int count,
                                        PlaceOf&& place_of, Partials<W, Capacity<Case>::batch, Real<Case>>& overlap) {
  using V = Lanes<W, Real<Case>>;
  struct Stored {
    StoredSeparation<Case, W> separation;
    ContactGeometry<Case, W> geometry;
  };
  Stored ring[4];
  const int last = (count - 1) / W * W;
  const auto separate = [&](int k, Stored& to) FIXDEM_INLINE_LAMBDA {
    k = k < last ? k : last;
    store_separation<Case, W>(side, side.template separation<W>(owner + k, partner + k), to.separation);
  };
  const auto resolve = [&](Stored& s) FIXDEM_INLINE_LAMBDA {
    V root{};
    if constexpr (Side::has_root) root = load<V>(s.separation.root);
    store_geometry<Case, W>(side, stored_separation<Case, W, Side>(s.separation), root, s.geometry, overlap.part[0]);
  };
  separate(0, ring[0]);
  separate(W, ring[1]);
  resolve(ring[0]);
  for (int k = 0; k < count; k += W) {
    const auto at = [&](int ahead)
                        FIXDEM_INLINE_LAMBDA -> Stored& { return ring[static_cast<unsigned>(k + ahead * W) / W % 4]; };
    resolve(at(1));
    separate(k + 2 * W, at(2));
    const ContactGeometry<Case, W>& g = at(0).geometry;
    const auto place = place_of(k);
    [[maybe_unused]] const bool is_done = contact_rows<Case, W, mode>(
        side, g, owner + k, partner + k, moving_bodies<Case, W>(side, owner + k, partner + k), place);
    if constexpr (mode == SlidingLanes::reported)
      if (!is_done) sliding_contact_rows<Case, W>(side, g, owner + k, partner + k, place);
  }
}

/// The same in groups: geometry of all, then the law of all.
template <class Case, int W, SlidingLanes mode, class Side, class Offset, class PlaceOf>
FIXDEM_INLINE void grouped_contacts(const Side& side, const Offset* owner, const Offset* partner, int count,
                                    PlaceOf&& place_of, Partials<W, Capacity<Case>::batch, Real<Case>>& overlap) {
  constexpr int group = 12 * W;
  ContactGeometry<Case, W> geometry[group / W];
  for (int begin = 0; begin < count; begin += group) {
    const int end = begin + group < count ? begin + group : count;
    ContactGeometry<Case, W>* g = geometry;
    for (int k = begin; k < end; k += W, ++g) {
      const auto s = side.template separation<W>(owner + k, partner + k);
      store_geometry<Case, W>(side, s, root_of(side, s), *g, overlap.part[0]);
    }
    g = geometry;
    auto next = moving_bodies<Case, W>(side, owner + begin, partner + begin);
    for (int k = begin; k < end; k += W, ++g) {
      const auto moving = next;
      const int ahead = k + W < end ? k + W : k;
      next = moving_bodies<Case, W>(side, owner + ahead, partner + ahead);
      const auto place = place_of(k);
      [[maybe_unused]] const bool is_done =
          contact_rows<Case, W, mode>(side, *g, owner + k, partner + k, moving, place);
      if constexpr (mode == SlidingLanes::reported)
        if (!is_done) sliding_contact_rows<Case, W>(side, *g, owner + k, partner + k, place);
    }
  }
}

/// The order of stages that suits the registers.
template <class Case, int W, SlidingLanes mode, class Side, class Offset, class PlaceOf>
FIXDEM_INLINE void all_contacts(const Side& side, const Offset* owner, const Offset* partner, int count,
                                PlaceOf&& place_of, Partials<W, Capacity<Case>::batch, Real<Case>>& overlap) {
  if (count == 0) return;
  if constexpr (W * sizeof(Real<Case>) == 64)
    grouped_contacts<Case, W, mode>(side, owner, partner, count, place_of, overlap);
  else
    interleaved_contacts<Case, W, mode>(side, owner, partner, count, place_of, overlap);
}

/// Histories of a dense range, or nothing where the case keeps none.
template <class Case, int Size, class Batches>
FIXDEM_INLINE auto dense_histories(Batches& batches, int first) {
  if constexpr (Size > 0) {
    return batches.history.lanes(first, first);
  } else {
    return static_cast<Real<Case>(*)[Capacity<Case>::batch]>(nullptr);
  }
}

/// Row numbers of the partners of a batch; walls have none, and their side does not look.
template <class Batches>
FIXDEM_INLINE const auto* partners_of(const Batches& batches, int batch) {
  if constexpr (requires { batches.partner; })
    return batches.partner[batch];
  else
    return batches.owner[batch];
}

}  // namespace detail

/// Force rows of `count` contacts in the batches from `first` on, written from `rows` on, and where the side has them
/// torques on the partners from `torques` on; all lanes are computed.
///
/// Where particles are still (NearList::is_still), hardly any batch has a lane that slides, and none turns. The short
/// law of such contacts is worth a loop of its own: 129 million particle-steps/s in a bed at rest with AVX-512, 121
/// without.
template <class Case, int W, class Side, class Batches>
void dense_contacts(const Side side, Batches& batches, int first, int count, bool are_still, Real<Case>* rows,
                    [[maybe_unused]] Real<Case>* torques, StepMonitor<Case>& monitor) {
  constexpr int width = Particles<Case>::motion_width, lanes = Capacity<Case>::batch;
  constexpr int size = Side::Law::history_size;
  Partials<W, lanes, Real<Case>> overlap(monitor.overlap);
  BookedEnergy<Case, W> energy(monitor);
  auto* history = detail::dense_histories<Case, size>(batches, first);
  const auto place = [&](int k) FIXDEM_INLINE_LAMBDA {
    Real<Case>* const torque = Side::has_partner_torques ? torques + 4 * k : nullptr;
    return detail::InPlace<Case, W>{history + k / lanes * size, k % lanes, count - k,
                                    rows + k * width,           torque,    &energy};
  };
  const auto *owner = batches.owner[first], *partner = detail::partners_of(batches, first);
  if (are_still || !Side::Law::has_friction)
    detail::all_contacts<Case, W, SlidingLanes::reported>(side, owner, partner, count, place, overlap);
  else if constexpr (Side::Law::has_friction)
    detail::all_contacts<Case, W, SlidingLanes::computed>(side, owner, partner, count, place, overlap);
  overlap.put_back(monitor.overlap);
  energy.put_back(monitor);
}

}  // namespace fixdem
