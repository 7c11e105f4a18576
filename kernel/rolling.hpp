// Rolling resistance: a spring and a dashpot on the rolling displacement, capped by its elastic limit; eqs. (47)-(49).
//
//   (47)  w = R* (omega_i - omega_j) x n                     rolling velocity; at a wall r omega x n
//   (48)  q = -(k_t xi + eta w),  |k_t xi| <= mu_r f_el,  |q| <= mu_r f_el
//   (49)  torque R* n x q on the owner, -R* n x q on the partner; no force
//
// k_t and eta are those of sliding, f_el is the elastic part of the normal force (with `impulse` its impulse), and xi
// is kept and turned as the displacement of sliding is (tangential_spring.hpp). The limit is a cap whatever the slider
// of friction is. Equations (47)-(49): the rolling model C of Ai et al. (2011) with the stiffness of Iwashita & Oda.
#pragma once

#include "spring_energy.hpp"
#include "tangential_spring.hpp"

namespace fixdem {

/// What rolling gives in a step.
template <class V>
struct RollingStep {
  Vec3<V> force;  ///< q, scaled, on the owner
  V work{};       ///< for the ledger: scaled force times displacement, taken by dashpot and slider
  V law_work{};   ///< likewise; what the changing stiffness makes
};

/// The rolling force, and its spring advanced. `gain` times w: growth of the spring; `before`: the spring in the last
/// step, `friction`: scaled force of the contact on its owner, both for the ledger. With `reported`, lanes beyond the
/// limit set `is_done` to false.
template <class Law, class Case, SlidingLanes mode, class V, class Normal, class Mask, class Bodies>
FIXDEM_INLINE RollingStep<V> roll(const TangentialSpring<V>& s, V gain, const Normal& n, const Vec3<V>& w,
                                  [[maybe_unused]] const Bodies& bodies, V elastic_force, V stiffness, Mask touching,
                                  const LastSpring<V>& before, [[maybe_unused]] const Vec3<V>& friction, Vec3<V>& kept,
                                  bool& is_done) {
  const V limit = constant<V>(Law::rolling_friction) * elastic_force, limit_square = limit * limit;
  const Vec3<V> trial = stuck_spring<Case, mode>(s, gain, kept, n, w, V{});
  const V square = s.to_force * s.to_force * dot(trial, trial);
  Vec3<V> spring = trial;
  RollingStep<V> step;
  step.force = subtract_scaled(scale(-s.damping, w), s.to_force, spring);
  const V excess = max(dot(step.force, step.force), square) - limit_square;
  if constexpr (mode == SlidingLanes::reported) {
    is_done = is_done & !any_below(V{}, excess);
  } else if (any_below(V{}, excess)) {
    spring = capped(trial, square, limit);
    step.force = subtract_scaled(scale(-s.damping, w), s.to_force, spring);
    step.force = capped(step.force, dot(step.force, step.force), limit);
    if constexpr (Case::energy_ledger) {
      const Vec3<V> slid = {trial.x - spring.x, trial.y - spring.y, trial.z - spring.z};
      const V mean_force = dot(add_scaled(before.force, s.to_force, spring), slid);
      step.work = where(limit_square < square, mean_force * (constant<V>(Case::time_step / 2) / s.gain));
    }
  }
  if constexpr (Case::energy_ledger) {
    // w in the middle of the step, as far as this contact changes it. Friction turns equal spheres alike.
    Vec3<V> mean = add_scaled(w, bodies.half_rolling(), step.force);
    if constexpr (Bodies::rolling_meets_friction) mean = add_scaled(mean, bodies.half_of_both(), friction);
    const Vec3<V> viscous = add_scaled(step.force, s.to_force, spring);
    step.work = fused(splat<V>(-Case::time_step), dot(viscous, mean), step.work);
    step.law_work = work_of_law<Case>(before, spring, stiffness, touching);
  }
  kept = where(touching, spring);
  return step;
}

/// What the rolling force changes of the power that friction's dashpot takes: at a wall, and between unequal spheres,
/// it changes the slip. `spring`: of friction.
template <class V, class Bodies>
FIXDEM_INLINE V damping_by_rolling(const Bodies& bodies, const TangentialSpring<V>& s, const Vec3<V>& friction,
                                   const Vec3<V>& spring, const Vec3<V>& rolling_force) {
  if constexpr (!Bodies::rolling_meets_friction) return V{};
  return -bodies.half_of_both() * dot(add_scaled(friction, s.to_force, spring), rolling_force);
}

}  // namespace fixdem
