#include "particle_kinds.hpp"

#include <algorithm>

namespace fixdem::program {

std::vector<CountedKind> counted_kinds(const ParticleKinds& particles, int particle_count) {
  if (!particles.has_sizes()) return {{{particles.diameter, particles.density, 0}, particle_count}};
  std::vector<CountedKind> found;
  if (particles.has_species()) {
    found.resize(static_cast<std::size_t>(particles.species_count));
    for (int k = 0; k < particles.kind_count; ++k) {
      CountedKind& species = found[static_cast<std::size_t>(particles.species_of(k))];
      species.kind = particles.kinds[k], ++species.count;
    }
    return found;
  }
  for (const double diameter : {particles.smallest_diameter, particles.diameter}) {
    found.push_back({{diameter, particles.density, 0}, 0});
    for (int k = 0; k < particles.kind_count; ++k) found.back().count += particles.diameter_of(k) == diameter ? 1 : 0;
  }
  return found;
}

SizeStatistics size_statistics(const ParticleKinds& particles, int particle_count, const int* kind_of) {
  SizeStatistics all{};
  all.minimum_diameter = 2 * particles.smallest_radius(), all.maximum_diameter = particles.diameter;
  double squares = 0, cubes = 0;
  for (int id = 0; id < particle_count; ++id) {
    const int kind = kind_of != nullptr ? kind_of[id] : id;
    const double d = particles.diameter_of(kind), volume = particles.volume_share_of(kind) * particles.solid_volume();
    all.mean_diameter += d / particle_count;
    squares += d * d, cubes += d * d * d;
    all.total_mass += particles.mass_of(kind), all.total_volume += volume;
  }
  all.sauter_diameter = cubes / squares;
  return all;
}

}  // namespace fixdem::program
