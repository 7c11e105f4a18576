// What the reference takes and shows: spheres, contacts, energies. Named as in the kernel; SI units.
#pragma once

namespace fixdem::reference {

/// State of one sphere, or what a test places.
struct Particle {
  double position[3];
  double velocity[3];
  double angular_velocity[3];
};

/// A contact of the last force evaluation, seen from the owner (the lower number); partners below zero are walls.
struct Contact {
  int owner, partner;
  double overlap;
  double normal[3];
  double normal_force;  ///< positive: repulsion
  double tangential_force[3];
  double history[3];
  double rolling_force[3];  ///< q of eq. (48), on the owner
  double rolling_history[3];
};

struct Energy {
  double kinetic = 0, elastic = 0, dissipated_damping = 0, dissipated_sliding = 0, gravity_work = 0, gas_work = 0;
  double dissipated_rolling = 0, made_by_law = 0;
  double entered = 0, left_with = 0;  ///< kinetic of those fed; kinetic and elastic that left with others
};

/// Of a line: numbers of particles, and kg.
struct LineTotals {
  long long at_start = 0, fed = 0, left = 0, present = 0;
  double asked = 0, accepted = 0, left_mass = 0, backlog = 0;
  double blocked_time = 0;  ///< s
};

constexpr int pipe_wall = -1, lower_end = -2, upper_end = -3;  ///< partner numbers of the walls

}  // namespace fixdem::reference
