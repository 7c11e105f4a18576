// Rolling resistance: a spring and a dashpot on the rolling of two surfaces over each other, with a limit.
//
//   (47)  w = R* (omega_i - omega_j) x n          R* = r/2 between spheres; at a wall r, and no omega_j
//   (48)  xi is turned into the tangent plane, grows by w dt, and is no longer than mu_r f_el / k_t;
//         q = -k_t xi - eta w, no longer than mu_r f_el
//   (49)  torque R* n x q on i, and the opposite on j; no force
//
// k_t and eta are those of sliding, f_el is the elastic part of the normal force. The forms of the tangential spring
// apply to xi; its limit is always a plain cap, whatever the slider. SI units. Seen from the other sphere xi is the
// same.
#pragma once

#include "spring_reference.hpp"

namespace fixdem::reference {

/// One contact as its rolling sees it in one step.
template <class Scalar>
struct RollingContact {
  Vector<Scalar> w;  ///< rolling velocity, eq. (47)
  Vector<Scalar> n;
  Scalar stiffness, damping;  ///< k_t, eta
  Scalar limit;               ///< mu_r f_el
  Scalar time;                ///< for which the spring grows
  bool is_open;               ///< `impulse`: the rest of a contact that has opened, without a spring
};

template <class Scalar>
struct RollingForce {
  Vector<Scalar> q = Vector<Scalar>::Zero();        ///< eq. (48)
  Vector<Scalar> dashpot = Vector<Scalar>::Zero();  ///< the part of q that is not the spring's
  SpringEntries<Scalar> entries;
};

/// Eq. (48) for one contact during one step; advances its memory.
template <class Case, class Scalar>
RollingForce<Scalar> rolling_resistance(const RollingContact<Scalar>& at, KeptSpring<Scalar>& memory) {
  const bool keeps_displacement = Case::tangential == TangentialLaw::displacement;
  const Scalar k = at.stiffness, last_k = memory.stiffness > 0 ? memory.stiffness : k;
  RollingForce<Scalar> out;
  Vector<Scalar> s = Vector<Scalar>::Zero();  // force of the spring, before the minus of eq. (48)
  if (at.is_open) {
    out.entries = book_opening(memory);
    memory.history = s;
  } else {
    const Scalar to_force = keeps_displacement ? k : Scalar(1);  // N per unit of history
    const Vector<Scalar> turned = turned_into_plane(memory.history, at.n), way = at.w * at.time;
    const Vector<Scalar> last_s = (keeps_displacement ? last_k : Scalar(1)) * turned;
    const bool shrinks = Case::tangential == TangentialLaw::rescale && k < last_k;
    const Vector<Scalar> kept = shrinks ? Vector<Scalar>(turned * (k / last_k)) : turned;
    const Vector<Scalar> grown = kept + (keeps_displacement ? Scalar(1) : k) * way;
    memory.history = no_longer_than<Scalar>(grown, at.limit / to_force);
    s = to_force * memory.history;
    out.entries = book_spring<Scalar>(last_s, last_k, s, k, way, (to_force * grown - s) / k, memory);
  }
  memory.stiffness = k;
  out.q = no_longer_than<Scalar>(-s - at.damping * at.w, at.limit);
  out.dashpot = out.q + s;
  return out;
}

}  // namespace fixdem::reference
