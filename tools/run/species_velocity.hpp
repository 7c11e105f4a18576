// How fast each species goes along the pipe: the mean over its particles, m/s.
#pragma once

#include <vector>

#include "particle_kinds.hpp"
#include "snapshot.hpp"

namespace fixdem::program {

/// In the order of the species; empty in a case without species.
inline std::vector<double> axial_velocities(const ParticleKinds& particles, const Snapshot& snapshot) {
  if (!particles.has_species()) return {};
  std::vector<double> sum(static_cast<std::size_t>(particles.species_count)), count(sum.size());
  for (std::size_t id = 0; id < snapshot.particles.size(); ++id) {
    const auto species = static_cast<std::size_t>(particles.species_of(snapshot.kind(static_cast<int>(id))));
    sum[species] += snapshot.particles[id].velocity[2], ++count[species];
  }
  for (std::size_t k = 0; k < sum.size(); ++k) sum[k] /= count[k];
  return sum;
}

}  // namespace fixdem::program
