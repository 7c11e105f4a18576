// Pairs of spheres: the side of the contact loop that knows two particles.
//
// Overlap is d - |x_j - x_i|, the normal points from owner to partner. In double the root is taken of the square of the
// distance. In mixed precision the difference d^2 - |x_j - x_i|^2 is formed in double and narrowed: from it overlap and
// distance follow in floats without cancellation, overlap = (d^2 - q^2) / (d + q).
#pragma once

#include "sparse_contacts.hpp"

namespace fixdem {

template <class Case>
struct PairSide {
  using Law = ContactLaw<Case, false>;
  using R = Real<Case>;
  static constexpr double d = Case::diameter;
  static constexpr bool is_flat = false;  ///< normals have three components

  const double *owner_position, *partner_position;
  const R *owner_motion, *partner_motion;
  const double *owner_kick = nullptr, *partner_kick = nullptr;
  double shift;  ///< of the partner along z

  PairSide(const Particles<Case>& particles, int range) {
    const PairRange<Case> at(range);
    owner_position = particles.position[at.owner_base], partner_position = particles.position[at.partner_base];
    owner_motion = particles.looked_up_motion(at.owner_base);
    partner_motion = particles.looked_up_motion(at.partner_base);
    if constexpr (Particles<Case>::predicts)
      owner_kick = particles.last_kick.row[at.owner_base], partner_kick = particles.last_kick.row[at.partner_base];
    shift = at.shift;
  }

  /// From owner to partner. Measure: square of the distance; mixed: d^2 less that.
  template <int W, class Offset>
  FIXDEM_INLINE Separation<Lanes<W, R>> separation(const Offset* owner, const Offset* partner) const {
    const auto part = [&](auto width, int lane) FIXDEM_INLINE_LAMBDA {
      constexpr int w = decltype(width)::value;
      Vec3<Lanes<w>> r = load_differences<w>(partner_position, partner + lane, owner_position, owner + lane);
      r.z = r.z + shift;
      const Lanes<w> square = dot(r, r);
      return Separation<Lanes<w>>{r, is_mixed<Case> ? d * d - square : square};
    };
    if constexpr (is_mixed<Case>)
      return narrowed<W>(part);
    else
      return part(std::integral_constant<int, W>{}, 0);
  }

  template <class V>
  FIXDEM_INLINE auto touches(const Separation<V>& s) const {
    if constexpr (is_mixed<Case>)
      return s.measure > V{};
    else
      return s.measure < d * d;
  }

  static constexpr bool has_root = true, needs_measure = is_mixed<Case>;
  /// Distance.
  template <class V>
  FIXDEM_INLINE V root(V measure) const {
    if constexpr (is_mixed<Case>)
      return sqrt(constant<V>(d * d) - measure);
    else
      return sqrt(measure);
  }
  /// Overlap, negative in lanes without contact, and normal.
  template <class V>
  FIXDEM_INLINE V resolve(const Separation<V>& s, V distance, Vec3<V>& n) const {
    if constexpr (is_mixed<Case>) {
      const V sum = distance + constant<V>(d);
      const V inverse = constant<V>(1) / (distance * sum);
      n = scale(inverse * sum, s.way);
      return s.measure * inverse * distance;
    } else {
      n = scale(1.0 / distance, s.way);
      return splat<V>(d) - distance;
    }
  }

  template <int W, class Offset>
  FIXDEM_INLINE Motion<Lanes<W, R>> motion(const Offset* owner, const Offset* partner) const {
    if constexpr (Derived<Case>::has_friction)
      return load_motion_of_pairs<W>(owner_motion, owner, partner_motion, partner);
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
      return narrowed<W>(part).way;
    else
      return part(std::integral_constant<int, W>{}, 0).way;
  }
};

/// Force rows of range `range` of the near pairs, written from `rows` on. `W`: doubles per register; `are_still`: see
/// dense_contacts.
template <class Case, int W>
void pair_contacts(PairBatches<Case>& pairs, const Particles<Case>& particles, int range, bool are_still,
                   Real<Case>* rows, Watch<Case>& watch) {
  constexpr int lanes = contact_lanes<Case, W>;
  const PairSide<Case> side(particles, range);
  const int first = PairBatches<Case>::first(range);
  if (pairs.sparse[range])
    sparse_contacts<Case, lanes>(side, pairs, first, pairs.count[range], rows, watch);
  else
    dense_contacts<Case, lanes>(side, pairs, first, pairs.count[range], are_still, rows, watch);
}

}  // namespace fixdem
