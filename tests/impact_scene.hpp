// Many separate oblique impacts in one simulation: spheres against a flat wall, and pairs, at random velocities and
// spins.
//
// Each sphere has one contact at most, so its change of velocity in a step is the force of that contact, and what the
// law promises of a single contact can be read off the motion alone. No gravity, no pipe wall.
#pragma once

#include "cases/collide_wall.hpp"
#include "kernel/fixdem.hpp"
#include "scenes.hpp"

namespace fixdem::tests {

inline constexpr int wall_impacts = 20, pair_impacts = 20;

struct impact_scene : cases::collide_wall {
  static constexpr int particle_count = wall_impacts + 2 * pair_impacts;
  static constexpr bool has_wall = false;
  static constexpr Ends ends = Ends::closed;
  static constexpr double pipe_diameter = 5 * diameter, pipe_length = 40 * diameter;
  static constexpr double gravity[3] = {0, 0, 0};
  static constexpr double time_step = 1e-7;  // about 1/700 of the contact time
};

/// Numbers 0 .. 19 meet the wall z = 0; 20 + 2k and 21 + 2k meet each other. All within the first 0.1 ms.
template <class Case>
Spheres oblique_impacts(Random random) {
  constexpr double d = largest_diameter<Case>;
  Spheres spheres(Case::particle_count);
  const auto any_motion = [&](Sphere& s) {
    for (int k = 0; k < 3; ++k) s.velocity[k] = random(-2, 2), s.angular_velocity[k] = random(-400, 400);
  };
  for (int k = 0; k < wall_impacts; ++k) {
    Sphere& s = spheres[k];
    s = {};
    any_motion(s);
    s.velocity[2] = -random(0.3, 3);
    s.position[0] = (k - 10) * 4 * d;
    s.position[2] = radius_of<Case>(k) - s.velocity[2] * random(0, 1e-4);
  }
  for (int k = 0; k < pair_impacts; ++k) {
    const int first = wall_impacts + 2 * k;
    Sphere &a = spheres[first], &b = spheres[first + 1];
    a = b = {};
    any_motion(a), any_motion(b);
    const double tilt = random(-1.2, 1.2), turn = random(-3, 3), approach = random(0.3, 3);
    const double n[3] = {std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn), std::cos(tilt)};
    const double way = random(0, 1e-4);  // seconds until they touch
    const double place[3] = {(k - 10) * 6 * d, 0, 0.2};
    double closing = approach;
    for (int c = 0; c < 3; ++c) closing += (b.velocity[c] - a.velocity[c]) * n[c];
    for (int c = 0; c < 3; ++c) a.velocity[c] += closing * n[c];  // now (v_a - v_b).n = approach
    for (int c = 0; c < 3; ++c) {
      a.position[c] = place[c] - radius_of<Case>(first) * n[c] - a.velocity[c] * way;
      b.position[c] = place[c] + radius_of<Case>(first + 1) * n[c] - b.velocity[c] * way;
    }
  }
  return spheres;
}

/// Kinetic energy of spheres first .. last - 1.
template <class Case>
double kinetic_energy(const Spheres& spheres, int first, int last) {
  double energy = 0;
  for (int i = first; i < last; ++i) {
    const double m = mass_of<Case>(i), r = radius_of<Case>(i);
    energy += 0.5 * m * dot(spheres[i].velocity, spheres[i].velocity) +
              0.2 * m * r * r * dot(spheres[i].angular_velocity, spheres[i].angular_velocity);
  }
  return energy;
}

}  // namespace fixdem::tests
