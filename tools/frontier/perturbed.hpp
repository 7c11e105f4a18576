// The start of the comparisons of trajectories: a stored state whose particles were given a push.
//
// To each component of every velocity a random number within +-`push` is added, from a seed of its own: contacts open,
// close, slide and turn all over the scene, many at a time. Positions, spins and contact histories are those of the
// stored state.
#pragma once

#include <stdexcept>
#include <string>

#include "tools/run/random_numbers.hpp"
#include "tools/run/state_file.hpp"

namespace fixdem::frontier {

inline constexpr double push = 0.05;  // m/s
inline constexpr unsigned long long push_seed = 1;

/// Moments of comparison: 1, 5 and 10 ms, in units of twenty steps of the case so that every time step meets them.
inline constexpr double moments[] = {1e-3, 5e-3, 10e-3};
template <class Case>
long long case_steps_until(double time) {
  return 20 * static_cast<long long>(time / (20 * Case::time_step) + 0.5);
}

inline program::StoredState stored_state(const char* path, int particles) {
  program::StoredState state = program::read_state(path);
  if (static_cast<int>(state.particles.size()) != particles)
    throw std::runtime_error(std::string(path) + " has another number of particles than the case");
  return state;
}

inline program::StoredState perturbed(program::StoredState state, double speed = push,
                                      unsigned long long seed = push_seed) {
  program::RandomNumbers random(seed);
  for (Particle& p : state.particles)
    for (double& v : p.velocity) v += random.between(-speed, speed);
  return state;
}

/// Starts a solver (the kernel's or the reference) from it.
template <class Solver>
auto start_from(Solver& solver, const program::StoredState& state) {
  for (int id = 0; id < static_cast<int>(state.particles.size()); ++id) {
    const Particle& p = state.particles[static_cast<std::size_t>(id)];
    solver.place(id, {{p.position[0], p.position[1], p.position[2]},
                      {p.velocity[0], p.velocity[1], p.velocity[2]},
                      {p.angular_velocity[0], p.angular_velocity[1], p.angular_velocity[2]}});
  }
  const auto restore = [&] {
    for (const auto& h : state.histories) solver.restore_history(h.owner, h.partner, h.history, h.rolling);
  };
  if constexpr (requires { solver.start().ok(); }) {
    const auto status = solver.start();
    if (status.ok()) restore();
    return status;
  } else {
    solver.start();
    restore();
  }
}

}  // namespace fixdem::frontier
