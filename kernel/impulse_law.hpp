// The contact law of `integrator = "impulse"`: what a contact adds to the velocities over a whole step, seen once.
//
// Positions are held half a step ahead, so what is seen at overlap d counts from h = time_step / 2 before to h after.
// Force times step would be of second order, but for the kinks of overlap^(1/4) and overlap^(3/2) where a contact
// begins and ends: they leave the rebound of every integrator an order of 5/4. Therefore:
//
// Elastic impulse: the integral of K overlap^(3/2) along two straight half steps, from d - h v to d with the present
// normal velocity v, and from d to d + h v' with that after the step, v'.
//
// Damping impulse: G(after) - G(before) with G = (4/5) eta_0 overlap^(5/4), the integral of eta over the overlap. The
// contact keeps G(after), so over its life the sum is exactly zero, as it must be. `after` is
// d + h v + 0.4 (1 - y/10) (v' - v) time_step, y = (3/2) K d^(1/2) time_step^2 / M. With 0.5 for 0.4 the energy taken,
// a trapezoidal sum of velocity over G, is off by a term of second order; 0.4 removes nearly all of that for e from 0.1
// to 1, and y/10 most of the next one at e = 0.9 (found by experiment; tests/impulse_test.cpp has the errors left).
//
// Tangential spring: k_t sinc^2(w h) with w^2 = 3.5 k_t/m at a wall and 7 k_t/m between spheres, so that the leapfrog's
// frequency is the spring's own. Tangential damping: the mean of eta along the half steps, the second one to `after`,
// times the slip velocity in the middle of the step, extrapolated from this step and the last. Slider: the bound is mu
// times the whole normal impulse.
//
// v' is that of the contact alone: (v + v')/2 = v - (repulsion + eta (v + v')/2) h / M. What other contacts do
// meanwhile changes d by their acceleration times time_step^2 / 2: of second order, as straight lines are.
//
// A contact that has begun since the last step also gets the impulse since then, from overlap zero, and its spring the
// slip since then; one that has ended gets the rest of its last half step and gives back its G. A contact that was
// there before the first step (`found_at_start`) begins at G of its overlap then, and its spring, given for that time,
// grows for half a step.
#pragma once

#include "impulse_means.hpp"

namespace fixdem {

/// Kept in place of the state function by contacts that have not been looked at yet; less than any true value.
inline constexpr double found_at_start = -1;

/// A normal impulse, scaled as forces are, and what else depends on the path along the normal.
template <class V>
struct NormalImpulse {
  V total, damping;      ///< along -n
  V tangential_damping;  ///< mean of eta (of the normal law)
  V share_of_step;       ///< during which the spring grows
  V state_function;      ///< G, without its factor (4/5) eta_0
};

/// The normal impulse. `velocity`: v, growth of the overlap; `last`: state function of the last step; `pressed`: lanes
/// with overlap, `touching`: those and the ones that had some. With `reported`, lanes that need the closed forms set
/// `is_done` to false, and nothing else counts.
template <class Law, class Case, SlidingLanes mode, class V, class Mask, class Bodies>
FIXDEM_INLINE NormalImpulse<V> normal_impulse(const Bodies& bodies, const OverlapRoots<V>& at, V velocity, V last,
                                              Mask pressed, Mask touching, bool& is_done) {
  constexpr bool is_hertz = Derived<Case>::is_hertz;
  constexpr double half_step = Case::time_step / 2;
  const V half = splat<V>(0.5), one = splat<V>(1);
  V stiffness = bodies.stiffness(), damping = bodies.damping(), state_weight = splat<V>(1.6);
  if constexpr (is_hertz) {
    stiffness = stiffness * at.root;
    damping = damping * at.fourth;
    state_weight = fused_minus(at.root, bodies.stiffness_times_count(1.6 * 0.15 * Case::time_step), state_weight);
  }
  const V resisted = fused(bodies.count(0.5), damping, one), inverse = one / (resisted * at.overlap);
  const V resisted_velocity = fused(bodies.count(-0.5), stiffness * at.overlap, velocity) * (inverse * at.overlap);
  const V change = where(pressed, resisted_velocity - velocity);  // (v' - v)/2

  NormalImpulse<V> p;
  const V path_before = constant<V>(half_step) * velocity;
  const V path_after = constant<V>(half_step) * fused(splat<V>(2), change, velocity);
  const V path_of_state = constant<V>(half_step) * fused(state_weight, change, velocity);
  const V reach = constant<V>(detail::short_path) * at.overlap;
  const Mask is_short =
      (abs(path_before) < reach) & (abs(path_after) < reach) & (abs(path_of_state) < reach) & (last > V{});

  V elastic, damping_mean, state;
  if constexpr (is_hertz) {
    const V inverse_overlap = inverse * resisted, before = -(path_before * inverse_overlap);
    const V for_state = path_of_state * inverse_overlap, damping_after = detail::mean_power<1>(for_state);
    elastic = half * (detail::mean_power<6>(before) + detail::mean_power<6>(path_after * inverse_overlap));
    elastic = stiffness * at.overlap * elastic;
    damping_mean = half * (detail::mean_power<1>(before) + damping_after);
    state = at.overlap * at.fourth * fused(constant<V>(1.25) * for_state, damping_after, one);
  } else {
    elastic = stiffness * fused(splat<V>(0.25), path_after - path_before, at.overlap);
    damping_mean = one;
    state = at.overlap + path_of_state;
  }
  V state_before = last;
  p.share_of_step = one;
  const Mask in_full = touching & !is_short;
  is_done = true;
  if constexpr (mode == SlidingLanes::reported) {
    is_done = !any(in_full);
  } else if (any(in_full)) {
    const detail::PathMeans<V> e =
        detail::means_in_full<is_hertz>(at, path_before, path_after, path_of_state, last, pressed);
    elastic = select(in_full, bodies.stiffness() * e.elastic, elastic);
    damping = select(in_full, bodies.damping(), damping);
    damping_mean = select(in_full, e.damping, damping_mean);
    state = select(in_full, e.state, state);
    state_before = select(in_full, e.state_before, state_before);
    p.share_of_step = select(in_full, e.share_of_step, one);
  }
  p.state_function = where(pressed, state);
  p.tangential_damping = where(touching, damping * damping_mean);
  constexpr double exponent = is_hertz ? 0.8 : 1;
  p.damping = where(touching, bodies.damping(exponent, Case::time_step) * (p.state_function - state_before));
  p.total = where(touching, elastic) + p.damping;
  return p;
}

/// Scaled impulse on the owner, and the history advanced: the counterpart of contact_force (contact_law.hpp), where the
/// parameters are explained.
template <class Law, class Case, SlidingLanes mode, class V, class Normal, class Bodies>
FIXDEM_INLINE ContactForce<V> contact_impulse(const Bodies& bodies, const OverlapRoots<V>& at, const Normal& n,
                                              const Vec3<V>& surface_velocity, V normal_velocity,
                                              [[maybe_unused]] const Vec3<V>& rolling_velocity, History<V>& history,
                                              bool& is_done) {
  const Vec3<V>& u = surface_velocity;
  using Mask = decltype(V{} > V{});
  const Mask pressed = at.overlap > V{}, known = history.state_function > V{}, touching = pressed | known;
  const NormalImpulse<V> p =
      normal_impulse<Law, Case, mode>(bodies, at, normal_velocity, history.state_function, pressed, touching, is_done);
  [[maybe_unused]] const V normal_power = p.damping * fused_minus(bodies.count(0.5), p.total, normal_velocity);
  history.state_function = p.state_function;
  if constexpr (!Law::has_friction) {
    return {scale(-p.total, n), normal_power};
  } else {
    V stiffness = where(pressed, bodies.tangential_stiffness());
    if constexpr (Derived<Case>::is_hertz) stiffness = bodies.tangential_stiffness() * at.root;
    [[maybe_unused]] const V rolling_stiffness = stiffness;
    stiffness = stiffness * detail::square_of_sinc(bodies.count(0.875 * Case::time_step) * stiffness);
    [[maybe_unused]] const LastSpring<V> before =
        last_spring<Case>(history.spring, history.last_tangential_stiffness, stiffness);
    const TangentialSpring<V> s = tangential_spring<Law, Case>(Springs<V>{V{}, p.tangential_damping, stiffness},
                                                               pressed, history.last_tangential_stiffness);
    const V half = where(known, splat<V>(0.5));
    const Vec3<V>& last = history.last_velocity;
    const Vec3<V> middle = {fused(half, u.x - last.x, u.x), fused(half, u.y - last.y, u.y),
                            fused(half, u.z - last.z, u.z)};  // surface velocity in the middle of the step
    const V middle_normal = dot(middle, n);

    ContactStep<V> step;
    step.spring = stuck_spring<Case, mode>(s, s.gain * p.share_of_step, history.spring, n, u, normal_velocity);
    step.force =
        subtract_scaled(subtract_scaled(scale(fused(s.damping, middle_normal, -p.total), n), s.damping, middle),
                        s.to_force, step.spring);
    if constexpr (Case::energy_ledger) {
      // The damping's force is of `middle`; it works on the mean of before and after.
      const Vec3<V> damped = subtract_scaled(middle, middle_normal, n);
      const Vec3<V> mean = add_scaled(u, bodies.count(1.75), step.force);
      step.damping_power = fused(s.damping, dot(damped, mean), normal_power);
    }

    const V elastic = p.total - p.damping;
    const V excess =
        where(touching, excess_over_friction<Law, Case>(step.force, s.to_force, step.spring, p.total, elastic));
    if constexpr (mode == SlidingLanes::reported) {
      is_done = is_done & !any_below(V{}, excess);
    } else if (any_below(V{}, excess)) {
      const Vec3<V> present = subtract_scaled(u, normal_velocity, n);
      const Slip<V> slip = {scale(p.share_of_step, present), subtract_scaled(middle, middle_normal, n), present};
      step = slide<Law, Case>(bodies, step, excess > V{}, s, slip, n, p.total, elastic, normal_power,
                              history.last_limit, before.force);
      if constexpr (Case::energy_ledger) step.sliding_work = where(pressed, step.sliding_work);
    }
    V law_work{};
    if constexpr (Case::energy_ledger) law_work = work_of_law<Case>(before, step.spring, stiffness, pressed);
    history.spring = where(pressed, step.spring), history.last_velocity = where(pressed, u);
    if constexpr (Case::slider == Slider::exact) history.last_limit = where(pressed, step.last_limit);
    ContactForce<V> f{where(touching, step.force), step.damping_power, step.sliding_work, law_work};
    if constexpr (Law::has_rolling) {  // softening is of second order, and so is a frequency left as it is
      const LastSpring<V> rolled =
          last_spring<Case>(history.rolling, history.last_rolling_stiffness, rolling_stiffness);
      const TangentialSpring<V> r = tangential_spring<Law, Case>(
          Springs<V>{V{}, p.tangential_damping, rolling_stiffness}, pressed, history.last_rolling_stiffness);
      f.rolling = roll<Law, Case, mode>(r, r.gain * p.share_of_step, n, rolling_velocity, bodies, elastic,
                                        rolling_stiffness, pressed, rolled, f.force, history.rolling, is_done);
      if constexpr (Case::energy_ledger)
        f.damping_power = f.damping_power + damping_by_rolling(bodies, s, f.force, step.spring, f.rolling.force);
    }
    return f;
  }
}

}  // namespace fixdem
