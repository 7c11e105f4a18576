// What the reference keeps of each sphere and of each contact from one step to the next.
#pragma once

#include "contact_reference.hpp"

namespace fixdem::reference {

template <class Scalar>
struct SphereState {
  using Vector3 = Vector<Scalar>;
  Vector3 x = Vector3::Zero(), v = Vector3::Zero(), omega = Vector3::Zero();
  Vector3 force = Vector3::Zero(), torque = Vector3::Zero();  ///< of contacts, this step
  Vector3 gas_force = Vector3::Zero();                        ///< held between updates of the gas
  Vector3 acceleration = Vector3::Zero();                     ///< of the step before
  bool floats = false;
};

template <class Scalar>
struct ContactState {
  Memory<Scalar> memory;
  ContactForce<Scalar> force;
  Vector<Scalar> n = Vector<Scalar>::Zero();
  Scalar overlap = 0;
  long long last_step = -1;
};

}  // namespace fixdem::reference
