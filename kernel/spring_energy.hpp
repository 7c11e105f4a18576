// What a tangential law makes or loses, for the energy ledger.
//
// A spring whose stiffness follows the overlap is not conservative: its energy s^2 / (2 k_t) changes with k_t while no
// force does any work. Over one step, with the force s = k_t h and a dash for the step before, the law makes
//   (k_t - k_t') h.h' / 2              where it keeps the displacement h (`displacement`, and `rescale` in unloading)
//   (1/k_t - 1/k_t') s'^2 / 2          where it keeps the force (`force`, and `rescale` in loading)
// and a contact that opens loses what its spring still held. This is exactly the change of energy less the work
// (s + s').w / 2 of the slip w, plus what sliding takes (booked_energy.hpp). Forces are scaled as in contact_law.hpp.
#pragma once

#include "case.hpp"
#include "lanes.hpp"

namespace fixdem {

/// What the ledger has to know of a spring before the slider acts: its stiffness and its force in the last step.
template <class V>
struct LastSpring {
  V stiffness;
  Vec3<V> kept, force;
};

template <class Case, class V>
FIXDEM_INLINE LastSpring<V> last_spring(const Vec3<V>& kept, V last_stiffness, V stiffness) {
  LastSpring<V> before{select(last_stiffness > V{}, last_stiffness, stiffness), kept, kept};
  if constexpr (Case::tangential == TangentialLaw::displacement) before.force = scale(before.stiffness, kept);
  return before;
}

/// Scaled force times displacement. `spring`: what the law keeps now.
template <class Case, class V, class Mask>
FIXDEM_INLINE V work_of_law(const LastSpring<V>& before, const Vec3<V>& spring, V stiffness, Mask touching) {
  const V half = splat<V>(0.5);
  if constexpr (Case::tangential == TangentialLaw::displacement) {
    const V square = dot(before.kept, before.kept);
    return half * (stiffness - before.stiffness) * select(touching, dot(spring, before.kept), square);
  } else {
    const V one = splat<V>(1);
    const V last = one / select(before.stiffness > V{}, before.stiffness, one);
    const V present = one / select(touching, stiffness, one), square = dot(before.force, before.force);
    V work = half * square * (present - last);
    if constexpr (Case::tangential == TangentialLaw::rescale)
      work = select(stiffness < before.stiffness, half * dot(spring, before.force) * (last - present), work);
    return select(touching, work, -half * square * last);
  }
}

}  // namespace fixdem
