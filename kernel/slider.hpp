// Coulomb's slider: what a contact gives where its tangential force, or its spring, would exceed the limit of eq. (9).
//
// `clip` caps the spring, then the total; `exact` turns the spring by the solution of its motion (exact_slider.hpp);
// `paper` is eqs. (10)-(12) to the letter. The limit is mu |f_n|, or with `friction_limit = "elastic"` mu times the
// elastic part of f_n. Serves forces (contact_law.hpp) and impulses (impulse_law.hpp) alike; scaled as there.
#pragma once

#include "exact_slider.hpp"
#include "springs.hpp"

namespace fixdem {

/// Caps the vector at the given length where it is longer. `square` is its squared length.
template <class V>
FIXDEM_INLINE Vec3<V> capped(const Vec3<V>& a, V square, V limit) {
  return select(square > limit * limit, scale(limit / sqrt(square), a), a);
}

/// The numbers of a tangential spring at one step: `to_force` times history is the scaled spring force, `gain` times
/// slip is the growth of the history, `ratio` its shrinking beforehand (`rescale`), `damping` eta_t.
template <class V>
struct TangentialSpring {
  V to_force, gain, ratio, damping;
};

/// Slip of a contact, m/s: what has loaded its spring, what the damping sees, and the present one. They differ with
/// impulses only.
template <class V>
struct Slip {
  Vec3<V> load, damped, present;
};

/// What a contact gives in a step: as if it stuck (stick), then with the lanes replaced that slide (slide).
template <class V>
struct ContactStep {
  Vec3<V> force;                      ///< scaled, on the owner
  Vec3<V> spring;                     ///< the kept vector, turned into the tangent plane and loaded by the slip
  V damping_power{}, sliding_work{};  ///< for the ledger
  V last_limit{};                     ///< `exact` only
};

/// The tangential force of eqs. (7)-(12) where the slider acts; of the result only that counts, and the spring it
/// leaves. `limit`: mu |f_n|; `last_limit`, `last_force`: of the spring in the last step.
template <class Case, class V, class Bodies>
FIXDEM_INLINE ContactStep<V> slider([[maybe_unused]] const Bodies& bodies, const TangentialSpring<V>& s,
                                    const Vec3<V>& trial, const Slip<V>& slip, V limit, [[maybe_unused]] V last_limit,
                                    [[maybe_unused]] const Vec3<V>& last_force) {
  ContactStep<V> t{};
  if constexpr (Case::slider != Slider::paper) {
    if constexpr (Case::slider == Slider::exact) {
      const auto slides = s.to_force * s.to_force * dot(trial, trial) > limit * limit;
      const Vec3<V> growth = scale(s.gain, slip.load),
                    kept = {trial.x - growth.x, trial.y - growth.y, trial.z - growth.z};
      const SlidSpring<V> slid =
          exact_return<Case::tangential != TangentialLaw::rescale>(kept, growth, last_limit, limit, s.to_force, slides);
      t.spring = select(slides, slid.spring, trial);
      t.last_limit = where(slides, slid.limit);
    } else {
      t.spring = capped(trial, s.to_force * s.to_force * dot(trial, trial), limit);
    }
    const Vec3<V> total = add_scaled(scale(-s.damping, slip.damped), -s.to_force, t.spring);
    t.force = capped(total, dot(total, total), limit);
  } else {
    const Vec3<V> total = add_scaled(scale(-s.damping, slip.damped), -s.to_force, trial);
    const V square = dot(total, total), slip_square = dot(slip.damped, slip.damped);
    const auto sliding = square > limit * limit;
    const Vec3<V> along_slip = scale(-limit / sqrt(slip_square), slip.damped);
    const Vec3<V> along_trial = scale(limit / sqrt(square), total);
    t.force = select(sliding, select(slip_square > V{}, along_slip, along_trial), total);
    t.spring = select(sliding, scale(constant<V>(-1.0) / s.to_force, t.force), trial);
  }
  if constexpr (Case::energy_ledger) {
    const Vec3<V> viscous = add_scaled(t.force, s.to_force, t.spring);  // what is not the spring's
    t.damping_power = -dot(viscous, add_scaled(slip.present, bodies.count(1.75), t.force));
    const Vec3<V> slid = {trial.x - t.spring.x, trial.y - t.spring.y, trial.z - t.spring.z};
    t.sliding_work = dot(add_scaled(last_force, s.to_force, t.spring), slid) *
                     (constant<V>(Case::time_step / 2) / s.gain);  // mean of both forces times displacement
  }
  return t;
}

/// Coulomb's limit: mu |f_n|, or mu times the elastic part of f_n.
template <class Law, class Case, class V>
FIXDEM_INLINE V friction_limit(V normal_force, V elastic_force) {
  constexpr bool is_elastic = Derived<Case>::friction_limit == FrictionLimit::elastic;
  return constant<V>(Law::friction) * (is_elastic ? elastic_force : abs(normal_force));
}

/// A contact step with the lanes replaced that slide. `stuck`: of all lanes as if they stuck; `normal_power`: of the
/// normal damping, for the ledger.
template <class Law, class Case, class V, class Normal, class Mask, class Bodies>
FIXDEM_INLINE ContactStep<V> slide(const Bodies& bodies, ContactStep<V> stuck, Mask slides,
                                   const TangentialSpring<V>& s, const Slip<V>& slip, const Normal& n, V normal_force,
                                   V elastic_force, V normal_power, V last_limit, const Vec3<V>& last_force) {
  const ContactStep<V> slid = slider<Case>(
      bodies, s, stuck.spring, slip, friction_limit<Law, Case>(normal_force, elastic_force), last_limit, last_force);
  stuck.force = select(slides, subtract_scaled(slid.force, normal_force, n), stuck.force);
  stuck.spring = select(slides, slid.spring, stuck.spring);
  if constexpr (Case::slider == Slider::exact) stuck.last_limit = where(slides, slid.last_limit);
  if constexpr (Case::energy_ledger) {
    stuck.damping_power = select(slides, normal_power + slid.damping_power, stuck.damping_power);
    stuck.sliding_work = where(slides, slid.sliding_work);
  }
  return stuck;
}

/// Above zero where the whole force, or the spring alone, is beyond Coulomb's bound. With the limit of the paper the
/// sign is exact. With the elastic one F^2 - f_n^2 cancels: in floats a tangential force below 3.5e-4 |f_n| may pass as
/// sticking.
template <class Law, class Case, class V>
FIXDEM_INLINE V excess_over_friction(const Vec3<V>& force, V to_force, const Vec3<V>& spring, V normal_force,
                                     [[maybe_unused]] V elastic_force) {
  constexpr double mu_square = Law::friction * Law::friction;
  const V normal_square = normal_force * normal_force;
  if constexpr (Derived<Case>::friction_limit == FrictionLimit::elastic) {
    const V limit_square = constant<V>(mu_square) * elastic_force * elastic_force;
    return max(dot(force, force) - normal_square, to_force * to_force * dot(spring, spring)) - limit_square;
  }
  return max(dot(force, force) - constant<V>(1 + mu_square) * normal_square,
             to_force * to_force * dot(spring, spring) - constant<V>(mu_square) * normal_square);
}

}  // namespace fixdem
