// Pairs of spheres: the side of the contact loop that knows two particles.
//
// Overlap is d - |x_j - x_i| with d = r_i + r_j, the normal points from owner to partner. In double the root is taken
// of the square of the distance. In mixed precision the difference d^2 - |x_j - x_i|^2 is formed in double and
// narrowed: from it overlap and distance follow in floats without cancellation, overlap = (d^2 - q^2) / (d + q).
#pragma once

#include "sparse_contacts.hpp"

namespace fixdem {

template <class Case>
struct PairSide {
  using Law = ContactLaw<Case, false>;
  using R = Real<Case>;
  static constexpr bool is_flat = false;  ///< normals have three components

  const double *owner_position, *partner_position;
  const R *owner_motion, *partner_motion;
  const double *owner_kick = nullptr, *partner_kick = nullptr;
  double shift;  ///< of the partner along z

  /// Owners and partners count from the bases of the range.
  PairSide(const Particles<Case>& particles, const PairRange<Case>& at)
      : PairSide(particles, at.owner_base, at.partner_base, at.shift) {}

  PairSide(const Particles<Case>& particles, int owner_base, int partner_base, double partner_shift)
      : owner_position(particles.position[owner_base]),
        partner_position(particles.position[partner_base]),
        owner_motion(particles.looked_up_motion(owner_base)),
        partner_motion(particles.looked_up_motion(partner_base)),
        shift(partner_shift) {
    if constexpr (Particles<Case>::predicts)
      owner_kick = particles.last_kick.row[owner_base], partner_kick = particles.last_kick.row[partner_base];
  }

  /// From owner to partner. Measure: square of the distance; mixed: d^2 less that.
  template <int W, class Offset>
  FIXDEM_INLINE Separation<Lanes<W, R>> separation(const Offset* owner, const Offset* partner) const {
    const auto part = [&](auto width, int lane) FIXDEM_INLINE_LAMBDA {
      constexpr int w = decltype(width)::value;
      const Separation<Lanes<w>> s =
          separation_of_pairs<Case, w>(partner_position, partner + lane, owner_position, owner + lane, shift);
      return is_mixed<Case>
                 ? Separation<Lanes<w>>{s.separation, reach_square_of<Case>(s, largest_diameter<Case>) - s.gap_square,
                                        s.reach}
                 : s;
    };
    if constexpr (is_mixed<Case>)
      return narrowed<W>(part);
    else
      return part(std::integral_constant<int, W>{}, 0);
  }

  template <class V>
  FIXDEM_INLINE unsigned touching(const Separation<V>& s) const {
    if constexpr (is_mixed<Case>)
      return bits_below(V{}, s.gap_square);
    else
      return bits_below(s.gap_square, reach_square_of<Case>(s, largest_diameter<Case>));
  }

  static constexpr bool has_root = true, needs_gap_square = is_mixed<Case>;
  static constexpr bool has_partner_torques = fixdem::has_partner_torques<Case>;
  /// Distance.
  template <class V>
  FIXDEM_INLINE V root(const Separation<V>& s) const {
    if constexpr (is_mixed<Case>)
      return sqrt(reach_square_of<Case>(s, largest_diameter<Case>) - s.gap_square);
    else
      return sqrt(s.gap_square);
  }
  /// Overlap, negative in lanes without contact, and normal.
  template <class V>
  FIXDEM_INLINE V resolve(const Separation<V>& s, V distance, Vec3<V>& n) const {
    if constexpr (is_mixed<Case>) {
      const V sum = distance + reach_of<Case>(s, largest_diameter<Case>);
      const V inverse = constant<V>(1) / (distance * sum);
      n = scale(inverse * sum, s.separation);
      return s.gap_square * inverse * distance;
    } else {
      n = scale(1.0 / distance, s.separation);
      return reach_of<Case>(s, largest_diameter<Case>) - distance;
    }
  }

  template <int W, class Offset>
  FIXDEM_INLINE Motion<Lanes<W, R>> motion(const Offset* owner, const Offset* partner) const {
    if constexpr (Law::has_rolling)
      return load_rolling_of_pairs<W, has_sizes<Case>>(owner_motion, owner, partner_motion, partner);
    else if constexpr (Particles<Case>::motion_width == 8)
      return load_motion_of_pairs<W, has_sizes<Case>>(owner_motion, owner, partner_motion, partner);
    else
      return {load_differences<W>(owner_motion, owner, partner_motion, partner), Vec3<Lanes<W, R>>{}};
  }

  template <int W, class Offset>
  FIXDEM_INLINE Vec3<Lanes<W, R>> kick(const Offset* owner, const Offset* partner) const {
    const auto part = [&](auto width, int lane) FIXDEM_INLINE_LAMBDA {
      constexpr int w = decltype(width)::value;
      return Separation<Lanes<w>>{load_differences<w>(owner_kick, owner + lane, partner_kick, partner + lane), {}};
    };
    if constexpr (!Particles<Case>::predicts)
      return Vec3<Lanes<W, R>>{};
    else if constexpr (is_mixed<Case>)
      return narrowed<W>(part).separation;
    else
      return part(std::integral_constant<int, W>{}, 0).separation;
  }
};

/// Force rows of a dense range of the near pairs, written from `rows` on. `W`: doubles per register; `are_still`: see
/// dense_contacts.
template <class Case, int W>
void dense_pairs(PairBatches<Case>& pairs, const Particles<Case>& particles, int range, bool are_still,
                 Real<Case>* rows, Real<Case>* torques, StepMonitor<Case>& monitor) {
  const PairSide<Case> side(particles, PairRange<Case>(range));
  dense_contacts<Case, contact_lanes<Case, W>>(side, pairs, PairBatches<Case>::first(range), pairs.count[range],
                                               are_still, rows, torques, monitor);
}

/// Contacts of the sparse ranges from `begin` to `end` of the near pairs, added to the sums of their particles, or put
/// into `later` if that is not null.
template <class Case, int W>
void sparse_pairs(Contacts<Case>& contacts, const Particles<Case>& particles, int begin, int end,
                  StepMonitor<Case>* monitor, const RowsForLater<Case>* later) {
  using Side = PairSide<Case>;
  const Side all(particles, 0, 0, PairRange<Case>(begin).shift);
  SparseContacts<Case, contact_lanes<Case, W>, Side, PairBatches<Case>> sparse(all, contacts.pairs, contacts.sum[0],
                                                                               monitor, later);
  for (int range = begin; range < end; ++range) {
    if (!contacts.pairs.sparse[range]) continue;
    const PairRange<Case> at(range);
    sparse.look_at(Side(particles, at), range, at.owner_base, at.partner_base);
  }
  sparse.compute();
}

}  // namespace fixdem
