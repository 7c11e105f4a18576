// The pair loop: force rows of the contacts of one range of near pairs.
//
// Two stages over groups of batches, through a buffer in the first-level cache: geometry and roots, then velocities and
// the law. One long chain of dependent operations per batch would leave the core idle; eight independent ones do not.
// Rows are written for every near pair, zero where nothing touches. In a sparse chunk (most listed pairs do not touch)
// a batch without any overlap skips roots and law; in a bed that test would only cost, so the near list decides.
#pragma once

#include "contacts.hpp"
#include "watch.hpp"

namespace fixdem {

inline constexpr int batches_per_group = 8;

/// Eight values for a batch in which only the first lanes count: `inside` in those, `outside` in the others.
struct LanesUpTo {
  double value[16];
  constexpr LanesUpTo(double inside, double outside) : value{} {
    for (int k = 0; k < 16; ++k) value[k] = k < 8 ? inside : outside;
  }
  const double* of(int valid) const { return value + (valid < 8 ? 8 - valid : 0); }
};

/// What the first stage hands to the second, for one batch.
struct ContactGeometry {
  alignas(64) double normal[3][8];
  alignas(64) double repulsion[8];
  alignas(64) double damping[8];
  alignas(64) double tangential_stiffness[8];
};

/// Partial values of the watch that the contact loops keep in registers.
template <class Case, int W>
struct ContactWatch {
  Partials<W> overlap;
  FIXDEM_INLINE explicit ContactWatch(const Watch<Case>& watch) : overlap(watch.overlap) {}
  FIXDEM_INLINE void put_back(Watch<Case>& watch) const { overlap.put_back(watch.overlap); }
};
template <class Case, int W>
requires(Case::energy_ledger) struct ContactWatch<Case, W> {
  Partials<W> overlap, damping_power, sliding_work;
  FIXDEM_INLINE explicit ContactWatch(const Watch<Case>& watch)
      : overlap(watch.overlap), damping_power(watch.ledger.damping_power), sliding_work(watch.ledger.sliding_work) {}
  FIXDEM_INLINE void put_back(Watch<Case>& watch) const {
    overlap.put_back(watch.overlap);
    damping_power.put_back(watch.ledger.damping_power);
    sliding_work.put_back(watch.ledger.sliding_work);
  }
};

namespace detail {

template <class Law, class Case, class V>
FIXDEM_INLINE void store_geometry(ContactGeometry& g, int lane, const Vec3<V>& n, V overlap) {
  const Springs<V> k = springs<Law, Case>(overlap);
  store(g.normal[0] + lane, n.x);
  store(g.normal[1] + lane, n.y);
  store(g.normal[2] + lane, n.z);
  store(g.repulsion + lane, k.repulsion);
  store(g.damping + lane, k.damping);
  store(g.tangential_stiffness + lane, k.tangential_stiffness);
}

/// Second stage, common to pairs and walls: the law, the history and the force row. `motion`: velocity of the owner
/// relative to its partner and sum of the spins; `kick`: the same difference of the last velocity change (leapfrog).
template <class Law, class Case, int W>
FIXDEM_INLINE void contact_rows(const ContactGeometry& g, int lane, const Motion<Lanes<W>>& motion,
                                const Vec3<Lanes<W>>& kick, double (*kept)[8], double* row,
                                ContactWatch<Case, W>& watch) {
  using V = Lanes<W>;
  constexpr bool has_friction = Derived<Case>::has_friction;
  const Vec3<V> n = {load<V>(g.normal[0] + lane), load<V>(g.normal[1] + lane), load<V>(g.normal[2] + lane)};
  const Springs<V> k = {load<V>(g.repulsion + lane), load<V>(g.damping + lane), load<V>(g.tangential_stiffness + lane)};
  const auto touching = k.tangential_stiffness > 0.0;

  const V normal_velocity = dot(motion.velocity, n);
  V damped_velocity = normal_velocity;
  if constexpr (Case::integrator == Integrator::leapfrog)
    damped_velocity = fused(splat<V>(0.5), dot(kick, n), damped_velocity);

  History<V> history{};
  Vec3<V> surface_velocity = motion.velocity;
  if constexpr (has_friction) {
    surface_velocity = add_cross(motion.velocity, motion.spin, n);
    history.spring = {load<V>(kept[0] + lane), load<V>(kept[1] + lane), load<V>(kept[2] + lane)};
    if constexpr (Law::history_size == 4) history.last_tangential_stiffness = load<V>(kept[3] + lane);
  }

  const ContactForce<V> f =
      contact_force<Law, Case>(k, n, surface_velocity, normal_velocity, damped_velocity, touching, history);

  if constexpr (has_friction) {
    store(kept[0] + lane, history.spring.x);
    store(kept[1] + lane, history.spring.y);
    store(kept[2] + lane, history.spring.z);
    if constexpr (Law::history_size == 4) store(kept[3] + lane, history.last_tangential_stiffness);
    RowLanes<W>::store_rows(row + 8 * lane, f.force, cross(n, f.force));  // eq. (14); scaled by r in motion.hpp
  } else {
    RowLanes<W>::store_rows(row + 4 * lane, f.force);
  }
  if constexpr (Case::energy_ledger) {
    V &damping = watch.damping_power.part[lane / W], &sliding = watch.sliding_work.part[lane / W];
    damping = damping + f.damping_power;
    sliding = sliding + f.sliding_work;
  }
}

/// What a batch without contact leaves: no force, no history.
template <int Size, int Width, int W>
FIXDEM_INLINE void open_rows(double (*kept)[8], double* row) {
  for (int k = 0; k < 8 * Width; k += W) store(row + k, Lanes<W>{});
  for (int c = 0; c < Size; ++c)
    for (int lane = 0; lane < 8; lane += W) store(kept[c] + lane, Lanes<W>{});
}

/// History block of a batch, or nothing where the case keeps none.
template <int Size, class Batches>
FIXDEM_INLINE auto history_of(Batches& batches, int batch) {
  if constexpr (Size > 0) {
    return batches.history.value[batch];
  } else {
    return static_cast<double(*)[8]>(nullptr);
  }
}

}  // namespace detail

/// Overlap, normal and springs of one batch of pairs; eqs. (16), (21), (26). `reach`: the diameter in each lane, far
/// below zero in lanes that are copies and must stay open. With `sparse`, returns false when nothing overlaps, and
/// computes no roots then.
template <class Case, int W, bool sparse, class Offset>
FIXDEM_INLINE bool pair_geometry(const Offset* owner, const Offset* partner, const double* owner_rows,
                                 const double* partner_rows, double shift, const double* reach, ContactGeometry& g,
                                 ContactWatch<Case, W>& watch) {
  using V = Lanes<W>;
  Vec3<V> r[8 / W];
  V square[8 / W];
  bool touches = !sparse;
  for (int p = 0; p < 8 / W; ++p) {
    r[p] = load_differences<W>(partner_rows, partner + p * W, owner_rows, owner + p * W);
    r[p].z = r[p].z + shift;
    square[p] = dot(r[p], r[p]);
    if constexpr (sparse) touches = touches | any(square[p] < Case::diameter * Case::diameter);
  }
  if (!touches) return false;
  for (int p = 0; p < 8 / W; ++p) {
    const V distance = sqrt(square[p]);
    const V inverse = 1.0 / distance;
    const V overlap = max(load_any<V>(reach + p * W) - distance, V{});
    detail::store_geometry<ContactLaw<Case, false>, Case>(g, p * W, scale(inverse, r[p]), overlap);
    watch.overlap.part[p] = max(overlap, watch.overlap.part[p]);
  }
  return true;
}

/// Force rows of range `range` of the near pairs, written from `rows` on.
template <class Case, int W, bool sparse>
void pair_contacts(PairBatches<Case>& pairs, const Particles<Case>& particles, int range, double* rows,
                   Watch<Case>& totals) {
  constexpr int width = Contacts<Case>::row_width;
  using Law = ContactLaw<Case, false>;
  const PairRange<Case> at(range);
  const double *owner_position = particles.position[at.owner_base], *owner_motion = particles.motion[at.owner_base];
  const double *partner_position = particles.position[at.partner_base],
               *partner_motion = particles.motion[at.partner_base];
  const int count = pairs.count[range], first = PairBatches<Case>::first(range), last = first + batches_for(count);

  static constexpr LanesUpTo reach(Case::diameter, -1e300);
  ContactWatch<Case, W> watch(totals);
  ContactGeometry geometry[batches_per_group];
  bool touches[batches_per_group];
  for (int group = first; group < last; group += batches_per_group) {
    const int size = last - group < batches_per_group ? last - group : batches_per_group;
    for (int b = 0; b < size; ++b)
      touches[b] = pair_geometry<Case, W, sparse>(pairs.owner[group + b], pairs.partner[group + b], owner_position,
                                                  partner_position, at.shift, reach.of(count - 8 * (group + b - first)),
                                                  geometry[b], watch);
    for (int b = 0; b < size; ++b, rows += 8 * width) {
      const auto *owner = pairs.owner[group + b], *partner = pairs.partner[group + b];
      double(*history)[8] = detail::history_of<Law::history_size>(pairs, group + b);
      if (sparse && !touches[b]) {
        detail::open_rows<Law::history_size, width, W>(history, rows);
        continue;
      }
      for (int lane = 0; lane < 8; lane += W) {
        Motion<Lanes<W>> motion{};
        if constexpr (Derived<Case>::has_friction)
          motion = load_motion_of_pairs<W>(owner_motion, owner + lane, partner_motion, partner + lane);
        else
          motion.velocity = load_differences<W>(owner_motion, owner + lane, partner_motion, partner + lane);
        Vec3<Lanes<W>> kick{};
        if constexpr (Particles<Case>::predicts)
          kick = load_differences<W>(particles.last_kick.row[at.owner_base], owner + lane,
                                     particles.last_kick.row[at.partner_base], partner + lane);
        detail::contact_rows<Law, Case, W>(geometry[b], lane, motion, kick, history, rows, watch);
      }
    }
  }
  watch.put_back(totals);
}

}  // namespace fixdem
