// The spheres of a case, each with its radius and mass, and the two bodies that a contact is between.
//
// A case of one size says `diameter` and `density`; one of several lists runs of consecutive particles, by input
// number, that are equal. SI units.
//
//   (42)  1/M = 1/m_i + 1/m_j, 1/R* = 1/r_i + 1/r_j; at a wall M = m_i, R* = r_i
#pragma once

#include <cmath>
#include <limits>

#include "kernel/case.hpp"

namespace fixdem::reference {

template <class Case>
inline constexpr bool lists_sizes = requires {
  Case::sizes;
};

template <class Scalar>
struct SphereProperties {
  Scalar radius;
  Scalar mass;
  Scalar moment_of_inertia;
};

/// Diameter and density of particle `id`.
template <class Case>
SizeRun size_of(int id) {
  if constexpr (lists_sizes<Case>) {
    for (const SizeRun& run : Case::sizes) {
      if (id < run.count) return run;
      id -= run.count;
    }
    return {};
  } else {
    return {Case::particle_count, Case::diameter, Case::density, 0};
  }
}

/// Of particle `id`; where all are equal, of any.
template <class Case, class Scalar>
SphereProperties<Scalar> sphere_properties(int id = 0) {
  const Scalar pi = std::acos(Scalar(-1));
  const SizeRun size = size_of<Case>(id);
  const Scalar d = size.diameter;
  const Scalar m = pi * d * d * d / 6 * Scalar(size.density);
  return {d / 2, m, Scalar(2) / 5 * m * (d / 2) * (d / 2)};
}

template <class Case, class Scalar>
Scalar largest_radius() {
  Scalar largest = sphere_properties<Case, Scalar>().radius;
  if constexpr (lists_sizes<Case>)
    for (const SizeRun& run : Case::sizes) largest = std::fmax(largest, Scalar(run.diameter) / 2);
  return largest;
}

/// j of a wall: infinite mass, and no lever.
template <class Scalar>
struct Bodies {
  SphereProperties<Scalar> i{}, j{};
  Scalar reduced_radius = 0, reduced_mass = 0;  ///< R*, M
  bool is_pair = false;
};

/// Partners below zero are walls. The quotients are eq. (42), written so that equal spheres give r/2 and m/2 exactly.
template <class Case, class Scalar>
Bodies<Scalar> bodies_of_contact(int owner, int partner) {
  const auto i = sphere_properties<Case, Scalar>(owner);
  constexpr Scalar infinite = std::numeric_limits<Scalar>::infinity();
  if (partner < 0) return {i, {0, infinite, infinite}, i.radius, i.mass, false};
  const auto j = sphere_properties<Case, Scalar>(partner);
  return {i, j, i.radius / (1 + i.radius / j.radius), i.mass / (1 + i.mass / j.mass), true};
}

}  // namespace fixdem::reference
