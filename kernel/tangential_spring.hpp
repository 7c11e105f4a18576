// Tangential springs: what a contact remembers of them, and how they turn with it and grow; eq. (7).
//
// A spring is kept as its displacement, or for the incremental forms as its scaled force. Each step it is turned into
// the tangent plane without change of length and grows by the displacement of the step. Sliding and rolling have one
// each.
#pragma once

#include "slider.hpp"

namespace fixdem {

/// What a contact remembers.
template <class V>
struct History {
  Vec3<V> spring;                 ///< tangential displacement, or scaled spring force
  V last_tangential_stiffness{};  ///< `rescale` and energy ledger only; zero: none yet
  V last_limit{};                 ///< `exact` only: maximum length of the spring in the last step if it slid, or zero
  Vec3<V> last_velocity{};        ///< `impulse` only: surface velocity in the last step, m/s
  V state_function{};             ///< `impulse` only: of the damping at the end of the last step
  Vec3<V> rolling{};              ///< rolling displacement, or the scaled force of its spring
  V last_rolling_stiffness{};     ///< `impulse` only, where the other last stiffness is kept
};

/// Square of the share out of the tangent plane from which turning counts: it then shortens the kept vector by more
/// than half a unit in the last place.
template <class V>
inline constexpr double turning_square = sizeof(Element<V>) == sizeof(double) ? 0x1p-54 : 0x1p-25;

/// The numbers of a spring at the present overlap; `last_stiffness` becomes the present one where it is kept.
template <class Law, class Case, class V, class Mask>
FIXDEM_INLINE TangentialSpring<V> tangential_spring(const Springs<V>& k, Mask touching, V& last_stiffness) {
  constexpr bool keeps_displacement = Case::tangential == TangentialLaw::displacement;
  TangentialSpring<V> s{k.tangential_stiffness, splat<V>(Case::time_step), splat<V>(1.0), k.damping};
  if constexpr (!keeps_displacement) {
    s.to_force = where(touching, splat<V>(1.0));  // a contact that has opened still holds its last force
    s.gain = constant<V>(Case::time_step) * k.tangential_stiffness;
  }
  if constexpr (Law::tangential_damping != Law::damping)
    s.damping = constant<V>(Law::tangential_damping / Law::damping) * k.damping;
  if constexpr (Case::tangential == TangentialLaw::rescale) {
    const auto unloading = k.tangential_stiffness < last_stiffness;
    s.ratio = select(unloading, k.tangential_stiffness / last_stiffness, s.ratio);
  }
  if constexpr (Law::keeps_stiffness) last_stiffness = k.tangential_stiffness;
  return s;
}

/// Square of the sine of the angle by which a contact may turn in one step before lengths are restored by a root.
inline constexpr double maximum_turn = 1e-4;

/// How a contact_force call deals with lanes that slide: computes them, or reports one and leaves the whole call to be
/// repeated by `at_rest`. In these two no lane may turn by an angle that counts (NearList::is_still), and none is
/// looked at for it, so that a lane has the same bits whichever of them it goes through.
enum class SlidingLanes { computed, reported, at_rest };

/// The kept vector projected on the tangent plane and grown by `gain` times the slip. Projection shortens the kept
/// vector h by the factor sqrt(1 - q), q = (h.n)^2 / h^2; where that is more than half a unit in the last place, its
/// inverse is made up for by a series, good to 3e-17 up to `maximum_turn`, and beyond by a root.
template <class Case, SlidingLanes mode, class V, class Normal>
FIXDEM_INLINE Vec3<V> stuck_spring(const TangentialSpring<V>& s, V gain, const Vec3<V>& kept, const Normal& n,
                                   const Vec3<V>& u, V normal_velocity) {
  const V out_of_plane = dot(kept, n);
  Vec3<V> spring;
  if constexpr (Case::tangential == TangentialLaw::displacement) {
    spring = add_scaled(kept, gain, u);
    spring = subtract_scaled(spring, fused(gain, normal_velocity, out_of_plane), n);
  } else {
    spring = scale(s.ratio, subtract_scaled(kept, out_of_plane, n));
    spring = subtract_scaled(add_scaled(spring, gain, u), gain * normal_velocity, n);
  }
  if constexpr (mode == SlidingLanes::computed) {
    const V turn = out_of_plane * out_of_plane;
    const V counts = constant<V>(turning_square<V>) * dot(spring, spring);
    if (any_below(counts, turn)) {
      const V square = dot(kept, kept);
      const V q = turn / max(square, splat<V>(least_square<V>));
      V longer = q * fused(q, fused(q, splat<V>(0.3125), splat<V>(0.375)), splat<V>(0.5));
      if (const V limit = splat<V>(maximum_turn); any_below(limit, q))
        longer =
            select(limit < q, constant<V>(1) / sqrt(max(constant<V>(1) - q, splat<V>(1e-6))) - constant<V>(1), longer);
      spring = add_scaled(spring, s.ratio * where(counts < turn, longer), subtract_scaled(kept, out_of_plane, n));
    }
  }
  return spring;
}

}  // namespace fixdem
