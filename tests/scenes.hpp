// Starts for the tests: spheres in layers or at random, and the hand-over of a running state to another solver.
//
// Layers suit the shipped pipe of five diameters: 19 spheres fit in a cross section (1 + 6 + 12), a tenth of a
// millimetre clear of each other and of the wall, so they meet within a few milliseconds. Random seeds come from the
// command (support.hpp).
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "support.hpp"

namespace fixdem::tests {

struct Sphere {
  double position[3];
  double velocity[3];
  double angular_velocity[3];
};
using Spheres = std::vector<Sphere>;

/// Velocity components within +-`speed`, spins (where there is friction) within +-`speed` over the radius.
template <class Case>
void agitate(Spheres& spheres, double speed, Random& random) {
  for (int i = 0; i < Case::particle_count; ++i) {
    Sphere& s = spheres[i];
    for (int k = 0; k < 3; ++k) {
      s.velocity[k] = random(-speed, speed);
      const double spin = random(-speed, speed) / radius_of<Case>(i);
      s.angular_velocity[k] = Derived<Case>::has_rotation ? spin : 0;
    }
  }
}

/// Layers of 19 across a pipe of five diameters (of the largest), `pitch` (m) apart, the first half a pitch from z = 0.
template <class Case>
Spheres layered_spheres(double pitch, double speed, Random random) {
  constexpr double d = largest_diameter<Case>, inner = 1.02 * d, outer = 1.99 * d, tau = 2 * std::numbers::pi;
  Spheres spheres(Case::particle_count);
  double turn = 0;
  for (int i = 0; i < Case::particle_count; ++i) {
    const int layer = i / 19, place = i % 19;
    if (place == 0) turn = random(0, tau);
    const double radius = place == 0 ? 0 : place < 7 ? inner : outer;
    const double angle = turn + tau * (place < 7 ? (place - 1) / 6.0 : (place - 7 + 0.5) / 12.0);
    const double slack = std::min(0.45 * (pitch - 1.01 * d), 0.2 * d);
    spheres[i] = {};
    spheres[i].position[0] = radius * std::cos(angle);
    spheres[i].position[1] = radius * std::sin(angle);
    spheres[i].position[2] = (layer + 0.5) * pitch + random(-slack, slack);
  }
  agitate<Case>(spheres, speed, random);
  return spheres;
}

/// Spheres at random places in the pipe, none touching another or a wall; the largest are placed first.
template <class Case>
Spheres random_spheres(double speed, Random random) {
  constexpr double L = Case::pipe_length;
  std::vector<int> order(Case::particle_count);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [](int i, int j) { return diameter_of<Case>(i) > diameter_of<Case>(j); });
  Spheres spheres(Case::particle_count);
  int placed = 0;
  for (int attempt = 0; attempt < 2000000 && placed < Case::particle_count; ++attempt) {
    const double r = radius_of<Case>(order[placed]), reach = Case::pipe_diameter / 2 - r;
    Sphere s{};
    for (int k = 0; k < 2; ++k) s.position[k] = random(-reach, reach);
    s.position[2] = Case::ends == Ends::closed ? random(r, L - r) : random(0, L);
    const bool inside = std::hypot(s.position[0], s.position[1]) < reach;
    const bool free = std::none_of(order.begin(), order.begin() + placed, [&](int id) {
      const Sphere& other = spheres[id];
      const double between[3] = {s.position[0] - other.position[0], s.position[1] - other.position[1],
                                 axial_difference<Case>(s.position[2], other.position[2])};
      const double touch = r + radius_of<Case>(id);
      return dot(between, between) < touch * touch;
    });
    if (inside && free) spheres[order[placed++]] = s;
  }
  REQUIRE(placed == Case::particle_count);
  agitate<Case>(spheres, speed, random);
  return spheres;
}

template <class Solver>
void place_all(Solver& solver, const Spheres& spheres) {
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const Sphere& s = spheres[i];
    solver.place(static_cast<int>(i), {{s.position[0], s.position[1], s.position[2]},
                                       {s.velocity[0], s.velocity[1], s.velocity[2]},
                                       {s.angular_velocity[0], s.angular_velocity[1], s.angular_velocity[2]}});
  }
}

template <class Solver>
Spheres all_particles(const Solver& solver, int count) {
  Spheres spheres;
  for (int i = 0; i < count; ++i) {
    const auto p = solver.particle(i);
    Sphere s{};
    for (int k = 0; k < 3; ++k) {
      s.position[k] = p.position[k], s.velocity[k] = p.velocity[k], s.angular_velocity[k] = p.angular_velocity[k];
    }
    spheres.push_back(s);
  }
  return spheres;
}

struct KeptHistory {
  int owner, partner;
  double history[3], rolling[3];
};

/// Everything that another solver needs to go on: spheres and contact histories.
struct HandOver {
  Spheres spheres;
  std::vector<KeptHistory> histories;
};

template <class Solver>
HandOver hand_over_from(const Solver& solver, int count) {
  HandOver state{all_particles(solver, count), {}};
  solver.for_each_contact([&](const auto& c) {
    KeptHistory kept{c.owner, c.partner, {}, {}};
    for (int k = 0; k < 3; ++k) kept.history[k] = c.history[k], kept.rolling[k] = c.rolling_history[k];
    state.histories.push_back(kept);
  });
  return state;
}

template <class Solver>
void start_from(Solver& solver, const HandOver& state) {
  place_all(solver, state.spheres);
  start(solver);
  for (const KeptHistory& h : state.histories) solver.restore_history(h.owner, h.partner, h.history, h.rolling);
}

}  // namespace fixdem::tests
