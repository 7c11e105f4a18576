// The impulse of one contact in one step of `integrator = "impulse"`, in textbook form.
//
// Positions are half a step ahead of velocities. From the overlap d and its growth v now, in one step:
//   - the velocity in the middle of the step, of this contact alone: v_m = v - (K d^(3/2) + eta v_m) dt / (2 M);
//   - elastic impulse: K times the integral of overlap^(3/2) in time, along the straight half steps from d - v dt/2 to
//   d and
//     from d to d + (2 v_m - v) dt/2; a contact that has begun since the last step also gets the part before, from
//     zero;
//   - damping impulse: G(d_G) - G kept, G = (4/5) eta_0 overlap^(5/4), d_G = d + v dt/2 + (4/5) (1 - y/10) (v_m - v)
//   dt,
//     y = (3/2) K d^(1/2) dt^2 / M;
//   - the tangential spring k_t sinc^2(w dt/2), w^2 = 3.5 k_t/M (45), grown by the slip of the step, or from the
//     beginning of the contact; damping by the mean of eta along the half steps (the second one to d_G), at
//     the slip extrapolated to the middle of the step. With the linear law the powers are 1, 0 and 1 in place of 3/2,
//     1/4 and 5/4;
//   - rolling resistance with k_t itself, the same mean of eta at the rolling velocity of the step, and the elastic
//     impulse as the force of its limit.
// Means of powers are differences of antiderivatives, or Gauss' rule where these would cancel. SI units; what is
// returned are mean forces over the step. Written from these sentences, not from the kernel.
#pragma once

#include "contact_reference.hpp"

namespace fixdem::reference {

/// Mean of overlap^power along a straight way from a to b; gaps count as zero.
template <class Scalar>
Scalar mean_of_power(Scalar a, Scalar b, Scalar power) {
  if (a <= 0 && b <= 0) return 0;
  if (a > 0 && b > 0 && std::abs(b - a) < Scalar(0.01) * a) {
    const Scalar middle = (a + b) / 2, off = (b - a) / 2 * std::sqrt(Scalar(3) / 5);
    return (5 * std::pow(middle - off, power) + 8 * std::pow(middle, power) + 5 * std::pow(middle + off, power)) / 18;
  }
  const auto integral = [power](Scalar x) { return x > 0 ? std::pow(x, power + 1) / (power + 1) : Scalar(0); };
  return (integral(b) - integral(a)) / (b - a);
}

/// Mean forces during the step; advances the memory.
template <class Case, class Scalar>
ContactForce<Scalar> contact_impulse(const Coefficients<Scalar>& c, const Encounter<Scalar>& at,
                                     Memory<Scalar>& memory) {
  const Scalar dt = Case::time_step, half = dt / 2;
  const Scalar M = at.bodies.reduced_mass, d = at.overlap, v = at.relative_velocity.dot(at.n);
  const bool hertz = Case::normal == NormalLaw::hertz, pressed = d > 0;
  const Scalar elastic_power = hertz ? Scalar(1.5L) : Scalar(1), damping_power = hertz ? Scalar(0.25L) : Scalar(0);
  const Scalar stiffness = hertz && pressed ? c.normal_stiffness * std::sqrt(d) : c.normal_stiffness;
  const Scalar spring = pressed ? stiffness * d : 0;
  const Scalar eta = pressed ? c.normal_damping * std::pow(d, damping_power) : 0;
  const Scalar v_m = (v - spring * half / M) / (1 + eta * half / M);
  const Scalar y = hertz && pressed ? Scalar(1.5L) * stiffness * dt * dt / M : 0;

  const Scalar before = d - v * half, after = d + (2 * v_m - v) * half;
  const Scalar for_state = d + v * half + Scalar(0.8L) * (1 - y / 10) * (v_m - v) * dt;
  const auto state_of = [&](Scalar x) { return x > 0 ? std::pow(x, damping_power + 1) : Scalar(0); };
  const bool begins = memory.state == 0 && v > 0, found = memory.state < 0;
  const auto time_mean = [&](Scalar power, Scalar end) {
    Scalar sum =
        begins ? mean_of_power(Scalar(0), d, power) * std::min(d / v, dt) : mean_of_power(before, d, power) * half;
    if (pressed) sum += mean_of_power(d, end, power) * half;
    return sum / dt;
  };
  const Scalar state_before = found ? state_of(before) : memory.state;
  const bool known = memory.state > 0;
  memory.state = pressed ? state_of(for_state) : Scalar(0);

  ContactForce<Scalar> out;
  const Scalar damping = c.normal_damping / (damping_power + 1) * (memory.state - state_before) / dt;
  out.normal_force = -c.normal_stiffness * time_mean(elastic_power, after) - damping;
  out.elastic_energy = spring * d / (elastic_power + 1);
  out.damping_loss = damping * mean_normal_velocity<Case>(at, out.normal_force) * dt;
  if (c.friction == 0) return out;

  Scalar k_t = !pressed ? 0 : hertz ? c.tangential_stiffness * std::sqrt(d) : c.tangential_stiffness;
  const Scalar rolling_stiffness = k_t;
  const Scalar x = std::min(std::sqrt(Scalar(3.5L) * k_t / M) * half, Scalar(1));
  if (x > 0) k_t *= std::sin(x) / x * (std::sin(x) / x);
  const Scalar eta_t = c.tangential_damping * time_mean(damping_power, for_state);

  Scalar grows = dt;  // for which the spring grows
  if (found) grows = half;
  if (v > 0 && (begins || found)) grows = std::min(grows, d / v);
  const Vector<Scalar> surface = at.relative_velocity + at.surface_velocity_by_spin();  // eq. (8), with v.n
  const auto tangential = [&](const Vector<Scalar>& u) { return Vector<Scalar>(u - u.dot(at.n) * at.n); };
  const Vector<Scalar> slip = tangential(surface);
  const Vector<Scalar> slip_in_middle = known ? tangential(surface + (surface - memory.surface_velocity) / 2) : slip;

  const bool keeps_displacement = Case::tangential == TangentialLaw::displacement;
  const Scalar to_force = keeps_displacement ? k_t : Scalar(1), per_slip = keeps_displacement ? Scalar(1) : k_t;
  Vector<Scalar> kept = turned_into_plane(memory.history, at.n);
  if (Case::tangential == TangentialLaw::rescale && k_t < memory.stiffness) kept *= k_t / memory.stiffness;
  const Scalar limit = friction_limit<Case>(c, out.normal_force, -out.normal_force - damping);
  const Scalar last_k_t = memory.stiffness > 0 ? memory.stiffness : k_t;
  const Vector<Scalar> unrescaled = turned_into_plane(memory.history, at.n);
  const Vector<Scalar> last_s = keeps_displacement ? Vector<Scalar>(last_k_t * unrescaled) : unrescaled;
  Vector<Scalar> h = Vector<Scalar>::Zero();
  SpringEntries<Scalar> sliding;
  if (pressed) {
    const Vector<Scalar> trial = kept + per_slip * grows * slip;
    h = spring_within_limit<Case, Scalar>(kept, per_slip * grows * slip, limit / to_force, memory.limit);
    sliding = book_spring<Scalar>(last_s, last_k_t, to_force * h, k_t, grows * slip, (trial - h) / per_slip, memory);
  } else {
    sliding = book_opening<Scalar>(memory);
  }
  const Vector<Scalar> s = (pressed ? to_force : Scalar(0)) * h;
  Vector<Scalar> f_t = -(s + eta_t * slip_in_middle);
  f_t = no_longer_than<Scalar>(f_t, limit);
  memory.history = h;
  memory.stiffness = k_t;
  memory.surface_velocity = surface;

  const auto rolling = rolling_force<Case>(c, at, rolling_stiffness, eta_t, -out.normal_force - damping, grows, memory);
  add_tangential<Case>(at, slip, f_t, s, sliding, rolling, out);
  return out;
}

}  // namespace fixdem::reference
