#include "neighbourhood.hpp"

#include <cmath>

namespace fixdem::program {

std::vector<int> neighbourhood(const CaseFacts& facts, const Snapshot& snapshot, int particle) {
  std::vector<int> near;
  const double reach = neighbourhood_reach * facts.diameter;
  for (int id = 0; id < static_cast<int>(snapshot.particles.size()); ++id) {
    if (particle >= 0) {
      const double *a = snapshot.particles[static_cast<std::size_t>(id)].position,
                   *b = snapshot.particles[static_cast<std::size_t>(particle)].position;
      double z = a[2] - b[2];
      if (facts.is_periodic) z -= facts.pipe_length * std::round(z / facts.pipe_length);
      if (!(std::hypot(a[0] - b[0], a[1] - b[1], z) <= reach)) continue;
    }
    near.push_back(id);
  }
  return near;
}

}  // namespace fixdem::program
