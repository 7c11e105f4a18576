// Where gravity points in the pipe: which way is up across the axis, and whether there is a bed at all.
#pragma once

#include "contact_reference.hpp"

namespace fixdem::reference {

/// Unit vector across the axis against gravity; along y where gravity has no part across.
template <class Case, class Scalar>
Vector<Scalar> upwards() {
  const Vector<Scalar> across(Scalar(Case::gravity[0]), Scalar(Case::gravity[1]), 0);
  return across.norm() > 0 ? Vector<Scalar>(-across / across.norm()) : Vector<Scalar>(0, 1, 0);
}

/// Steeper than 80 degrees particles make no bed, and none floats. One alone makes none anyway.
template <class Case>
bool has_no_bed() {
  const double *g = Case::gravity, across = std::hypot(g[0], g[1]), whole = std::hypot(across, g[2]);
  return Case::particle_count > 1 && across < 0.17 * whole;
}

}  // namespace fixdem::reference
