// The wall loops: the pipe's inner surface, and the flat ends of a closed pipe.
//
// The same two stages and the same law as for pairs, with the wall's coefficients (eqs. 17, 22) and a partner that
// neither moves nor turns. Overlap with the pipe is q - (R - r), q the distance of the centre from the axis, normal
// outwards; with an end it is r - z or z - (L - r). A particle has one contact of each kind at most.
#pragma once

#include "pair_contacts.hpp"

namespace fixdem {

/// Geometry of one batch of near walls; `Surface` gives overlap and outward normal from positions. `excess`: zero, and
/// far above in lanes that are copies and must stay open.
template <class Case, int W, class Surface, class Offset>
FIXDEM_INLINE void wall_geometry(const Offset* owner, const double* rows, const double* excess, ContactGeometry& g,
                                 ContactWatch<Case, W>& watch) {
  using V = Lanes<W>;
  for (int lane = 0; lane < 8; lane += W) {
    const Vec3<V> position = load_vectors<W>(rows, owner + lane);
    Vec3<V> normal;
    const V overlap = max(Surface::overlap(position, normal) - load_any<V>(excess + lane), V{});
    detail::store_geometry<ContactLaw<Case, true>, Case>(g, lane, normal, overlap);
    watch.overlap.part[lane / W] = max(overlap, watch.overlap.part[lane / W]);
  }
}

template <class Case>
struct PipeSurface {
  template <class V>
  static FIXDEM_INLINE V overlap(const Vec3<V>& position, Vec3<V>& normal) {
    const V q = sqrt(fused(position.y, position.y, position.x * position.x));
    const V inverse = 1.0 / max(q, splat<V>(1e-300));  // on the axis there is no normal, and no contact
    normal = {position.x * inverse, position.y * inverse, V{}};
    return q - (Derived<Case>::pipe_radius - Derived<Case>::radius);
  }
};

template <class Case>
struct EndSurfaces {
  template <class V>
  static FIXDEM_INLINE V overlap(const Vec3<V>& position, Vec3<V>& normal) {
    const auto at_start = position.z < 0.5 * Case::pipe_length;
    normal = {V{}, V{}, select(at_start, splat<V>(-1.0), splat<V>(1.0))};
    return select(at_start, Derived<Case>::radius - position.z,
                  position.z - (Case::pipe_length - Derived<Case>::radius));
  }
};

/// Force rows of the near walls of one kind in one chunk, written from `rows` on.
template <class Case, int W, class Surface, class Walls>
void wall_contacts(Walls& walls, const Particles<Case>& particles, int chunk, double* rows, Watch<Case>& totals) {
  using Law = ContactLaw<Case, true>;
  constexpr int width = Particles<Case>::motion_width;
  const int base = chunk * Capacity<Case>::chunk_size;
  const int count = walls.count[chunk], first = Walls::first(chunk), last = first + batches_for(count);
  static constexpr LanesUpTo excess(0.0, 1e300);
  ContactWatch<Case, W> watch(totals);
  ContactGeometry geometry[batches_per_group];
  for (int group = first; group < last; group += batches_per_group) {
    const int size = last - group < batches_per_group ? last - group : batches_per_group;
    for (int b = 0; b < size; ++b)
      wall_geometry<Case, W, Surface>(walls.owner[group + b], particles.position[base],
                                      excess.of(count - 8 * (group + b - first)), geometry[b], watch);
    for (int b = 0; b < size; ++b, rows += 8 * width) {
      const auto* owner = walls.owner[group + b];
      double(*history)[8] = detail::history_of<Law::history_size>(walls, group + b);
      for (int lane = 0; lane < 8; lane += W) {
        Motion<Lanes<W>> motion{};
        if constexpr (Derived<Case>::has_friction)
          motion = load_motion<W>(particles.motion[base], owner + lane);
        else
          motion.velocity = load_vectors<W>(particles.motion[base], owner + lane);
        Vec3<Lanes<W>> kick{};
        if constexpr (Particles<Case>::predicts) kick = load_vectors<W>(particles.last_kick.row[base], owner + lane);
        detail::contact_rows<Law, Case, W>(geometry[b], lane, motion, kick, history, rows, watch);
      }
    }
  }
  watch.put_back(totals);
}

}  // namespace fixdem
