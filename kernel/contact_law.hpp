// The contact law: forces from overlap, normal and relative motion, as pure functions of lanes.
//
// Serves sphere-sphere and sphere-wall contacts alike; they differ in coefficients only. With n the unit normal from
// the owner to its partner, v_r = v_i - v_j and v_s the slip velocity (eq. 8):
//
//   (6, 18)  f_n = -(K overlap^(3/2) + eta v_r.n) n        eta = eta_0 overlap^(1/4) (eq. 26)
//   (7)      f_t = -(k_t delta_t + eta_t v_s)              k_t = k_t0 overlap^(1/2)  (eqs. 21, 22)
//   (9-12)   |f_t| <= mu |f_n|, or with `friction_limit = "elastic"` mu K overlap^(3/2)
//
// The attraction at the end of a contact is not clipped: clipping changes the restitution. All forces are scaled to
// the change of velocity per step, force * time_step / mass [m/s], so that a particle adds them without a factor.
// `history` is the tangential displacement [m], or for the incremental forms the scaled spring force, kept per
// contact; it is zeroed when the contact opens. Lanes without overlap give exactly zero force.
#pragma once

#include "rolling.hpp"

namespace fixdem {

/// Coefficients of one kind of contact, scaled to velocity change per step.
template <class Case, bool is_wall>
struct ContactLaw {
  using D = Derived<Case>;
  static constexpr double friction = is_wall ? D::wall_friction : Case::friction;
  static constexpr bool has_friction = friction > 0;
  static constexpr double rolling_friction = is_wall ? D::wall_rolling_friction : D::rolling_friction;
  static constexpr bool has_rolling = has_friction && rolling_friction > 0;
  static constexpr double scale = Case::time_step / D::reference_mass;
  static constexpr double bodies = is_wall ? 1 : 2;  ///< equal ones that the force moves (contact_bodies.hpp)
  static constexpr double stiffness = scale * (is_wall ? D::stiffness_wall : D::stiffness_pair);
  static constexpr double tangential_stiffness =
      scale * (is_wall ? D::tangential_stiffness_wall : D::tangential_stiffness_pair);
  static constexpr double damping = scale * (is_wall ? D::damping_wall : D::damping_pair);
  static constexpr double tangential_damping =
      scale * (is_wall ? D::tangential_damping_wall : D::tangential_damping_pair);

  /// Numbers kept per contact and lane, and their places. With friction: the vector of the spring; with `impulse` that
  /// of the last surface velocity; with `rescale` or an energy ledger the last k_t; with `exact` the last limit of the
  /// spring. With `impulse`, friction or not, the last value of the damping's state function. With rolling resistance
  /// the vector of its spring, and with `impulse` its own last k_t, if that is kept.
  static constexpr int history_vectors = !has_friction ? 0 : (takes_impulses<Case> ? 2 : 1);
  static constexpr int state_function_place = 3 * history_vectors;
  static constexpr int stiffness_place = state_function_place + (takes_impulses<Case> ? 1 : 0);
  static constexpr bool keeps_stiffness =
      has_friction && (Case::tangential == TangentialLaw::rescale || Case::energy_ledger);
  static constexpr bool keeps_rolling_stiffness = keeps_stiffness && has_rolling && takes_impulses<Case>;
  static constexpr int limit_place = stiffness_place + (keeps_stiffness ? 1 : 0);
  static constexpr int rolling_place = limit_place + (has_friction && Case::slider == Slider::exact ? 1 : 0);
  static constexpr int history_size = rolling_place + (has_rolling ? 3 : 0) + (keeps_rolling_stiffness ? 1 : 0);
};

template <class Case>
inline constexpr bool keeps_history = ContactLaw<Case, false>::history_size > 0 ||
                                      (Derived<Case>::has_walls && ContactLaw<Case, true>::history_size > 0);

/// Whether a contact that has opened is computed once more: for the rest of its impulse, or to book what its spring
/// held.
template <class Case>
inline constexpr bool looks_back = takes_impulses<Case> || (Case::energy_ledger && Derived<Case>::has_rotation);

/// Scaled force on the owner, and the entries of this step in the ledger (booked_energy.hpp), where the case keeps one.
template <class V>
struct ContactForce {
  Vec3<V> force;
  V damping_power{};  ///< scaled force times velocity
  V sliding_work{};   ///< scaled force times displacement
  V law_work{};       ///< likewise; what the tangential law makes
  RollingStep<V> rolling{};
};

/// A contact step as if all lanes stuck. The whole force is F = -(K overlap^(3/2) n + eta u + k_t delta_t), since
/// u = (u.n) n + v_s and both dampings share eta; where a lane slides, delta_t is where the slider starts.
/// `normal_power`: of the normal damping, for the ledger.
template <class Law, class Case, SlidingLanes mode, class V, class Normal, class Bodies>
FIXDEM_INLINE ContactStep<V> stick([[maybe_unused]] const Bodies& bodies, const Springs<V>& k,
                                   const TangentialSpring<V>& s, const Normal& n, const Vec3<V>& u, V normal_velocity,
                                   V normal_force, [[maybe_unused]] V normal_power, const Vec3<V>& kept) {
  ContactStep<V> step;
  V along_normal = k.repulsion;  // what is left along n after eta u has taken its share
  if constexpr (Law::tangential_damping != Law::damping || Case::integrator != Integrator::euler)
    along_normal = fused_minus(s.damping, normal_velocity, normal_force);
  step.spring = stuck_spring<Case, mode>(s, s.gain, kept, n, u, normal_velocity);
  step.force = subtract_scaled(subtract_scaled(scale(-along_normal, n), s.damping, u), s.to_force, step.spring);
  if constexpr (Case::energy_ledger) {
    const V power = fused(normal_velocity, normal_force, dot(u, step.force));  // of the tangential force
    const V square = fused_minus(normal_velocity, normal_velocity, dot(u, u));
    step.damping_power = fused(s.damping, fused(bodies.count(1.75), power, square), normal_power);
  }
  return step;
}

/// Scaled force on the owner, and the history advanced. `bodies`: ContactBodies. `n`: Vec3, or Vec2 where the normal
/// has no component along the pipe. `surface_velocity` u = v_r + (r w_i + r w_j) x n; `normal_velocity` v_r.n;
/// `damped_velocity`: the normal velocity that the damping sees (the same with `euler`, predicted half a step ahead
/// with `leapfrog`); `rolling_velocity`: eq. (47).
///
/// With `reported`, a batch of which any lane slides sets `is_done` to false, and nothing else of the result
/// counts: without that code and what it needs, the short code keeps its numbers in registers.
template <class Law, class Case, SlidingLanes mode, class V, class Normal, class Mask, class Bodies>
FIXDEM_INLINE ContactForce<V> contact_force(const Bodies& bodies, const Springs<V>& k, const Normal& n,
                                            const Vec3<V>& surface_velocity, V normal_velocity, V damped_velocity,
                                            [[maybe_unused]] const Vec3<V>& rolling_velocity, Mask touching,
                                            History<V>& history, bool& is_done) {
  const Vec3<V>& u = surface_velocity;
  const V normal_force = fused(k.damping, damped_velocity, k.repulsion);  // repulsive positive
  is_done = true;
  // In the middle of the step, as far as this contact changes it.
  [[maybe_unused]] const V mean_velocity = fused_minus(bodies.count(0.5), normal_force, normal_velocity);
  [[maybe_unused]] const V normal_power = k.damping * damped_velocity * mean_velocity;
  if constexpr (!Law::has_friction) {
    return {scale(-normal_force, n), normal_power};
  } else {
    [[maybe_unused]] const LastSpring<V> before =
        last_spring<Case>(history.spring, history.last_tangential_stiffness, k.tangential_stiffness);
    const TangentialSpring<V> s = tangential_spring<Law, Case>(k, touching, history.last_tangential_stiffness);
    ContactStep<V> step =
        stick<Law, Case, mode>(bodies, k, s, n, u, normal_velocity, normal_force, normal_power, history.spring);
    const V excess = excess_over_friction<Law, Case>(step.force, s.to_force, step.spring, normal_force, k.repulsion);
    if constexpr (mode == SlidingLanes::reported) {
      is_done = !any_below(V{}, excess);
    } else if (any_below(V{}, excess)) {  // forces without overlap are zero, and exceed nothing
      const Vec3<V> slip = subtract_scaled(u, normal_velocity, n);
      step = slide<Law, Case>(bodies, step, excess > V{}, s, {slip, slip, slip}, n, normal_force, k.repulsion,
                              normal_power, history.last_limit, before.force);
    }
    V law_work{};
    if constexpr (Case::energy_ledger)
      law_work = work_of_law<Case>(before, step.spring, k.tangential_stiffness, touching);
    history.spring = where(touching, step.spring);
    if constexpr (Case::slider == Slider::exact) history.last_limit = step.last_limit;
    ContactForce<V> f{step.force, step.damping_power, step.sliding_work, law_work};
    if constexpr (Law::has_rolling) {
      const LastSpring<V> rolled = last_spring<Case>(history.rolling, before.stiffness, k.tangential_stiffness);
      f.rolling = roll<Law, Case, mode>(s, s.gain, n, rolling_velocity, bodies, k.repulsion, k.tangential_stiffness,
                                        touching, rolled, step.force, history.rolling, is_done);
      if constexpr (Case::energy_ledger)
        f.damping_power = f.damping_power + damping_by_rolling(bodies, s, step.force, step.spring, f.rolling.force);
    }
    return f;
  }
}

}  // namespace fixdem
