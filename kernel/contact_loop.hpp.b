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

/// What the stages hand on, for W contacts: `way` and `measure`, then the normal and the springs.
template <class Case, int W>
struct ContactGeometry {
  alignas(64) Real<Case> way[3][W];
  alignas(64) Real<Case> measure[W], root[W];
  alignas(64) Real<Case> normal[3][W];
  alignas(64) Real<Case> repulsion[W], overlap_root[W];
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

/// First stage of W contacts: separation and its root.
template <class Case, int W, class Side>
FIXDEM_INLINE void store_separation(const Side& side, const Separation<Lanes<W, Real<Case>>>& separation,
                                    ContactGeometry<Case, W>& g) {
  store(g.way[0], separation.way.x);
  store(g.way[1], separation.way.y);
  if constexpr (!Side::is_flat) store(g.way[2], separation.way.z);
  if constexpr (Side::needs_measure) store(g.measure, separation.measure);
  if constexpr (Side::has_root) store(g.root, side.root(separation.measure));
}

/// Second stage of W contacts: normal, overlap and the first of its springs; eqs. (16), (17), (21), (22), (26).
template <class Case, int W, class Side>
FIXDEM_INLINE void store_geometry(const Side& side, const Real<Case>* limit, ContactGeometry<Case, W>& g,
                                  Lanes<W, Real<Case>>& greatest) {
  using V = Lanes<W, Real<Case>>;
  Separation<V> s{{load<V>(g.way[0]), load<V>(g.way[1]), V{}}, V{}};
  if constexpr (!Side::is_flat) s.way.z = load<V>(g.way[2]);
  if constexpr (Side::needs_measure) s.measure = load<V>(g.measure);
  V root{};
  if constexpr (Side::has_root) root = load<V>(g.root);
  Vec3<V> n;
  const V overlap = side.resolve(s, root, load_any<V>(limit), n);
  const SpringBase<V> base = spring_base<typename Side::Law, Case>(overlap);
  store(g.normal[0], n.x);
  store(g.normal[1], n.y);
  if constexpr (!Side::is_flat) store(g.normal[2], n.z);
  store(g.repulsion, base.repulsion);
  store(g.overlap_root, base.root);
  greatest = max(overlap, greatest);
}

/// Second stage of W contacts: the law, the history and the force rows. False when some lane slides or turns and that
/// is left to be done; then nothing has been written.
template <class Case, int W, SlidingLanes mode, class Side, class Offset>
FIXDEM_INLINE bool contact_rows(const Side& side, const ContactGeometry<Case, W>& g, int lane, const Offset* owner,
                                const Offset* partner, Real<Case> (*kept)[Capacity<Case>::batch], Real<Case>* row,
                                BookedEnergy<Case, W>& energy) {
  using V = Lanes<W, Real<Case>>;
  using Law = typename Side::Law;
  constexpr bool has_friction = Derived<Case>::has_friction;
  const Motion<V> motion = side.template motion<W>(owner, partner);
  std::conditional_t<Side::is_flat, Vec2<V>, Vec3<V>> n{};
  n.x = load<V>(g.normal[0]), n.y = load<V>(g.normal[1]);
  if constexpr (!Side::is_flat) n.z = load<V>(g.normal[2]);
  const Springs<V> k = springs<Law, Case>(SpringBase<V>{load<V>(g.repulsion), load<V>(g.overlap_root)});
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
[[gnu::noinline]] void sliding_contact_rows(const Side& side, const ContactGeometry<Case, W>& g, int lane,
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
void dense_contacts(const Side side, Batches& batches, int first, int count, Real<Case>* rows, Watch<Case>& watch) {
  constexpr int width = Particles<Case>::motion_width, lanes = Capacity<Case>::batch;
  constexpr int size = Side::Law::history_size;
  if (count == 0) return;
  Partials<W, lanes, Real<Case>> overlap(watch.overlap);
  BookedEnergy<Case, W> energy(watch);
  ContactGeometry<Case, W> ring[4];
  const auto *owner = batches.owner[first], *partner = detail::partners_of(batches, first);
  auto* history = detail::history_of<Case, size>(batches, first);
  const int last = (count - 1) / W * W;
  const auto separate = [&](int k, ContactGeometry<Case, W>& g) FIXDEM_INLINE_LAMBDA {
    k = k < last ? k : last;
    detail::store_separation<Case, W>(side, side.template separation<W>(owner + k, partner + k), g);
  };
  const auto resolve = [&](int k, ContactGeometry<Case, W>& g) FIXDEM_INLINE_LAMBDA {
    k = k < last ? k : last;
    detail::store_geometry<Case, W>(side, Side::limits.of(count - k), g, overlap.part[0]);
  };
  separate(0, ring[0]);
  separate(W, ring[1]);
  resolve(0, ring[0]);
  for (int k = 0; k < count; k += lanes, history += size, rows += lanes * width)
    for (int lane = 0; lane < lanes && k + lane < count; lane += W) {
      const auto at = [&](int ahead) FIXDEM_INLINE_LAMBDA -> auto& {
        return ring[static_cast<unsigned>(k + lane + ahead * W) / W % 4];
      };
      resolve(k + lane + W, at(1));
      separate(k + lane + 2 * W, at(2));
      const auto *o = owner + k + lane, *q = partner + k + lane;
      if (!detail::contact_rows<Case, W, SlidingLanes::left>(side, at(0), lane, o, q, history, rows, energy))
        detail::sliding_contact_rows<Case, W>(side, at(0), lane, o, q, history, rows, energy);
    }
  overlap.put_back(watch.overlap);
  energy.put_back(watch);
}

}  // namespace fixdem
