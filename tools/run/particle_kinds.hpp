// What particles are, as run-time values: diameter, density and species, of all of them or of each one.
//
// A case of one size has one kind of particle. Where there are several, what is said of "the" particle is of the sphere
// of reference, the heaviest of the largest ones (kernel/case.hpp), and overlaps are told in radii of the smallest.
// Kinds are numbered as particles are, in input order: every particle is a kind of its own. In a line the kinds are
// those of the case's table, and what is present says which of them it is (Snapshot::kind). SI units.
#pragma once

#include <array>
#include <vector>

#include "kernel/case.hpp"

namespace fixdem::program {

struct ParticleKind {
  double diameter, density;
  int species;

  double volume() const { return 3.14159265358979323846 / 6 * diameter * diameter * diameter; }
  double mass() const { return volume() * density; }
};

struct ParticleKinds {
  double diameter, density, mass;        ///< of all particles, or of the sphere of reference
  const ParticleKind* kinds = nullptr;   ///< null where all are equal
  int kind_count = 0;                    ///< entries there
  double smallest_diameter = 0;          ///< with several sizes
  int species_count = 1;                 ///< 0 with a continuous distribution
  const char* const* species = nullptr;  ///< names; null without species

  bool has_sizes() const { return kinds != nullptr; }
  /// Whether there are species to be told apart.
  bool has_species() const { return has_sizes() && species_count > 0; }

  double diameter_of(int kind) const { return has_sizes() ? kinds[kind].diameter : diameter; }
  double radius_of(int kind) const { return diameter_of(kind) / 2; }
  double density_of(int kind) const { return has_sizes() ? kinds[kind].density : density; }
  double mass_of(int kind) const { return has_sizes() ? kinds[kind].mass() : mass; }
  int species_of(int kind) const { return has_sizes() ? kinds[kind].species : 0; }
  /// Volume in volumes of the sphere of reference: 1 where all are equal.
  double volume_share_of(int kind) const { return has_sizes() ? kinds[kind].volume() / solid_volume() : 1; }

  double largest_radius() const { return diameter / 2; }
  double smallest_radius() const { return (has_sizes() ? smallest_diameter : diameter) / 2; }
  double solid_volume() const { return mass / density; }  ///< of all particles, or of the sphere of reference
};

/// One entry for each particle of a case of several sizes, or of the kinds of a line.
template <class Case>
inline constexpr auto kind_table = [] {
  constexpr auto count = [] {
    std::size_t sum = 0;
    for (const SizeRun& run : Case::sizes) sum += static_cast<std::size_t>(run.count);
    return sum;
  }();
  std::array<ParticleKind, count> table{};
  std::size_t id = 0;
  for (const SizeRun& run : Case::sizes)
    for (int k = 0; k < run.count; ++k) table[id++] = {run.diameter, run.density, run.species};
  return table;
}();

template <class Case>
constexpr ParticleKinds particle_kinds() {
  using D = Derived<Case>;
  ParticleKinds all{};
  all.diameter = largest_diameter<Case>, all.mass = D::reference_mass;
  if constexpr (has_sizes<Case>) {
    all.density = Case::reference_density;
    all.kinds = kind_table<Case>.data(), all.kind_count = static_cast<int>(kind_table<Case>.size());
    all.smallest_diameter = smallest_diameter<Case>;
    all.species_count = species_in<Case>;
    if constexpr (requires { Case::species_names; }) all.species = Case::species_names;
  } else {
    all.density = Case::density;
  }
  return all;
}

/// Particles of one kind and how many they are.
struct CountedKind {
  ParticleKind kind;
  int count;
};
/// Every species; the one kind of a case of one size; with a continuous distribution, the smallest and the largest.
/// With several sizes of all kinds that the case has.
std::vector<CountedKind> counted_kinds(const ParticleKinds&, int particle_count);

/// Means over all particles.
struct SizeStatistics {
  double minimum_diameter, maximum_diameter, mean_diameter, sauter_diameter;  ///< Sauter: sum d^3 / sum d^2
  double total_mass, total_volume;
};
/// `kind_of`: of each particle; null where numbers are kinds.
SizeStatistics size_statistics(const ParticleKinds&, int particle_count, const int* kind_of = nullptr);

}  // namespace fixdem::program
