// How the two of a contact move against each other, from their states.
#pragma once

#include "kernel/fixdem.hpp"

namespace fixdem::program {

struct ContactMotion {
  double velocity[3];  ///< of the owner's centre relative to the partner's, m/s
  double slip[3];      ///< of the surfaces across the normal, eq. (8), m/s
};

/// Normal from the owner to the partner; no partner: a wall at rest.
inline ContactMotion contact_motion(const Particle& owner, double radius, const Particle* partner,
                                    double partner_radius, const double* normal) {
  static constexpr Particle still{};
  const Particle& other = partner != nullptr ? *partner : still;
  const double quotient = partner_radius / radius;
  ContactMotion motion{};
  double spin[3];
  for (int k = 0; k < 3; ++k) {
    motion.velocity[k] = owner.velocity[k] - other.velocity[k];
    spin[k] = radius * (owner.angular_velocity[k] + quotient * other.angular_velocity[k]);
  }
  const double along = motion.velocity[0] * normal[0] + motion.velocity[1] * normal[1] + motion.velocity[2] * normal[2];
  for (int k = 0; k < 3; ++k) {
    const int a = (k + 1) % 3, b = (k + 2) % 3;
    motion.slip[k] = (motion.velocity[k] - along * normal[k]) + (spin[a] * normal[b] - spin[b] * normal[a]);
  }
  return motion;
}

}  // namespace fixdem::program
