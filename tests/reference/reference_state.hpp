// What the reference keeps of each sphere and of each contact from one step to the next, and how it shows and books it.
#pragma once

#include <utility>

#include "contact_reference.hpp"
#include "seen_reference.hpp"

namespace fixdem::reference {

template <class Scalar>
struct SphereState {
  using Vector3 = Vector<Scalar>;
  SphereProperties<Scalar> own{};
  Vector3 x = Vector3::Zero(), v = Vector3::Zero(), omega = Vector3::Zero();
  Vector3 force = Vector3::Zero(), torque = Vector3::Zero();  ///< of contacts, this step
  Vector3 gas_force = Vector3::Zero();                        ///< held between updates of the gas
  Vector3 acceleration = Vector3::Zero();                     ///< of the step before
  bool floats = false;
  bool is_present = true;
  int kind = 0;  ///< number in the table of sizes
};

template <class Scalar>
Scalar kinetic_energy(const SphereState<Scalar>& s) {
  return s.own.mass * s.v.squaredNorm() / 2 + s.own.moment_of_inertia * s.omega.squaredNorm() / 2;
}

template <class Scalar>
struct ContactState {
  Bodies<Scalar> bodies;
  Coefficients<Scalar> coefficients{};
  Memory<Scalar> memory;
  ContactForce<Scalar> force;
  Vector<Scalar> n = Vector<Scalar>::Zero();
  Scalar overlap = 0;
  long long last_step = -1;  ///< of its last force; below zero: none yet
};

/// As it was in the last force evaluation; `key`: owner and partner.
template <class Scalar>
Contact shown(std::pair<int, int> key, const ContactState<Scalar>& contact) {
  Contact c{};
  c.owner = key.first, c.partner = key.second;
  c.overlap = static_cast<double>(contact.overlap);
  c.normal_force = static_cast<double>(-contact.force.normal_force);
  for (int k = 0; k < 3; ++k) {
    c.normal[k] = static_cast<double>(contact.n[k]);
    c.tangential_force[k] = static_cast<double>(contact.force.tangential_force[k]);
    c.history[k] = static_cast<double>(contact.memory.history[k]);
    c.rolling_force[k] = static_cast<double>(contact.force.rolling_force[k]);
    c.rolling_history[k] = static_cast<double>(contact.memory.rolling.history[k]);
  }
  return c;
}

template <class Scalar>
void book(const ContactForce<Scalar>& f, Energy& energy) {
  energy.dissipated_damping += static_cast<double>(f.damping_loss);
  energy.dissipated_sliding += static_cast<double>(f.sliding_loss);
  energy.dissipated_rolling += static_cast<double>(f.rolling_loss);
  energy.made_by_law += static_cast<double>(f.made_by_law);
}

/// A contact is forgotten: what its springs held is lost.
template <class Scalar>
void book_end(const Memory<Scalar>& memory, Energy& energy) {
  energy.made_by_law -= static_cast<double>(memory.spring_energy + memory.rolling.spring_energy);
}

}  // namespace fixdem::reference
