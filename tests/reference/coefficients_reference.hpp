// Stiffness, damping and friction of one contact, from the material of the case and the two bodies.
//
//   (43)  K = (4/3) E* sqrt(R*), k_t = 8 G* sqrt(R*) sqrt(overlap), eta = alpha sqrt(M K) overlap^(1/4);
//         1/E* = sum (1 - nu^2)/E; 1/G* = sum (2 - nu)/G between spheres, (2 - nu)/G at a wall
// which for equal spheres is eqs. (16), (17), (20)-(22) and (26). SI units.
#pragma once

#include "bodies_reference.hpp"
#include "keys_with_defaults.hpp"

namespace fixdem::reference {

/// Stiffness and damping of a contact. With Hertz they are the factors of overlap^(3/2), overlap^(1/2) and
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

/// Closed form of eq. (30): the damping constant alpha that returns the restitution e.
template <class Scalar>
Scalar damping_constant(Scalar e) {
  const Scalar pi = std::acos(Scalar(-1));
  return -std::sqrt(Scalar(5)) * std::log(e) / std::sqrt(pi * pi + std::log(e) * std::log(e));
}

/// Eqs. (23), (26) and (31) for a normal stiffness K and a tangential one; e is the restitution, mu the friction, mu_r
/// the rolling friction. The mass in eq. (23) is 2 M between spheres, which is m of equal ones.
template <class Case, class Scalar>
Coefficients<Scalar> with_damping(const Bodies<Scalar>& bodies, Scalar K, Scalar k_t, Scalar e, Scalar mu,
                                  Scalar mu_r) {
  const Scalar alpha = damping_constant<Scalar>(e);
  const Scalar M = Case::damping_mass == DampingMass::reduced ? bodies.reduced_mass : bodies.i.mass;
  if (Case::normal == NormalLaw::hertz) {
    const Scalar eta = alpha * std::sqrt(M * K);
    return {K, k_t, eta, eta, mu, mu_r};
  }
  if (Case::damping == Damping::critical) {
    const Scalar m = bodies.is_pair ? 2 * bodies.reduced_mass : bodies.reduced_mass;
    return {K, k_t, 2 * std::sqrt(m * K), 2 * std::sqrt(m * k_t), mu, mu_r};
  }
  const Scalar beta = alpha / std::sqrt(Scalar(5));
  const Scalar eta = 2 * beta * std::sqrt(M * K);
  return {K, k_t, eta, eta, mu, mu_r};
}

/// Between particles i and j; where all are equal, between any.
template <class Case, class Scalar>
Coefficients<Scalar> pair_coefficients(int i = 0, int j = 0) {
  const Scalar e = Case::restitution, mu = Case::friction, mu_r = rolling_friction<Case>();
  const auto bodies = bodies_of_contact<Case, Scalar>(i, j);
  if (Case::normal == NormalLaw::linear) {
    return with_damping<Case, Scalar>(bodies, Case::normal_stiffness, Case::tangential_stiffness, e, mu, mu_r);
  }
  const Scalar E = Case::youngs_modulus, nu = Case::poisson_ratio, R = bodies.reduced_radius;
  const Scalar G = E / (2 * (1 + nu));
  const Scalar K = std::sqrt(4 * R) * E / (3 * (1 - nu * nu));
  const Scalar k_t = 2 * std::sqrt(4 * R) * G / (2 - nu);
  return with_damping<Case, Scalar>(bodies, K, k_t, e, mu, mu_r);
}

/// Of particle i at a wall. A wall of infinite modulus is rigid.
template <class Case, class Scalar>
Coefficients<Scalar> wall_coefficients(int i = 0) {
  const Scalar e = wall_restitution<Case>(), mu = wall_friction<Case>(), mu_r = wall_rolling_friction<Case>();
  const auto bodies = bodies_of_contact<Case, Scalar>(i, -1);
  if (Case::normal == NormalLaw::linear) {
    return with_damping<Case, Scalar>(bodies, Case::normal_stiffness, Case::tangential_stiffness, e, mu, mu_r);
  }
  const Scalar E = Case::youngs_modulus, nu = Case::poisson_ratio, R = bodies.reduced_radius;
  const Scalar E_w = Case::wall_youngs_modulus, nu_w = Case::wall_poisson_ratio;
  const Scalar G = E / (2 * (1 + nu));
  const Scalar K = 4 * std::sqrt(R) / 3 / ((1 - nu * nu) / E + (1 - nu_w * nu_w) / E_w);
  const Scalar k_t = 8 * std::sqrt(R) * G / (2 - nu);
  return with_damping<Case, Scalar>(bodies, K, k_t, e, mu, mu_r);
}

/// Partners below zero are walls.
template <class Case, class Scalar>
Coefficients<Scalar> contact_coefficients(int owner, int partner) {
  return partner < 0 ? wall_coefficients<Case, Scalar>(owner) : pair_coefficients<Case, Scalar>(owner, partner);
}

}  // namespace fixdem::reference
