#include "particle_kinds.hpp"

#include <algorithm>

namespace fixdem::program {

std::vector<CountedKind> counted_kinds(const ParticleKinds& particles, int particle_count) {
  if (!particles.has_sizes()) return {{{particles.diameter, particles.density, 0}, particle_count}};
  std::vector<CountedKind> found;
  if (particles.has_species()) {
    found.resize(static_cast<std::size_t>(particles.species_count));
    for (int id = 0; id < particle_count; ++id) {
      CountedKind& species = found[static_cast<std::size_t>(particles.species_of(id))];
      species.kind = particles.kinds[id], ++species.count;
    }
    return found;
  }
  for (const double diameter : {particles.smallest_diameter, particles.diameter}) {
    found.push_back({{diameter, particles.density, 0}, 0});
    for (int id = 0; id < particle_count; ++id) found.back().count += particles.diameter_of(id) == diameter ? 1 : 0;
  }
  return found;
}

SizeStatistics size_statistics(const ParticleKinds& particles, int particle_count) {
  SizeStatistics all{};
  all.minimum_diameter = 2 * particles.smallest_radius(), all.maximum_diameter = particles.diameter;
  double squares = 0, cubes = 0;
  for (int id = 0; id < particle_count; ++id) {
    const double d = particles.diameter_of(id), volume = particles.volume_share_of(id) * particles.solid_volume();
    all.mean_diameter += d / particle_count;
    squares += d * d, cubes += d * d * d;
    all.total_mass += particles.mass_of(id), all.total_volume += volume;
  }
  all.sauter_diameter = cubes / squares;
  return all;
}

}  // namespace fixdem::program
