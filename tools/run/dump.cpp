#include "dump.hpp"

#include <fmt/format.h>

#include <iterator>

namespace fixdem::program {

std::string encode_dump(const Snapshot& snapshot, const CaseFacts& facts) {
  const double half = facts.pipe_diameter / 2;
  std::string text = fmt::format(
      "ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS ff ff {}\n{} {}\n{} {}\n0 {}\n"
      "ITEM: ATOMS id type x y z vx vy vz omegax omegay omegaz radius{}\n",
      snapshot.step, snapshot.particles.size(), facts.is_periodic ? "pp" : "ff", -half, half, -half, half,
      facts.pipe_length, facts.has_sizes() ? " mass" : "");
  auto out = std::back_inserter(text);
  for (std::size_t i = 0; i < snapshot.particles.size(); ++i) {
    const Particle& p = snapshot.particles[i];
    const int id = static_cast<int>(i), kind = snapshot.kind(id);
    fmt::format_to(out, "{} {} {} {} {} {} {} {} {} {} {} {}", snapshot.serial(id) + 1, facts.species_of(kind) + 1,
                   p.position[0], p.position[1], p.position[2], p.velocity[0], p.velocity[1], p.velocity[2],
                   p.angular_velocity[0], p.angular_velocity[1], p.angular_velocity[2], facts.radius_of(kind));
    if (facts.has_sizes()) fmt::format_to(out, " {}", facts.mass_of(kind));
    text += '\n';
  }
  return text;
}

}  // namespace fixdem::program
