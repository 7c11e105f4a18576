// The stages of a contact: its separation, its geometry, and the law with its history and force rows.
//
// What differs between pairs and walls is a `Side` (pair_contacts.hpp, wall_contacts.hpp): it knows the separation of a
// contact, its normal and overlap, and the relative motion. The order in which the contacts of a range go through the
// stages is contact_loop.hpp's.
#pragma once

#include "booked_energy.hpp"
#include "impulse_law.hpp"

namespace fixdem {

/// Separation of W contacts in floats from parts computed in double: part(width, first lane).
template <int W, class Part>
FIXDEM_INLINE Separation<Lanes<W, float>> narrowed(Part&& part) {
  if constexpr (W == 1) {
    const Separation<double> s = part(std::integral_constant<int, 1>{}, 0);
    return {{narrow(s.separation.x), narrow(s.separation.y), narrow(s.separation.z)},
            narrow(s.gap_square),
            narrow(s.reach)};
  } else {
    const std::integral_constant<int, W / 2> width;
    const Separation<Lanes<W / 2>> a = part(width, 0), b = part(width, W / 2);
    return {{narrow(a.separation.x, b.separation.x), narrow(a.separation.y, b.separation.y),
             narrow(a.separation.z, b.separation.z)},
            narrow(a.gap_square, b.gap_square),
            narrow(a.reach, b.reach)};
  }
}

namespace detail {
template <class T, int W, bool present>
struct StoredLanes {
  alignas(64) T value[W];
};
template <class T, int W>
struct StoredLanes<T, W, false> {};
}  // namespace detail

/// Separation of W contacts and its root, as the first stage leaves them.
template <class Case, int W>
struct StoredSeparation {
  alignas(64) Real<Case> separation[3][W];
  alignas(64) Real<Case> gap_square[W], root[W];
  [[no_unique_address]] detail::StoredLanes<Real<Case>, W, has_sizes<Case>> reach;
};

/// What the law takes up of W contacts.
template <class Case, int W>
struct ContactGeometry {
  alignas(64) Real<Case> normal[3][W];
  alignas(64) Real<Case> repulsion[W],
      overlap_root[W];  ///< with `impulse` or several sizes the overlap, negative for a gap, and its root
};

namespace detail {

template <class Side, class V>
FIXDEM_INLINE V root_of(const Side& side, const Separation<V>& s) {
  if constexpr (Side::has_root)
    return side.root(s);
  else
    return V{};
}

template <class Case, int W, class Side>
FIXDEM_INLINE void store_separation(const Side& side, const Separation<Lanes<W, Real<Case>>>& s,
                                    StoredSeparation<Case, W>& to) {
  store(to.separation[0], s.separation.x);
  store(to.separation[1], s.separation.y);
  if constexpr (!Side::is_flat) store(to.separation[2], s.separation.z);
  if constexpr (Side::needs_gap_square) store(to.gap_square, s.gap_square);
  if constexpr (Side::has_root) store(to.root, root_of(side, s));
  if constexpr (has_sizes<Case>) store(to.reach.value, s.reach);
}

template <class Case, int W, class Side>
FIXDEM_INLINE Separation<Lanes<W, Real<Case>>> stored_separation(const StoredSeparation<Case, W>& from) {
  using V = Lanes<W, Real<Case>>;
  Separation<V> s{{load<V>(from.separation[0]), load<V>(from.separation[1]), V{}}, V{}};
  if constexpr (!Side::is_flat) s.separation.z = load<V>(from.separation[2]);
  if constexpr (Side::needs_gap_square) s.gap_square = load<V>(from.gap_square);
  if constexpr (has_sizes<Case>) s.reach = load<V>(from.reach.value);
  return s;
}

/// Normal, overlap and the first of its springs; eqs. (16), (17), (21), (22), (26).
template <class Case, int W, class Side>
FIXDEM_INLINE void store_geometry(const Side& side, const Separation<Lanes<W, Real<Case>>>& s,
                                  Lanes<W, Real<Case>> root, ContactGeometry<Case, W>& g,
                                  Lanes<W, Real<Case>>& maximum) {
  using V = Lanes<W, Real<Case>>;
  Vec3<V> n;
  const V gap_or_overlap = side.resolve(s, root, n), overlap = max(gap_or_overlap, V{});
  store(g.normal[0], n.x);
  store(g.normal[1], n.y);
  if constexpr (!Side::is_flat) store(g.normal[2], n.z);
  if constexpr (takes_impulses<Case> || has_sizes<Case>) {  // with several sizes springs follow from masses, too
    store(g.repulsion, gap_or_overlap);
    if constexpr (takes_impulses<Case> && Derived<Case>::is_hertz) store(g.overlap_root, sqrt(overlap));
  } else {
    const ContactBodies<typename Side::Law, Case, V> bodies(Motion<V>{});
    const SpringBase<V> base = spring_base<typename Side::Law, Case>(overlap, bodies);
    store(g.repulsion, base.repulsion);
    store(g.overlap_root, base.root);
  }
  maximum = max(overlap, maximum);
}

/// The numbers that W contacts keep.
template <class V, int Count>
struct KeptNumbers {
  V value[Count > 0 ? Count : 1];
};

/// History, rows and ledger of W contacts that lie side by side in a batch, the first `valid` of them not repeated.
template <class Case, int W>
struct InPlace {
  Real<Case> (*history)[Capacity<Case>::batch];
  int lane, valid;
  Real<Case>*row, *partner_torque;  ///< the latter with rolling resistance only
  BookedEnergy<Case, W>* energy;
  template <class V, int Count>
  FIXDEM_INLINE KeptNumbers<V, Count> loaded_numbers() const {
    KeptNumbers<V, Count> numbers{};
    for (int c = 0; c < Count; ++c) numbers.value[c] = load<V>(history[c] + lane);
    return numbers;
  }
  template <class V, int Count>
  FIXDEM_INLINE void store_numbers(const KeptNumbers<V, Count>& numbers) const {
    for (int c = 0; c < Count; ++c) store(history[c] + lane, numbers.value[c]);
  }
  template <class V>
  FIXDEM_INLINE void book(const ContactForce<V>& f) const {
    energy->book(lane, valid, f);
  }
};

/// History of W contacts, and its return; places as ContactLaw says.
template <class Law, class Case, class V, class Place>
FIXDEM_INLINE History<V> loaded_history(const Place& place) {
  const KeptNumbers<V, Law::history_size> kept = place.template loaded_numbers<V, Law::history_size>();
  const auto vector = [&](int c) FIXDEM_INLINE_LAMBDA {
    return Vec3<V>{kept.value[c], kept.value[c + 1], kept.value[c + 2]};
  };
  History<V> h{};
  if constexpr (Law::history_vectors > 0) h.spring = vector(0);
  if constexpr (Law::history_vectors > 1) h.last_velocity = vector(3);
  if constexpr (takes_impulses<Case>) h.state_function = kept.value[Law::state_function_place];
  if constexpr (Law::limit_place > Law::stiffness_place) h.last_tangential_stiffness = kept.value[Law::stiffness_place];
  if constexpr (Law::rolling_place > Law::limit_place) h.last_limit = kept.value[Law::limit_place];
  if constexpr (Law::has_rolling) h.rolling = vector(Law::rolling_place);
  if constexpr (Law::keeps_rolling_stiffness) h.last_rolling_stiffness = kept.value[Law::rolling_place + 3];
  return h;
}
template <class Law, class Case, class Place, class V>
FIXDEM_INLINE void store_history(const Place& place, const History<V>& h) {
  KeptNumbers<V, Law::history_size> kept{};
  const auto vector = [&](int c, const Vec3<V>& a) FIXDEM_INLINE_LAMBDA {
    kept.value[c] = a.x, kept.value[c + 1] = a.y, kept.value[c + 2] = a.z;
  };
  if constexpr (Law::history_vectors > 0) vector(0, h.spring);
  if constexpr (Law::history_vectors > 1) vector(3, h.last_velocity);
  if constexpr (takes_impulses<Case>) kept.value[Law::state_function_place] = h.state_function;
  if constexpr (Law::limit_place > Law::stiffness_place) kept.value[Law::stiffness_place] = h.last_tangential_stiffness;
  if constexpr (Law::rolling_place > Law::limit_place) kept.value[Law::limit_place] = h.last_limit;
  if constexpr (Law::has_rolling) vector(Law::rolling_place, h.rolling);
  if constexpr (Law::keeps_rolling_stiffness) kept.value[Law::rolling_place + 3] = h.last_rolling_stiffness;
  place.template store_numbers<V, Law::history_size>(kept);
}

/// Relative motion of W contacts, and what their bodies make of it: one quotient with several sizes.
template <class Law, class Case, class V>
struct MovingBodies {
  Motion<V> motion;
  ContactBodies<Law, Case, V> bodies;
  FIXDEM_INLINE explicit MovingBodies(const Motion<V>& of_contacts) : motion(of_contacts), bodies(of_contacts) {}
};
template <class Case, int W, class Side, class Offset>
FIXDEM_INLINE auto moving_bodies(const Side& side, const Offset* owner, const Offset* partner) {
  return MovingBodies<typename Side::Law, Case, Lanes<W, Real<Case>>>(side.template motion<W>(owner, partner));
}

/// The law of W contacts, their history and force rows. False when some lane slides and that is
/// left to be done; then nothing has been written.
template <class Case, int W, SlidingLanes mode, class Side, class Offset, class Place>
FIXDEM_INLINE bool contact_rows(const Side& side, const ContactGeometry<Case, W>& g, const Offset* owner,
                                const Offset* partner,
                                const MovingBodies<typename Side::Law, Case, Lanes<W, Real<Case>>>& moving,
                                const Place& place) {
  using V = Lanes<W, Real<Case>>;
  using Law = typename Side::Law;
  std::conditional_t<Side::is_flat, Vec2<V>, Vec3<V>> n{};
  n.x = load<V>(g.normal[0]), n.y = load<V>(g.normal[1]);
  if constexpr (!Side::is_flat) n.z = load<V>(g.normal[2]);

  const auto& [motion, bodies] = moving;
  const V normal_velocity = dot(motion.velocity, n);
  History<V> history = loaded_history<Law, Case, V>(place);
  Vec3<V> surface_velocity = motion.velocity;
  if constexpr (Law::has_friction) surface_velocity = add_cross(motion.velocity, motion.spin, n);
  Vec3<V> rolling_velocity{};
  if constexpr (Law::has_rolling) rolling_velocity = cross(n, motion.rolling);

  bool is_done = false;
  ContactForce<V> f;
  if constexpr (takes_impulses<Case>) {
    OverlapRoots<V> at{load<V>(g.repulsion), V{}, V{}};
    if constexpr (Derived<Case>::is_hertz) at.root = load<V>(g.overlap_root), at.fourth = sqrt(at.root);
    f = contact_impulse<Law, Case, mode>(bodies, at, n, surface_velocity, normal_velocity, rolling_velocity, history,
                                         is_done);
  } else {
    SpringBase<V> base{load<V>(g.repulsion), V{}};
    if constexpr (has_sizes<Case>)
      base = spring_base<Law, Case>(max(base.repulsion, V{}), bodies);
    else
      base.root = load<V>(g.overlap_root);
    const Springs<V> k = springs<Law, Case>(base, bodies);
    const auto touching = k.tangential_stiffness > V{};
    V damped_velocity = normal_velocity;
    if constexpr (Case::integrator == Integrator::leapfrog)
      damped_velocity = fused(splat<V>(0.5), dot(side.template kick<W>(owner, partner), n), damped_velocity);
    f = contact_force<Law, Case, mode>(bodies, k, n, surface_velocity, normal_velocity, damped_velocity,
                                       rolling_velocity, touching, history, is_done);
  }
  if (!is_done) return false;

  store_history<Law, Case>(place, history);
  using RowStore = RowLanes<W, Real<Case>>;
  if constexpr (Particles<Case>::motion_width == 8) {
    Vec3<V> torque{};
    if constexpr (Law::has_rolling)
      torque = cross(n, add_scaled(f.force, bodies.owner_lever(), f.rolling.force));  // eqs. (14), (49)
    else if constexpr (Law::has_friction)
      torque = cross(n, f.force);
    RowStore::store_rows(place.row, padded(f.force), padded(torque));
    if constexpr (Side::has_partner_torques)
      RowStore::store_rows(place.partner_torque,
                           padded(cross(n, subtract_scaled(f.force, bodies.partner_lever(), f.rolling.force))));
  } else {
    RowStore::store_rows(place.row, padded(f.force));
  }
  place.book(f);
  return true;
}

/// The same with all lanes computed, out of the way of the short loop.
template <class Case, int W, class Side, class Offset>
[[gnu::noinline]] void sliding_contact_rows(const Side& side, const ContactGeometry<Case, W>& g, const Offset* owner,
                                            const Offset* partner, const InPlace<Case, W>& place) {
  contact_rows<Case, W, SlidingLanes::at_rest>(side, g, owner, partner, moving_bodies<Case, W>(side, owner, partner),
                                               place);
}

}  // namespace detail

}  // namespace fixdem
