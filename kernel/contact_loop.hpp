// The contact loop: force rows of the near pairs or near walls of one range, batch by batch.
//
// Two stages over groups of batches, through a buffer in the first-level cache: geometry and roots, then velocities and
// the law. One long chain of dependent operations per batch would leave the core idle; eight independent ones do not.
// What differs between pairs and walls is a `Side` (pair_contacts.hpp, wall_contacts.hpp): it knows the separation of a
// contact, its normal and overlap, and the relative motion.
//
// A row is written for every near contact, zero where nothing touches. Here all lanes are computed, which suits a bed;
// sparse_contacts.hpp serves ranges in which most listed contacts do not touch.
#pragma once

#include "contacts.hpp"
#include "watch.hpp"

namespace fixdem {

inline constexpr int batches_per_group = 8;

/// What a side knows of W contacts before any root: `measure` is the square of a distance, or a difference of squares.
template <class V>
struct Separation {
  Vec3<V> way;
  V measure;
};

/// Separation of W contacts in floats from parts computed in double: part(width, first lane).
template <int W, class Part>
FIXDEM_INLINE Separation<Lanes<W, float>> narrowed(Part&& part) {
  if constexpr (W == 1) {
    const Separation<double> s = part(std::integral_constant<int, 1>{}, 0);
    return {{narrow(s.way.x), narrow(s.way.y), narrow(s.way.z)}, narrow(s.measure)};
  } else {
    const std::integral_constant<int, W / 2> width;
    const Separation<Lanes<W / 2>> a = part(width, 0), b = part(width, W / 2);
    return {{narrow(a.way.x, b.way.x), narrow(a.way.y, b.way.y), narrow(a.way.z, b.way.z)},
            narrow(a.measure, b.measure)};
  }
}

/// What the first stage hands to the second, for one batch.
template <class Case>
struct ContactGeometry {
  static constexpr int batch = Capacity<Case>::batch;
  alignas(64) Real<Case> normal[3][batch];
  alignas(64) Real<Case> repulsion[batch];
  alignas(64) Real<Case> damping[batch];
  alignas(64) Real<Case> tangential_stiffness[batch];
};

/// Limits for a batch in which only the first lanes count: `inside` in those, `outside` in the others.
template <class Case>
struct LanesUpTo {
  static constexpr int batch = Capacity<Case>::batch;
  Real<Case> value[2 * batch];
  constexpr LanesUpTo(double inside, double outside) : value{} {
    for (int k = 0; k < 2 * batch; ++k) value[k] = static_cast<Real<Case>>(k < batch ? inside : outside);
  }
  const Real<Case>* of(int valid) const { return value + (valid < batch ? batch - valid : 0); }
};

/// Energies booked by a contact loop; nothing in a case without ledger. Summed in double always.
template <class Case, int W, bool present = Case::energy_ledger>
struct BookedEnergy {
  static constexpr int lanes = Capacity<Case>::batch, doubles = is_mixed<Case> && W > 1 ? W / 2 : W;
  Partials<doubles, lanes> damping_power, sliding_work;
  FIXDEM_INLINE explicit BookedEnergy(const Watch<Case>& watch)
      : damping_power(watch.ledger.damping_power), sliding_work(watch.ledger.sliding_work) {}
  FIXDEM_INLINE void put_back(Watch<Case>& watch) const {
    damping_power.put_back(watch.ledger.damping_power);
    sliding_work.put_back(watch.ledger.sliding_work);
  }
  template <class V>
  FIXDEM_INLINE void book(int lane, const ContactForce<V>& f) {
    add(damping_power, lane, f.damping_power);
    add(sliding_work, lane, f.sliding_work);
  }

 private:
  template <class V>
  static FIXDEM_INLINE void add(Partials<doubles, lanes>& sums, int lane, V value) {
    if constexpr (is_mixed<Case>) {
      alignas(64) float values[W];
      store(values, value);
      for (int k = 0; k < W; k += doubles)
        sums.part[(lane + k) / doubles] = sums.part[(lane + k) / doubles] + load_wide<doubles>(values + k);
    } else {
      sums.part[lane / W] = sums.part[lane / W] + value;
    }
  }
};
template <class Case, int W>
struct BookedEnergy<Case, W, false> {
  FIXDEM_INLINE explicit BookedEnergy(const Watch<Case>&) {}
  FIXDEM_INLINE void put_back(Watch<Case>&) const {}
  template <class V>
  FIXDEM_INLINE void book(int, const ContactForce<V>&) {}
};

namespace detail {

/// First stage of W contacts: normal, overlap and springs; eqs. (16), (17), (21), (22), (26).
template <class Case, int W, class Side>
FIXDEM_INLINE void store_geometry(const Side& side, const Separation<Lanes<W, Real<Case>>>& separation,
                                  const Real<Case>* limit, int lane, ContactGeometry<Case>& g,
                                  Partials<W, Capacity<Case>::batch, Real<Case>>& greatest) {
  using V = Lanes<W, Real<Case>>;
  Vec3<V> n;
  const V overlap = side.resolve(separation, load_any<V>(limit + lane), n);
  const Springs<V> k = springs<typename Side::Law, Case>(overlap);
  store(g.normal[0] + lane, n.x);
  store(g.normal[1] + lane, n.y);
  if constexpr (!Side::is_flat) store(g.normal[2] + lane, n.z);
  store(g.repulsion + lane, k.repulsion);
  store(g.damping + lane, k.damping);
  store(g.tangential_stiffness + lane, k.tangential_stiffness);
  greatest.part[lane / W] = max(overlap, greatest.part[lane / W]);
}

/// Second stage of W contacts: the law, the history and the force rows. False when some lane slides or turns and that
/// is left to be done; then nothing has been written.
template <class Case, int W, SlidingLanes mode, class Side, class Offset>
FIXDEM_INLINE bool contact_rows(const Side& side, const ContactGeometry<Case>& g, int lane, const Offset* owner,
                                const Offset* partner, Real<Case> (*kept)[Capacity<Case>::batch], Real<Case>* row,
                                BookedEnergy<Case, W>& energy) {
  using V = Lanes<W, Real<Case>>;
  using Law = typename Side::Law;
  constexpr bool has_friction = Derived<Case>::has_friction;
  const Motion<V> motion = side.template motion<W>(owner, partner);
  std::conditional_t<Side::is_flat, Vec2<V>, Vec3<V>> n{};
  n.x = load<V>(g.normal[0] + lane), n.y = load<V>(g.normal[1] + lane);
  if constexpr (!Side::is_flat) n.z = load<V>(g.normal[2] + lane);
  const Springs<V> k = {load<V>(g.repulsion + lane), load<V>(g.damping + lane), load<V>(g.tangential_stiffness + lane)};
  const auto touching = k.tangential_stiffness > V{};

  const V normal_velocity = dot(motion.velocity, n);
  V damped_velocity = normal_velocity;
  if constexpr (Case::integrator == Integrator::leapfrog)
    damped_velocity = fused(splat<V>(0.5), dot(side.template kick<W>(owner, partner), n), damped_velocity);

  History<V> history{};
  Vec3<V> surface_velocity = motion.velocity;
  if constexpr (has_friction) {
    surface_velocity = add_cross(motion.velocity, motion.spin, n);
    history.spring = {load<V>(kept[0] + lane), load<V>(kept[1] + lane), load<V>(kept[2] + lane)};
    if constexpr (Law::history_size == 4) history.last_tangential_stiffness = load<V>(kept[3] + lane);
  }

  bool is_done;
  const ContactForce<V> f = contact_force<Law, Case, mode>(k, n, surface_velocity, normal_velocity, damped_velocity,
                                                           touching, history, is_done);
  if (!is_done) return false;

  using RowStore = RowLanes<W, Real<Case>>;
  if constexpr (has_friction) {
    store(kept[0] + lane, history.spring.x);
    store(kept[1] + lane, history.spring.y);
    store(kept[2] + lane, history.spring.z);
    if constexpr (Law::history_size == 4) store(kept[3] + lane, history.last_tangential_stiffness);
    RowStore::store_rows(row + 8 * lane, f.force, cross(n, f.force));  // eq. (14); scaled by r in motion.hpp
  } else {
    RowStore::store_rows(row + 4 * lane, f.force);
  }
  energy.book(lane, f);
  return true;
}

/// The same with all lanes computed, out of the way of the short loop.
template <class Case, int W, class Side, class Offset>
[[gnu::noinline]] void sliding_contact_rows(const Side& side, const ContactGeometry<Case>& g, int lane,
                                            const Offset* owner, const Offset* partner,
                                            Real<Case> (*kept)[Capacity<Case>::batch], Real<Case>* row,
                                            BookedEnergy<Case, W>& energy) {
  contact_rows<Case, W, SlidingLanes::computed>(side, g, lane, owner, partner, kept, row, energy);
}

/// History block of a batch, or nothing where the case keeps none.
template <class Case, int Size, class Batches>
FIXDEM_INLINE auto history_of(Batches& batches, int batch) {
  if constexpr (Size > 0) {
    return batches.history.value[batch];
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

/// Force rows of `count` contacts in the batches from `first` on, written from `rows` on; all lanes are computed.
template <class Case, int W, class Side, class Batches>
void dense_contacts(const Side& side, Batches& batches, int first, int count, Real<Case>* rows, Watch<Case>& watch) {
  constexpr int width = Particles<Case>::motion_width, lanes = Capacity<Case>::batch;
  const int last = first + batches_for<Case>(count);
  Partials<W, lanes, Real<Case>> overlap(watch.overlap);
  BookedEnergy<Case, W> energy(watch);
  ContactGeometry<Case> geometry[batches_per_group];
  for (int group = first; group < last; group += batches_per_group) {
    const int size = last - group < batches_per_group ? last - group : batches_per_group;
    for (int b = 0; b < size; ++b) {
      const auto *owner = batches.owner[group + b], *partner = detail::partners_of(batches, group + b);
      const Real<Case>* limit = Side::limits.of(count - lanes * (group + b - first));
      for (int lane = 0; lane < lanes; lane += W)
        detail::store_geometry<Case, W>(side, side.template separation<W>(owner + lane, partner + lane), limit, lane,
                                        geometry[b], overlap);
    }
    for (int b = 0; b < size; ++b, rows += lanes * width) {
      const auto *owner = batches.owner[group + b], *partner = detail::partners_of(batches, group + b);
      auto* history = detail::history_of<Case, Side::Law::history_size>(batches, group + b);
      for (int lane = 0; lane < lanes; lane += W)
        if (!detail::contact_rows<Case, W, SlidingLanes::left>(side, geometry[b], lane, owner + lane, partner + lane,
                                                               history, rows, energy))
          detail::sliding_contact_rows<Case, W>(side, geometry[b], lane, owner + lane, partner + lane, history, rows,
                                                energy);
    }
  }
  overlap.put_back(watch.overlap);
  energy.put_back(watch);
}

}  // namespace fixdem
