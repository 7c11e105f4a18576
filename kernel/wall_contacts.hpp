// Walls: the side of the contact loop whose partner neither moves nor turns.
//
// The law is that of pairs with the wall's coefficients (eqs. 17, 22); where a wall is its surface says (surfaces.hpp).
#pragma once

#include "sparse_contacts.hpp"

namespace fixdem {

template <class Case, class Surface>
struct WallSide {
  using Law = ContactLaw<Case, true>;
  using R = Real<Case>;
  static constexpr bool is_flat = Surface::is_flat, has_root = Surface::has_root;
  static constexpr bool needs_gap_square = is_mixed<Case> || !has_root;
  static constexpr bool has_partner_torques = false;

  const double* position;
  const R* owner_motion;
  const double* last_kick = nullptr;

  /// Owners count from particle `base`.
  WallSide(const Particles<Case>& particles, int base) {
    position = particles.position[base];
    owner_motion = particles.looked_up_motion(base);
    if constexpr (Particles<Case>::predicts) last_kick = particles.last_kick.row[base];
  }

  template <int W, class Offset>
  FIXDEM_INLINE Separation<Lanes<W, R>> separation(const Offset* owner, const Offset*) const {
    const auto part = [&](auto width, int lane) FIXDEM_INLINE_LAMBDA {
      constexpr int w = decltype(width)::value;
      const Vec4<Lanes<w>> x = load_columns<w>(position, owner + lane);
      const Lanes<w> radius = has_sizes<Case> ? x.w : splat<Lanes<w>>(Derived<Case>::reference_radius);
      return Surface::separation(Vec3<Lanes<w>>{x.x, x.y, x.z}, radius);
    };
    if constexpr (is_mixed<Case>)
      return narrowed<W>(part);
    else
      return part(std::integral_constant<int, W>{}, 0);
  }
  template <class V>
  FIXDEM_INLINE unsigned touching(const Separation<V>& s) const {
    return Surface::touching(s);
  }
  template <class V>
  FIXDEM_INLINE V root(const Separation<V>& s) const {
    return Surface::root(s);
  }
  template <class V>
  FIXDEM_INLINE V resolve(const Separation<V>& s, V root, Vec3<V>& n) const {
    return Surface::resolve(s, root, n);
  }
  template <int W, class Offset>
  FIXDEM_INLINE Motion<Lanes<W, R>> motion(const Offset* owner, const Offset*) const {
    Motion<Lanes<W, R>> motion{};
    if constexpr (Particles<Case>::motion_width == 8)
      motion = load_motion<W>(owner_motion, owner);
    else
      motion.velocity = load_vectors<W>(owner_motion, owner);
    if constexpr (Law::has_rolling) motion.rolling = scale(splat<Lanes<W, R>>(-1), motion.spin);
    motion.owner_inverse_mass = motion.inverse_mass, motion.owner_inverse_radius = motion.inverse_radius;
    return motion;
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
      return narrowed<W>(part).separation;
    else
      return part(std::integral_constant<int, W>{}, 0).separation;
  }
};

/// Force rows of the near walls of one kind in one dense chunk; see dense_pairs.
template <class Case, int W, class Walls>
void dense_walls(Walls& walls, const Particles<Case>& particles, int chunk, bool are_still, Real<Case>* rows,
                 StepMonitor<Case>& monitor) {
  const WallSide<Case, typename Walls::Surface> side(particles, chunk * Capacity<Case>::chunk_size);
  dense_contacts<Case, contact_lanes<Case, W>>(side, walls, Walls::first(chunk), walls.count[chunk], are_still, rows,
                                               nullptr, monitor);
}

/// Contacts with the walls of one kind in the sparse chunks from `begin` to `end`; see sparse_pairs.
template <class Case, int W, class Walls>
void sparse_walls(Walls& walls, Contacts<Case>& contacts, const Particles<Case>& particles, int begin, int end,
                  StepMonitor<Case>* monitor, const RowsForLater<Case>* later) {
  using Side = WallSide<Case, typename Walls::Surface>;
  SparseContacts<Case, contact_lanes<Case, W>, Side, Walls> sparse(Side(particles, 0), walls, contacts.sum[0], monitor,
                                                                   later);
  for (int chunk = begin; chunk < end; ++chunk) {
    if (!walls.sparse[chunk]) continue;
    const int base = chunk * Capacity<Case>::chunk_size;
    sparse.look_at(Side(particles, base), chunk, base, base);
  }
  sparse.compute();
}

}  // namespace fixdem
