// A spring in the tangent plane of a contact: how it keeps to the plane, and what it does in the energy ledger. Sliding
// and rolling have one each.
#pragma once

#include "slider_reference.hpp"

namespace fixdem::reference {

/// What a contact remembers of a spring from step to step, seen from i. `history` is the displacement (m) in the
/// displacement form and the spring force (N) in the two incremental forms; `stiffness` is that of the step before.
template <class Scalar>
struct KeptSpring {
  Vector<Scalar> history = Vector<Scalar>::Zero();
  Scalar stiffness = 0;      ///< zero: none yet
  Scalar spring_energy = 0;  ///< held by the spring after the step before, J
};

/// Of one spring in one step, J.
template <class Scalar>
struct SpringEntries {
  Scalar elastic_energy = 0, slider_loss = 0, made_by_law = 0;
};

/// Keeps a tangential vector in the tangent plane of the contact, at its length.
template <class Scalar>
Vector<Scalar> turned_into_plane(const Vector<Scalar>& h, const Vector<Scalar>& n) {
  const Vector<Scalar> projected = h - h.dot(n) * n;
  const Scalar length = projected.norm();
  if (length == 0) return Vector<Scalar>::Zero();
  return projected * (h.norm() / length);
}

template <class Scalar>
Vector<Scalar> no_longer_than(const Vector<Scalar>& v, Scalar limit) {
  return v.norm() > limit ? Vector<Scalar>(v * (limit / v.norm())) : v;
}

/// A spring of force s now and `last_s` a step ago has been pulled along `way` (m), of which it let `slid` go. That
/// takes the mean force times `slid`; what its energy has grown by beyond the work that is left, the law has made.
template <class Scalar>
SpringEntries<Scalar> book_spring(const Vector<Scalar>& last_s, Scalar last_stiffness, const Vector<Scalar>& s,
                                  Scalar stiffness, const Vector<Scalar>& way, const Vector<Scalar>& slid,
                                  KeptSpring<Scalar>& memory) {
  const Vector<Scalar> mean = (last_s + s) / 2;
  const Scalar energy = s.squaredNorm() / (2 * stiffness), loss = mean.dot(slid);
  memory.spring_energy = energy;
  return {energy, loss, energy - last_s.squaredNorm() / (2 * last_stiffness) - mean.dot(way) + loss};
}

/// The contact has opened: what the spring held is lost.
template <class Scalar>
SpringEntries<Scalar> book_opening(KeptSpring<Scalar>& memory) {
  const Scalar held = memory.spring_energy;
  memory.spring_energy = 0;
  return {0, 0, -held};
}

}  // namespace fixdem::reference
