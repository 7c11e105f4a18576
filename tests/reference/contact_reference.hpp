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

#include "slider_reference.hpp"

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
  Scalar friction = 0;  ///< Coulomb's coefficient
};

/// Friction and restitution at walls: the particles' own in a case that does not name them.
template <class Case>
double wall_friction() {
  if constexpr (requires { Case::wall_friction; })
    return Case::wall_friction;
  else
    return Case::friction;
}
template <class Case>
double wall_restitution() {
  if constexpr (requires { Case::wall_restitution; })
    return Case::wall_restitution;
  else
    return Case::restitution;
}

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
/// restitution, mu the friction.
template <class Case, class Scalar>
Coefficients<Scalar> with_damping(Scalar K, Scalar k_t, Scalar effective_mass, Scalar e, Scalar mu) {
  const Scalar alpha = damping_constant<Scalar>(e);
  if (Case::normal == NormalLaw::hertz) {
    const Scalar eta = alpha * std::sqrt(effective_mass * K);
    return {K, k_t, eta, eta, mu};
  }
  if (Case::damping == Damping::critical) {
    const Scalar m = sphere_properties<Case, Scalar>().mass;
    return {K, k_t, 2 * std::sqrt(m * K), 2 * std::sqrt(m * k_t), mu};
  }
  const Scalar beta = alpha / std::sqrt(Scalar(5));
  const Scalar eta = 2 * beta * std::sqrt(effective_mass * K);
  return {K, k_t, eta, eta, mu};
}

/// Eqs. (16) and (21), (20).
template <class Case, class Scalar>
Coefficients<Scalar> pair_coefficients() {
  const Scalar e = Case::restitution, mu = Case::friction;
  const auto sphere = sphere_properties<Case, Scalar>();
  const Scalar M = Case::damping_mass == DampingMass::reduced ? sphere.mass / 2 : sphere.mass;
  if (Case::normal == NormalLaw::linear) {
    return with_damping<Case, Scalar>(Case::normal_stiffness, Case::tangential_stiffness, M, e, mu);
  }
  const Scalar E = Case::youngs_modulus, nu = Case::poisson_ratio, r = sphere.radius;
  const Scalar G = E / (2 * (1 + nu));
  const Scalar K = std::sqrt(2 * r) * E / (3 * (1 - nu * nu));
  const Scalar k_t = 2 * std::sqrt(2 * r) * G / (2 - nu);
  return with_damping<Case, Scalar>(K, k_t, M, e, mu);
}

/// Eqs. (17) and (22), (20). A wall of infinite modulus is rigid.
template <class Case, class Scalar>
Coefficients<Scalar> wall_coefficients() {
  const Scalar e = wall_restitution<Case>(), mu = wall_friction<Case>();
  const auto sphere = sphere_properties<Case, Scalar>();
  if (Case::normal == NormalLaw::linear) {
    return with_damping<Case, Scalar>(Case::normal_stiffness, Case::tangential_stiffness, sphere.mass, e, mu);
  }
  const Scalar E = Case::youngs_modulus, nu = Case::poisson_ratio, r = sphere.radius;
  const Scalar E_w = Case::wall_youngs_modulus, nu_w = Case::wall_poisson_ratio;
  const Scalar G = E / (2 * (1 + nu));
  const Scalar K = 4 * std::sqrt(r) / 3 / ((1 - nu * nu) / E + (1 - nu_w * nu_w) / E_w);
  const Scalar k_t = 8 * std::sqrt(r) * G / (2 - nu);
  return with_damping<Case, Scalar>(K, k_t, sphere.mass, e, mu);
}

/// What a contact remembers from step to step, seen from i. `history` is the tangential displacement (m) in the
/// displacement form and the spring force (N) in the two incremental forms; `stiffness` is k_t of the step before.
template <class Scalar>
struct Memory {
  Vector<Scalar> history = Vector<Scalar>::Zero();
  Scalar stiffness = 0;      ///< zero: none yet
  Scalar spring_energy = 0;  ///< held by the tangential spring after the step before, J
  Scalar limit = 0;          ///< `exact`: maximum length of the history in the step before, if it slid
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
  Vector<Scalar> spin_sum;  ///< omega_i + omega_j
  int bodies;               ///< that the force moves: 2 between spheres, 1 at a wall
};

template <class Scalar>
struct ContactForce {
  Scalar normal_force = 0;  ///< f_n of eq. (6): negative when it repels
  Vector<Scalar> tangential_force = Vector<Scalar>::Zero();
  Vector<Scalar> torque = Vector<Scalar>::Zero();  ///< on either sphere, eq. (14)
  Scalar elastic_energy = 0;
  Scalar damping_loss = 0;  ///< J during this step
  Scalar sliding_loss = 0;
  Scalar made_by_law = 0;
};

// The ledger. A force works on the mean of the velocities before the step and after it, as far as this contact changes
// them.
template <class Case, class Scalar>
Scalar mean_normal_velocity(const Encounter<Scalar>& at, Scalar normal_force) {
  const Scalar M = sphere_properties<Case, Scalar>().mass / at.bodies;
  return at.relative_velocity.dot(at.n) + normal_force / M * Scalar(Case::time_step) / 2;
}
template <class Case, class Scalar>
Vector<Scalar> mean_slip(const Encounter<Scalar>& at, const Vector<Scalar>& slip, const Vector<Scalar>& force) {
  const auto sphere = sphere_properties<Case, Scalar>();
  const Scalar mobility = 1 / sphere.mass + sphere.radius * sphere.radius / sphere.moment_of_inertia;
  return slip + force * at.bodies * mobility * Scalar(Case::time_step) / 2;
}

/// A tangential spring of force s now and `last_s` a step ago has been pulled along `way` (m), of which it let `slid`
/// go. That takes the mean force times `slid`; what its energy has grown by beyond the work that is left, the law has
/// made.
template <class Scalar>
void book_spring(const Vector<Scalar>& last_s, Scalar last_k_t, const Vector<Scalar>& s, Scalar k_t,
                 const Vector<Scalar>& way, const Vector<Scalar>& slid, Memory<Scalar>& memory,
                 ContactForce<Scalar>& out) {
  const Vector<Scalar> mean = (last_s + s) / 2;
  memory.spring_energy = s.squaredNorm() / (2 * k_t);
  out.elastic_energy += memory.spring_energy;
  out.sliding_loss = mean.dot(slid);
  out.made_by_law = memory.spring_energy - last_s.squaredNorm() / (2 * last_k_t) - mean.dot(way) + out.sliding_loss;
}

/// Keeps a tangential vector in the tangent plane of the contact, at its length.
template <class Scalar>
Vector<Scalar> turned_into_plane(const Vector<Scalar>& h, const Vector<Scalar>& n) {
  const Vector<Scalar> projected = h - h.dot(n) * n;
  const Scalar length = projected.norm();
  if (length == 0) return Vector<Scalar>::Zero();
  return projected * (h.norm() / length);
}

/// Coulomb's limit: of the whole normal force, or of its elastic part.
template <class Case, class Scalar>
Scalar friction_limit(const Coefficients<Scalar>& c, Scalar normal_force, Scalar elastic_force) {
  if constexpr (requires { Case::friction_limit; })
    if (Case::friction_limit == FrictionLimit::elastic) return c.friction * elastic_force;
  return c.friction * std::abs(normal_force);
}

/// Eqs. (6)-(12) and (14) for one contact during one step; advances its memory.
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

  out.tangential_force = f_t;
  out.torque = r * at.n.cross(f_t);
  const Vector<Scalar> last_s =
      Case::tangential == TangentialLaw::displacement ? Vector<Scalar>(last_k_t * kept) : kept;
  book_spring<Scalar>(last_s, last_k_t, s, k_t, slip * dt, (trial_spring - s) / k_t, memory, out);
  out.damping_loss += (-f_t - s).dot(mean_slip<Case>(at, slip, f_t)) * dt;
  return out;
}

}  // namespace fixdem::reference
