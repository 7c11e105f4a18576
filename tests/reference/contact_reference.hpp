// The contact law in its textbook form: the force of one contact.
//
// Written from the equations of Tsuji, Tanaka & Ishida (1992), one line each, in 3-vectors of Eigen, independently of
// the kernel: from the kernel's folder it takes nothing but the names of the choices (kernel/case.hpp). Everything is
// derived here from the case's material. SI units. n is the unit vector from i to j (at a wall: outwards), the
// relative velocity is v_i - v_j, and the force returned is the one on i. Spheres of several sizes:
//
//   (44)  v_s = v_r - (v_r.n) n + (r_i omega_i + r_j omega_j) x n; torques r_i n x f_t on i, r_j n x f_t on j
//   (45)  v_s' = (7/2) f_t/M
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

#include "coefficients_reference.hpp"
#include "rolling_reference.hpp"

// Numbers of particles are int; clang counts their use as an index to -Wconversion.
#if defined(__clang__)
#pragma clang diagnostic ignored "-Wsign-conversion"
#endif

namespace fixdem::reference {

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
  Vector<Scalar> spin, spin_of_partner;  ///< omega_i, omega_j
  Bodies<Scalar> bodies;

  /// (r_i omega_i + r_j omega_j) x n of eq. (44), with r_i taken out of the sum, as equal spheres have it.
  Vector<Scalar> surface_velocity_by_spin() const {
    const Vector<Scalar> sum = spin + spin_of_partner * (bodies.j.radius / bodies.i.radius);
    return bodies.i.radius * sum.cross(n);
  }
  /// w of eq. (47).
  Vector<Scalar> rolling_velocity() const {
    return bodies.reduced_radius * Vector<Scalar>(spin - spin_of_partner).cross(n);
  }
};

template <class Scalar>
struct ContactForce {
  Scalar normal_force = 0;  ///< f_n of eq. (6): negative when it repels
  Vector<Scalar> tangential_force = Vector<Scalar>::Zero();
  Vector<Scalar> torque = Vector<Scalar>::Zero();             ///< on i, eqs. (14), (44)
  Vector<Scalar> torque_on_partner = Vector<Scalar>::Zero();  ///< on j
  Vector<Scalar> rolling_force = Vector<Scalar>::Zero();      ///< q of eq. (48)
  Vector<Scalar> rolling_torque = Vector<Scalar>::Zero();     ///< on i, and the opposite on j, eq. (49)
  Scalar elastic_energy = 0;
  Scalar damping_loss = 0;  ///< J during this step
  Scalar sliding_loss = 0;
  Scalar rolling_loss = 0;
  Scalar made_by_law = 0;
};

// The ledger. A force works on the mean of the velocities before the step and after it, as far as this contact changes
// them. Velocities change by force times mobility.
template <class Case, class Scalar>
Scalar mean_normal_velocity(const Encounter<Scalar>& at, Scalar normal_force) {
  return at.relative_velocity.dot(at.n) + normal_force / at.bodies.reduced_mass * Scalar(Case::time_step) / 2;
}
template <class Scalar>
struct Mobilities {
  Scalar of_slip, of_rolling;  ///< of each velocity by its own force; of_slip is 7/(2 M)
  Scalar of_other;             ///< of each by the other's force: the two spheres turn by different amounts
};
template <class Scalar>
Mobilities<Scalar> mobilities(const Bodies<Scalar>& bodies) {
  const auto &i = bodies.i, &j = bodies.j;
  const Scalar R = bodies.reduced_radius;
  return {(1 / i.mass + i.radius * i.radius / i.moment_of_inertia) +
              (1 / j.mass + j.radius * j.radius / j.moment_of_inertia),
          R * R / i.moment_of_inertia + R * R / j.moment_of_inertia,
          R * i.radius / i.moment_of_inertia - R * j.radius / j.moment_of_inertia};
}

/// Eqs. (47) to (49), with k_t and eta of sliding and the elastic part of the normal force; the spring grows for a
/// `time`.
template <class Case, class Scalar>
RollingForce<Scalar> rolling_force(const Coefficients<Scalar>& c, const Encounter<Scalar>& at, Scalar k_t, Scalar eta,
                                   Scalar elastic_force, Scalar time, Memory<Scalar>& memory) {
  if (c.rolling_friction == 0) return {};
  return rolling_resistance<Case, Scalar>(
      {at.rolling_velocity(), at.n, k_t, eta, c.rolling_friction * elastic_force, time, !(at.overlap > 0)},
      memory.rolling);
}

/// Adds what acts along the tangent plane, and its entries in the ledger; `s`: force of the tangential spring.
template <class Case, class Scalar>
void add_tangential(const Encounter<Scalar>& at, const Vector<Scalar>& slip, const Vector<Scalar>& f_t,
                    const Vector<Scalar>& s, const SpringEntries<Scalar>& sliding, const RollingForce<Scalar>& rolling,
                    ContactForce<Scalar>& out) {
  const Scalar dt = Case::time_step;
  out.tangential_force = f_t;
  out.torque = at.bodies.i.radius * at.n.cross(f_t);
  out.torque_on_partner = at.bodies.j.radius * at.n.cross(f_t);
  out.rolling_force = rolling.q;
  out.rolling_torque = at.bodies.reduced_radius * at.n.cross(rolling.q);

  const Mobilities<Scalar> mobility = mobilities(at.bodies);
  const auto mean_of_step = [&](const Vector<Scalar>& velocity, const Vector<Scalar>& force, Scalar of_force,
                                const Vector<Scalar>& other) {
    return Vector<Scalar>(velocity + (force * of_force + other * mobility.of_other) * dt / 2);
  };
  const Vector<Scalar> mean_slip = mean_of_step(slip, f_t, mobility.of_slip, rolling.q);
  const Vector<Scalar> mean_w = mean_of_step(at.rolling_velocity(), rolling.q, mobility.of_rolling, f_t);
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
  const Scalar dt = Case::time_step;
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

  const Vector<Scalar> slip = at.relative_velocity - v_n * at.n + at.surface_velocity_by_spin();  // eqs. (8), (44)
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
