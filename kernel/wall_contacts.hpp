// Walls: the side of the contact loop whose partner neither moves nor turns.
//
// The pipe's inner surface, with overlap q - (R - r), q the distance of the centre from the axis, normal outwards; and
// the flat ends of a closed pipe, with overlap r - z or z - (L - r). A particle has one contact of each kind at most;
// the law is that of pairs with the wall's coefficients (eqs. 17, 22). In mixed precision q^2 - (R - r)^2 and the
// overlap with an end are formed in double and narrowed.
#pragma once

#include "sparse_contacts.hpp"

namespace fixdem {

/// Measure: q^2; mixed: q^2 - (R - r)^2.
template <class Case>
struct PipeSurface {
  static constexpr bool is_flat = true;  ///< normals have no component along the pipe
  static constexpr bool has_root = true;
  static constexpr double reach = Derived<Case>::pipe_radius - Derived<Case>::radius;

  template <class V>
  static FIXDEM_INLINE Separation<V> separation(const Vec3<V>& x) {
    const V square = fused(x.y, x.y, x.x * x.x);
    return {{x.x, x.y, V{}}, is_mixed<Case> ? square - reach * reach : square};
  }
  template <class V>
  static FIXDEM_INLINE auto touches(V measure) {
    if constexpr (is_mixed<Case>)
      return measure > V{};
    else
      return measure > reach * reach;
  }
  /// On the axis there is no normal, and no contact.
  template <class V>
  static FIXDEM_INLINE V root(V measure) {
    if constexpr (is_mixed<Case>)
      return sqrt(max(measure + constant<V>(reach * reach), V{}));
    else
      return sqrt(measure);
  }
  template <class V>
  static FIXDEM_INLINE V resolve(const Separation<V>& s, V q, Vec3<V>& n) {
    if constexpr (is_mixed<Case>) {
      n = scale(constant<V>(1) / max(q, splat<V>(1e-30)), s.way);
      return s.measure / (q + constant<V>(reach));
    } else {
      n = scale(1.0 / max(q, splat<V>(1e-300)), s.way);
      return q - reach;
    }
  }
};

/// Measure: the overlap itself; the way is along z.
template <class Case>
struct EndSurfaces {
  static constexpr bool is_flat = false, has_root = false;
  template <class V>
  static FIXDEM_INLINE Separation<V> separation(const Vec3<V>& x) {
    const auto at_start = x.z < 0.5 * Case::pipe_length;
    return {{V{}, V{}, select(at_start, splat<V>(-1.0), splat<V>(1.0))},
            select(at_start, Derived<Case>::radius - x.z, x.z - (Case::pipe_length - Derived<Case>::radius))};
  }
  template <class V>
  static FIXDEM_INLINE auto touches(V measure) {
    return measure > V{};
  }
  template <class V>
  static FIXDEM_INLINE V resolve(const Separation<V>& s, V, Vec3<V>& n) {
    n = s.way;
    return s.measure;
  }
};

template <class Case, class Surface>
struct WallSide {
  using Law = ContactLaw<Case, true>;
  using R = Real<Case>;
  static constexpr bool is_flat = Surface::is_flat, has_root = Surface::has_root;
  static constexpr bool needs_measure = is_mixed<Case> || !has_root;

  const double* position;
  const R* moving;
  const double* last_kick = nullptr;

  /// Owners count from particle `base`.
  WallSide(const Particles<Case>& particles, int base) {
    position = particles.position[base];
    moving = particles.looked_up_motion(base);
    if constexpr (Particles<Case>::predicts) last_kick = particles.last_kick.row[base];
  }

  template <int W, class Offset>
  FIXDEM_INLINE Separation<Lanes<W, R>> separation(const Offset* owner, const Offset*) const {
    const auto part = [&](auto width, int lane) FIXDEM_INLINE_LAMBDA {
      return Surface::separation(load_vectors<decltype(width)::value>(position, owner + lane));
    };
    if constexpr (is_mixed<Case>)
      return narrowed<W>(part);
    else
      return part(std::integral_constant<int, W>{}, 0);
  }
  template <class V>
  FIXDEM_INLINE auto touches(const Separation<V>& s) const {
    return Surface::touches(s.measure);
  }
  template <class V>
  FIXDEM_INLINE V root(V measure) const {
    return Surface::root(measure);
  }
  template <class V>
  FIXDEM_INLINE V resolve(const Separation<V>& s, V root, Vec3<V>& n) const {
    return Surface::resolve(s, root, n);
  }
  template <int W, class Offset>
  FIXDEM_INLINE Motion<Lanes<W, R>> motion(const Offset* owner, const Offset*) const {
    if constexpr (Derived<Case>::has_friction)
      return load_motion<W>(moving, owner);
    else
      return {load_vectors<W>(moving, owner), Vec3<Lanes<W, R>>{}};
  }
  template <int W, class Offset>
  FIXDEM_INLINE Vec3<Lanes<W, R>> kick(const Offset* owner, const Offset*) const {
    const auto part = [&](auto width, int lane) FIXDEM_INLINE_LAMBDA {
      constexpr int w = decltype(width)::value;
      return Separation<Lanes<w>>{load_vectors<w>(last_kick, owner + lane), {}};
    };
    if constexpr (!Particles<Case>::predicts)
      return Vec3<Lanes<W, R>>{};
    else if constexpr (is_mixed<Case>)
      return narrowed<W>(part).way;
    else
      return part(std::integral_constant<int, W>{}, 0).way;
  }
};

/// Force rows of the near walls of one kind in one dense chunk; see dense_pairs.
template <class Case, int W, class Surface, class Walls>
void dense_walls(Walls& walls, const Particles<Case>& particles, int chunk, bool are_still, Real<Case>* rows,
                 Watch<Case>& watch) {
  const WallSide<Case, Surface> side(particles, chunk * Capacity<Case>::chunk_size);
  dense_contacts<Case, contact_lanes<Case, W>>(side, walls, Walls::first(chunk), walls.count[chunk], are_still, rows,
                                               watch);
}

/// Contacts with the walls of one kind in the sparse chunks from `begin` to `end`; see sparse_pairs.
template <class Case, int W, class Surface, class Walls>
void sparse_walls(Walls& walls, Contacts<Case>& contacts, const Particles<Case>& particles, int begin, int end,
                  Watch<Case>* watch, const RowsForLater<Case>* later) {
  using Side = WallSide<Case, Surface>;
  SparseContacts<Case, contact_lanes<Case, W>, Side, Walls> sparse(Side(particles, 0), walls, contacts.sum[0], watch,
                                                                   later);
  for (int chunk = begin; chunk < end; ++chunk) {
    if (!walls.sparse[chunk]) continue;
    const int base = chunk * Capacity<Case>::chunk_size;
    sparse.look_at(Side(particles, base), chunk, base, base);
  }
  sparse.compute();
}

}  // namespace fixdem
