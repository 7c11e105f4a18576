// Sizes of the particles: one for all, or a list of runs of equal ones.
//
// A case of one size says `diameter` and `density`. One of several says `sizes`: runs of consecutive particles, by
// input number, that are equal; so extremes are known at compile time and every particle's own values at any time. SI
// units.
#pragma once

namespace fixdem {

/// Consecutive particles of one diameter [m] and density [kg/m3].
struct SizeRun {
  int count;
  double diameter, density;
  int species;  ///< number in the order of the case file; 0 with a continuous distribution
};

template <class Case>
inline constexpr bool has_sizes = requires {
  Case::sizes;
};

/// Species of a case; 1 where all particles are equal, 0 with a continuous distribution.
template <class Case>
inline constexpr int species_in = [] {
  if constexpr (has_sizes<Case>)
    return Case::species_count;
  else
    return 1;
}();

/// Diameters of the largest and smallest sphere, m.
template <class Case>
inline constexpr double largest_diameter = [] {
  if constexpr (has_sizes<Case>)
    return Case::largest_diameter;
  else
    return Case::diameter;
}();
template <class Case>
inline constexpr double smallest_diameter = [] {
  if constexpr (has_sizes<Case>)
    return Case::smallest_diameter;
  else
    return Case::diameter;
}();

/// Particles in all runs: as many as there are; in a line (case.hpp), the kinds of those at the start and of those fed.
template <class Case>
inline constexpr int kinds_in = [] {
  if constexpr (has_sizes<Case>) {
    int kinds = 0;
    for (const SizeRun& run : Case::sizes) kinds += run.count;
    return kinds;
  } else {
    return Case::particle_count;
  }
}();

/// The run of a particle, by its kind: its input number but in a line. Every particle may be one of its own, or there
/// are few runs.
template <class Case>
constexpr SizeRun size_run_of(int id) {
  if constexpr (has_sizes<Case>) {
    constexpr int runs = sizeof(Case::sizes) / sizeof(SizeRun);
    if constexpr (runs == kinds_in<Case>) return Case::sizes[id];
    int run = 0;
    for (int first = Case::sizes[0].count; run + 1 < runs && id >= first; first += Case::sizes[run].count) ++run;
    return Case::sizes[run];
  } else {
    return {Case::particle_count, Case::diameter, Case::density, 0};
  }
}

/// Values of a particle by its kind.
template <class Case>
constexpr double diameter_of(int id) {
  return size_run_of<Case>(id).diameter;
}
template <class Case>
constexpr double radius_of(int id) {
  return diameter_of<Case>(id) / 2;
}
template <class Case>
constexpr double density_of(int id) {
  return size_run_of<Case>(id).density;
}
template <class Case>
constexpr double volume_of(int id) {
  const double d = diameter_of<Case>(id);
  return 3.14159265358979323846 / 6 * d * d * d;
}
template <class Case>
constexpr double mass_of(int id) {
  return volume_of<Case>(id) * density_of<Case>(id);
}
template <class Case>
constexpr int species_of(int id) {
  return size_run_of<Case>(id).species;
}

}  // namespace fixdem
