// The contact law in its textbook form: coefficients and the force of one contact.
//
// Written from the equations of Tsuji, Tanaka & Ishida (1992), one line each, in 3-vectors of Eigen, independently of
// the kernel: from the kernel's folder it takes nothing but the names of the choices (kernel/case.hpp). Everything is
// derived here from the case's material. SI units. n is the unit vector from i to j (at a wall: outwards), the
// relative velocity is v_i - v_j, and the force returned is the one on i.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

#include "keys_with_defaults.hpp"
#include "rolling_reference.hpp"

// Numbers of particles are int; clang counts their use as an index to -Wconversion.
#if defined(__clang__)
#pragma clang diagnostic ignored "-Wsign-conversion"
#endif

namespace fixdem::reference {

/// Stiffness and damping of one kind of contact. With Hertz they are the factors of overlap^(3/2), overlap^(1/2) and
/// overlap^(1/4); with the linear law they are N/m and kg/s.
template <class Scalar>
struct Coefficients {
  Scalar normal_stiffness;
  Scalar tangential_stiffness;
  Scalar normal_damping;
  Scalar tangential_damping;
  Scalar friction = 0;          ///< Coulomb's coefficient
  Scalar rolling_friction = 0;  ///< mu_r
};

template <class Scalar>
struct SphereProperties {
  Scalar radius;
  Scalar mass;
  Scalar moment_of_inertia;
};

template <class Case, class Scalar>
SphereProperties<Scalar> sphere_properties() {
  const Scalar pi = std::acos(Scalar(-1));
  const Scalar d = Case::diameter;
  const Scalar m = pi * d * d * d / 6 * Scalar(Case::density);
  return {d / 2, m, Scalar(2) / 5 * m * (d / 2) * (d / 2)};
}

/// Closed form of eq. (30): the damping constant alpha that returns the restitution e.
template <class Scalar>
Scalar damping_constant(Scalar e) {
  const Scalar pi = std::acos(Scalar(-1));
  return -std::sqrt(Scalar(5)) * std::log(e) / std::sqrt(pi * pi + std::log(e) * std::log(e));
}

/// Eqs. (23), (26) and (31) for a normal stiffness K and a tangential one; `effective_mass` is M of eq. (26), e the
/// restitution, mu the friction, mu_r the rolling friction.
template <class Case, class Scalar>
Coefficients<Scalar> with_damping(Scalar K, Scalar k_t, Scalar effective_mass, Scalar e, Scalar mu, Scalar mu_r) {
  const Scalar alpha = damping_constant<Scalar>(e);
  if (Case::normal == NormalLaw::hertz) {
    const Scalar eta = alpha * std::sqrt(effective_mass * K);
    return {K, k_t, eta, eta, mu, mu_r};
  }
  if (Case::damping == Damping::critical) {
    const Scalar m = sphere_properties<Case, Scalar>().mass;
    return {K, k_t, 2 * std::sqrt(m * K), 2 * std::sqrt(m * k_t), mu, mu_r};
  }
  const Scalar beta = alpha / std::sqrt(Scalar(5));
  const Scalar eta = 2 * beta * std::sqrt(effective_mass * K);
  return {K, k_t, eta, eta, mu, mu_r};
}

/// Eqs. (16) and (21), (20).
template <class Case, class Scalar>
Coefficients<Scalar> pair_coefficients() {
  const Scalar e = Case::restitution, mu = Case::friction, mu_r = rolling_friction<Case>();
  const auto sphere = sphere_properties<Case, Scalar>();
  const Scalar M = Case::damping_mass == DampingMass::reduced ? sphere.mass / 2 : sphere.mass;
  if (Case::normal == NormalLaw::linear) {
    return with_damping<Case, Scalar>(Case::normal_stiffness, Case::tangential_stiffness, M, e, mu, mu_r);
  }
  const Scalar E = Case::youngs_modulus, nu = Case::poisson_ratio, r = sphere.radius;
  const Scalar G = E / (2 * (1 + nu));
  const Scalar K = std::sqrt(2 * r) * E / (3 * (1 - nu * nu));
  const Scalar k_t = 2 * std::sqrt(2 * r) * G / (2 - nu);
  return with_damping<Case, Scalar>(K, k_t, M, e, mu, mu_r);
}

/// Eqs. (17) and (22), (20). A wall of infinite modulus is rigid.
template <class Case, class Scalar>
Coefficients<Scalar> wall_coefficients() {
  const Scalar e = wall_restitution<Case>(), mu = wall_friction<Case>(), mu_r = wall_rolling_friction<Case>();
  const auto sphere = sphere_properties<Case, Scalar>();
  if (Case::normal == NormalLaw::linear) {
    return with_damping<Case, Scalar>(Case::normal_stiffness, Case::tangential_stiffness, sphere.mass, e, mu, mu_r);
  }
  const Scalar E = Case::youngs_modulus, nu = Case::poisson_ratio, r = sphere.radius;
  const Scalar E_w = Case::wall_youngs_modulus, nu_w = Case::wall_poisson_ratio;
  const Scalar G = E / (2 * (1 + nu));
  const Scalar K = 4 * std::sqrt(r) / 3 / ((1 - nu * nu) / E + (1 - nu_w * nu_w) / E_w);
  const Scalar k_t = 8 * std::sqrt(r) * G / (2 - nu);
  return with_damping<Case, Scalar>(K, k_t, sphere.mass, e, mu, mu_r);
}

/// What a contact remembers from step to step, seen from i; first of all its tangential spring.
template <class Scalar>
struct Memory : KeptSpring<Scalar> {
  KeptSpring<Scalar> rolling;
  Scalar limit = 0;  ///< `exact`: maximum length of the history in the step before, if it slid
  // `impulse`: overlap^(5/4) (linear law: overlap) at the end of the step before, and the surface velocity in it. Below
  // zero: not looked at yet; zero: begins now.
  Scalar state = 0;
  Vector<Scalar> surface_velocity = Vector<Scalar>::Zero();
};

/// Where and how i and j meet. The predicted normal velocity damps the normal motion (equal to the current one with
/// the Euler integrator).
template <class Scalar>
struct Encounter {
  Scalar overlap;
  Vector<Scalar> n;
  Vector<Scalar> relative_velocity;
  Scalar predicted_normal_velocity;
  Vector<Scalar> spin_sum, spin_difference;  ///< omega_i + omega_j, omega_i - omega_j
  int bodies;                                ///< that the force moves: 2 between spheres, 1 at a wall
};

template <class Scalar>
struct ContactForce {
  Scalar normal_force = 0;  ///< f_n of eq. (6): negative when it repels
  Vector<Scalar> tangential_force = Vector<Scalar>::Zero();
  Vector<Scalar> torque = Vector<Scalar>::Zero();          ///< on either sphere, eq. (14)
  Vector<Scalar> rolling_force = Vector<Scalar>::Zero();   ///< q of eq. (48)
  Vector<Scalar> rolling_torque = Vector<Scalar>::Zero();  ///< on i, and the opposite on j, eq. (49)
  Scalar elastic_energy = 0;
  Scalar damping_loss = 0;  ///< J during this step
  Scalar sliding_loss = 0;
  Scalar rolling_loss = 0;
  Scalar made_by_law = 0;
};

// The ledger. A force works on the mean of the velocities before the step and after it, as far as this contact changes
// them.
template <class Case, class Scalar>
Scalar mean_normal_velocity(const Encounter<Scalar>& at, Scalar normal_force) {
  const Scalar M = sphere_properties<Case, Scalar>().mass / at.bodies;
  return at.relative_velocity.dot(at.n) + normal_force / M * Scalar(Case::time_step) / 2;
}
/// `force` that drives the velocity, and `other`, which does so at a wall only, where both turn the one sphere alike;
/// `mobility`: of `force` per body.
template <class Case, class Scalar>
Vector<Scalar> mean_of_step(const Encounter<Scalar>& at, const Vector<Scalar>& velocity, const Vector<Scalar>& force,
                            Scalar mobility, const Vector<Scalar>& other) {
  const auto sphere = sphere_properties<Case, Scalar>();
  const Scalar of_other = at.bodies == 1 ? sphere.radius * sphere.radius / sphere.moment_of_inertia : Scalar(0);
  return velocity + (force * at.bodies * mobility + other * of_other) * Scalar(Case::time_step) / 2;
}

/// Reduced radius: R* of eq. (47).
template <class Case, class Scalar>
Scalar rolling_radius(const Encounter<Scalar>& at) {
  return sphere_properties<Case, Scalar>().radius / at.bodies;
}

/// Eqs. (47) to (49), with k_t and eta of sliding and the elastic part of the normal force; the spring grows for a
/// `time`.
template <class Case, class Scalar>
RollingForce<Scalar> rolling_force(const Coefficients<Scalar>& c, const Encounter<Scalar>& at, Scalar k_t, Scalar eta,
                                   Scalar elastic_force, Scalar time, Memory<Scalar>& memory) {
  if (c.rolling_friction == 0) return {};
  const Vector<Scalar> w = rolling_radius<Case>(at) * at.spin_difference.cross(at.n);
  return rolling_resistance<Case, Scalar>(
      {w, at.n, k_t, eta, c.rolling_friction * elastic_force, time, !(at.overlap > 0)}, memory.rolling);
}

/// Adds what acts along the tangent plane, and its entries in the ledger; `s`: force of the tangential spring.
template <class Case, class Scalar>
void add_tangential(const Encounter<Scalar>& at, const Vector<Scalar>& slip, const Vector<Scalar>& f_t,
                    const Vector<Scalar>& s, const SpringEntries<Scalar>& sliding, const RollingForce<Scalar>& rolling,
                    ContactForce<Scalar>& out) {
  const auto sphere = sphere_properties<Case, Scalar>();
  const Scalar dt = Case::time_step, r = sphere.radius, R = rolling_radius<Case>(at);
  out.tangential_force = f_t;
  out.torque = r * at.n.cross(f_t);
  out.rolling_force = rolling.q;
  out.rolling_torque = R * at.n.cross(rolling.q);

  const Vector<Scalar> w = R * at.spin_difference.cross(at.n);
  const Vector<Scalar> mean_slip =
      mean_of_step<Case>(at, slip, f_t, 1 / sphere.mass + r * r / sphere.moment_of_inertia, rolling.q);
  const Vector<Scalar> mean_w = mean_of_step<Case>(at, w, rolling.q, R * R / sphere.moment_of_inertia, f_t);
  out.elastic_energy += sliding.elastic_energy + rolling.entries.elastic_energy;
  out.damping_loss += (-f_t - s).dot(mean_slip) * dt;
  out.sliding_loss += sliding.slider_loss;
  out.rolling_loss += rolling.entries.slider_loss - rolling.dashpot.dot(mean_w) * dt;
  out.made_by_law += sliding.made_by_law + rolling.entries.made_by_law;
}

/// Coulomb's limit: of the whole normal force, or of its elastic part.
template <class Case, class Scalar>
Scalar friction_limit(const Coefficients<Scalar>& c, Scalar normal_force, Scalar elastic_force) {
  return c.friction * (friction_is_limited_by_elastic_force<Case>() ? elastic_force : std::abs(normal_force));
}

/// Eqs. (6)-(12), (14) and (47)-(49) for one contact during one step; advances its memory.
template <class Case, class Scalar>
ContactForce<Scalar> contact_force(const Coefficients<Scalar>& c, const Encounter<Scalar>& at, Memory<Scalar>& memory) {
  const Scalar dt = Case::time_step, r = Scalar(Case::diameter) / 2;
  const bool hertz = Case::normal == NormalLaw::hertz;
  const Scalar root = std::sqrt(at.overlap);
  const Scalar k_t = hertz ? c.tangential_stiffness * root : c.tangential_stiffness;
  const Scalar eta_n = hertz ? c.normal_damping * std::sqrt(root) : c.normal_damping;
  const Scalar eta_t = hertz ? c.tangential_damping * std::sqrt(root) : c.tangential_damping;
  const Scalar spring = c.normal_stiffness * (hertz ? at.overlap * root : at.overlap);
  const Scalar v_n = at.relative_velocity.dot(at.n);

  ContactForce<Scalar> out;
  out.normal_force = -spring - eta_n * at.predicted_normal_velocity;  // eqs. (6), (18)
  out.elastic_energy = spring * at.overlap * (hertz ? Scalar(2) / 5 : Scalar(1) / 2);
  out.damping_loss = eta_n * at.predicted_normal_velocity * mean_normal_velocity<Case>(at, out.normal_force) * dt;
  if (c.friction == 0) return out;

  const Vector<Scalar> slip = at.relative_velocity - v_n * at.n + r * at.spin_sum.cross(at.n);  // eq. (8)
  const Vector<Scalar> kept = turned_into_plane(memory.history, at.n);
  Vector<Scalar> before;  // spring force before this step's slip, and after: s, before the minus of eq. (7)
  if (Case::tangential == TangentialLaw::displacement) {
    before = k_t * kept;
  } else if (Case::tangential == TangentialLaw::rescale && k_t < memory.stiffness) {
    before = kept * (k_t / memory.stiffness);
  } else {
    before = kept;
  }
  Vector<Scalar> s = before + k_t * slip * dt;
  const Vector<Scalar> trial_spring = s;

  const Scalar limit = friction_limit<Case>(c, out.normal_force, spring);
  Vector<Scalar> f_t;
  if (Case::slider != Slider::paper) {
    const Scalar unit = Case::tangential == TangentialLaw::displacement ? k_t : Scalar(1);  // N per unit of history
    s = unit * spring_within_limit<Case, Scalar>(before / unit, k_t * slip * dt / unit, limit / unit, memory.limit);
    f_t = -(s + eta_t * slip);
    if (f_t.norm() > limit) f_t *= limit / f_t.norm();
  } else {
    f_t = -(s + eta_t * slip);
    if (f_t.norm() > limit) {
      f_t = slip.norm() > 0 ? Vector<Scalar>(-limit * slip.normalized()) : Vector<Scalar>(limit * f_t.normalized());
      s = -f_t;
    }
  }
  const bool capped = s != trial_spring;
  if (Case::tangential == TangentialLaw::displacement) {
    memory.history = capped ? Vector<Scalar>(s / k_t) : Vector<Scalar>(kept + slip * dt);
  } else {
    memory.history = s;
  }
  const Scalar last_k_t = memory.stiffness > 0 ? memory.stiffness : k_t;
  memory.stiffness = k_t;
  const Vector<Scalar> last_s =
      Case::tangential == TangentialLaw::displacement ? Vector<Scalar>(last_k_t * kept) : kept;
  const auto sliding = book_spring<Scalar>(last_s, last_k_t, s, k_t, slip * dt, (trial_spring - s) / k_t, memory);
  const auto rolling = rolling_force<Case>(c, at, k_t, eta_t, spring, dt, memory);
  add_tangential<Case>(at, slip, f_t, s, sliding, rolling, out);
  return out;
}

}  // namespace fixdem::reference
