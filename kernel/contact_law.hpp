// The contact law: forces from overlap, normal and relative motion, as pure functions of lanes.
//
// Serves sphere-sphere and sphere-wall contacts alike; they differ in coefficients only. With n the unit normal from
// the owner to its partner, v_r = v_i - v_j and v_s the slip velocity (eq. 8):
//
//   (6, 18)  f_n = -(K overlap^(3/2) + eta v_r.n) n        eta = eta_0 overlap^(1/4) (eq. 26)
//   (7)      f_t = -(k_t delta_t + eta_t v_s)              k_t = k_t0 overlap^(1/2)  (eqs. 21, 22)
//   (9-12)   |f_t| <= mu |f_n|
//
// The attraction at the end of a contact is not clipped: clipping changes the restitution. All forces are scaled to
// the change of velocity per step, force * time_step / mass [m/s], so that a particle adds them without a factor.
// `history` is the tangential displacement [m], or for the incremental forms the scaled spring force, kept per
// contact; it is zeroed when the contact opens. Lanes without overlap give exactly zero force.
#pragma once

#include "case.hpp"
#include "lanes.hpp"

namespace fixdem {

/// Coefficients of one kind of contact, scaled to velocity change per step.
template <class Case, bool is_wall>
struct ContactLaw {
  using D = Derived<Case>;
  static constexpr double scale = Case::time_step / D::mass;
  static constexpr double stiffness = scale * (is_wall ? D::stiffness_wall : D::stiffness_pair);
  static constexpr double tangential_stiffness =
      scale * (is_wall ? D::tangential_stiffness_wall : D::tangential_stiffness_pair);
  static constexpr double damping = scale * (is_wall ? D::damping_wall : D::damping_pair);
  static constexpr double tangential_damping =
      scale * (is_wall ? D::tangential_damping_wall : D::tangential_damping_pair);

  /// Numbers kept per contact and lane: none without friction; the vector; with `rescale` also the last k_t.
  static constexpr int history_size = !D::has_friction ? 0 : (Case::tangential == TangentialLaw::rescale ? 4 : 3);
};

/// Stiffness and damping of a contact at its present overlap.
template <class V>
struct Springs {
  V repulsion;             ///< K overlap^(3/2), scaled
  V damping;               ///< eta, scaled
  V tangential_stiffness;  ///< k_t, scaled
};

/// What a contact remembers.
template <class V>
struct History {
  Vec3<V> spring;                ///< tangential displacement, or scaled spring force
  V last_tangential_stiffness{};  ///< `rescale` only
};

/// Scaled force on the owner, and what it dissipated in this step (only computed when the case keeps a ledger).
template <class V>
struct ContactForce {
  Vec3<V> force;
  V damping_power{};  ///< scaled force times velocity
  V sliding_work{};   ///< scaled force times displacement
};

/// Stiffness and damping from the overlap [m]; zero where there is none.
template <class Law, class Case, class V>
FIXDEM_INLINE Springs<V> springs(V overlap) {
  if constexpr (Derived<Case>::is_hertz) {
    const V root = sqrt(overlap);
    return {Law::stiffness * overlap * root, Law::damping * sqrt(root), Law::tangential_stiffness * root};
  } else {
    const auto touching = overlap > 0.0;
    return {Law::stiffness * overlap, keep(touching, splat<V>(Law::damping)),
            keep(touching, splat<V>(Law::tangential_stiffness))};
  }
}

/// Turns the kept vector into the present tangent plane: projected, and rescaled to its old length.
template <class V>
FIXDEM_INLINE Vec3<V> turn_to_tangent_plane(const Vec3<V>& kept, const Vec3<V>& n) {
  const V out_of_plane = dot(kept, n);
  Vec3<V> turned = add_scaled(kept, -out_of_plane, n);
  const V old_square = dot(kept, kept);
  // Below half a unit in the last place of the length there is nothing to restore: always so in a bed at rest.
  const auto shortened = out_of_plane * out_of_plane > 0x1p-54 * old_square;
  if (any(shortened)) {
    const V new_square = dot(turned, turned);
    const V factor = select(new_square > 0.0, sqrt(old_square / new_square), V{});
    turned = select(shortened, scale(factor, turned), turned);
  }
  return turned;
}

/// Caps the vector at the given length where it is longer. `square` is its squared length.
template <class V>
FIXDEM_INLINE Vec3<V> capped(const Vec3<V>& a, V square, V limit) {
  const auto longer = square > limit * limit;
  if (!any(longer)) return a;
  return select(longer, scale(limit / sqrt(square), a), a);
}

/// Tangential force of eqs. (7)-(12) with history; see the head of this file.
/// n: unit normal, slip: v_s [m/s], normal_force: scaled f_n, positive or negative. `touching` masks real contacts.
template <class Law, class Case, class V, class Mask>
FIXDEM_INLINE Vec3<V> tangential_force(const Springs<V>& k, const Vec3<V>& n, const Vec3<V>& slip, V normal_force, Mask touching,
                         History<V>& history, ContactForce<V>& ledger) {
  constexpr bool keeps_displacement = Case::tangential == TangentialLaw::displacement;
  const V limit = Case::friction * abs(normal_force);
  V eta = k.damping;  // eq. (31)
  if constexpr (Law::tangential_damping != Law::damping) eta = (Law::tangential_damping / Law::damping) * k.damping;

  // Spring: displacement times the present stiffness, or the kept force and its increment.
  Vec3<V> kept = turn_to_tangent_plane(history.spring, n);
  if constexpr (Case::tangential == TangentialLaw::rescale) {
    const auto unloading = k.tangential_stiffness < history.last_tangential_stiffness;
    const V ratio = k.tangential_stiffness / history.last_tangential_stiffness;
    kept = select(unloading, scale(ratio, kept), kept);
    history.last_tangential_stiffness = k.tangential_stiffness;
  }
  const V gain = keeps_displacement ? splat<V>(Case::time_step) : Case::time_step * k.tangential_stiffness;
  const Vec3<V> trial = add_scaled(kept, gain, slip);
  const V to_force = keeps_displacement ? k.tangential_stiffness : splat<V>(1.0);

  // Slider.
  Vec3<V> spring = trial, force;
  if constexpr (Case::slider == Slider::clip) {
    const V spring_square = to_force * to_force * dot(trial, trial);
    spring = capped(trial, spring_square, limit);
    const Vec3<V> total = add_scaled(scale(-eta, slip), -to_force, spring);
    force = capped(total, dot(total, total), limit);
  } else {
    force = add_scaled(scale(-eta, slip), -to_force, trial);
    const V square = dot(force, force);
    const auto sliding = square > limit * limit;
    if (any(sliding)) {
      const V slip_square = dot(slip, slip);
      const Vec3<V> along_slip = scale(-limit / sqrt(slip_square), slip);
      const Vec3<V> along_trial = scale(limit / sqrt(square), force);
      force = select(sliding, select(slip_square > 0.0, along_slip, along_trial), force);
      spring = select(sliding, scale(-1.0 / to_force, force), spring);
    }
  }
  history.spring = {keep(touching, spring.x), keep(touching, spring.y), keep(touching, spring.z)};

  if constexpr (Case::energy_ledger) {
    const Vec3<V> viscous = add_scaled(force, to_force, spring);  // what is not the spring's
    ledger.damping_power = ledger.damping_power - dot(viscous, slip);
    const Vec3<V> slid = {trial.x - spring.x, trial.y - spring.y, trial.z - spring.z};
    const V work = dot(spring, slid) * to_force;
    ledger.sliding_work = keep(touching, keeps_displacement ? work : work / k.tangential_stiffness);
  }
  return force;
}

/// Scaled force on the owner. `surface_velocity`: v_r + (r w_i + r w_j) x n; `damped_velocity`: the normal velocity that
/// the damping sees (v_r.n itself with `euler`, predicted half a step ahead with `leapfrog`).
template <class Law, class Case, class V, class Mask>
FIXDEM_INLINE ContactForce<V> contact_force(const Springs<V>& k, const Vec3<V>& n, const Vec3<V>& surface_velocity, V normal_velocity,
                              V damped_velocity, Mask touching, History<V>& history) {
  ContactForce<V> result;
  const V normal_force = -fused(k.damping, damped_velocity, k.repulsion);
  result.force = scale(normal_force, n);
  if constexpr (Case::energy_ledger) result.damping_power = k.damping * damped_velocity * normal_velocity;
  if constexpr (Derived<Case>::has_friction) {
    const Vec3<V> slip = add_scaled(surface_velocity, -normal_velocity, n);
    const Vec3<V> tangential =
        tangential_force<Law, Case>(k, n, slip, normal_force, touching, history, result);
    result.force = {result.force.x + tangential.x, result.force.y + tangential.y, result.force.z + tangential.z};
  }
  return result;
}

}  // namespace fixdem
