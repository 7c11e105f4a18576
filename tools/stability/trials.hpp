// Trials of one time step with the reference program: does it end in more energy than it should?
//
//   bed        a state at rest, pushed by 1e-9 m/s at random: small motions must die out or at least not grow
//   run        the case from its own start: kinetic and elastic energy, less the work of gravity and gas, must not rise
//   collision  one particle onto the wall, or two onto each other: none may part with more kinetic energy than it had
//
// The measured limit is found by bisection between a step that passes and one that does not.
#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "tools/run/random_numbers.hpp"
#include "tools/run/state_file.hpp"
#include "variable_case.hpp"

namespace fixdem::stability {

/// Particles and contact histories, from a file or from the start of a case.
struct Scene {
  std::vector<Particle> particles;
  std::vector<program::StoredHistory> histories;
};

inline reference::Particle copy(const Particle& p) {
  reference::Particle q{};
  for (int c = 0; c < 3; ++c) {
    q.position[c] = p.position[c], q.velocity[c] = p.velocity[c], q.angular_velocity[c] = p.angular_velocity[c];
  }
  return q;
}

/// A reference program at the present values of VariableCase, with the scene in it.
inline Reference loaded(const Scene& scene) {
  Reference program;
  for (std::size_t id = 0; id < scene.particles.size(); ++id)
    program.place(static_cast<int>(id), copy(scene.particles[id]));
  program.start();
  for (const auto& h : scene.histories) program.restore_history(h.owner, h.partner, h.history, h.rolling);
  return program;
}

/// Kinetic and elastic energy, less what gravity and gas have done: without a fault it never rises.
inline double mechanical(const Reference& program) {
  const reference::Energy e = program.energy();
  return e.kinetic + e.elastic - e.gravity_work - e.gas_work;
}

inline double maximum_overlap(const Reference& program) {
  double maximum = 0;
  program.for_each_contact([&](const reference::Contact& c) { maximum = c.overlap > maximum ? c.overlap : maximum; });
  return maximum;
}

/// Bed: kinetic energy a hundredfold of what the push gave within `steps`, or no number. With impulses springs at rest
/// are shifted by an amount that depends on the step, so the bed has to move a little; there the bound is its elastic
/// energy.
inline bool bed_is_stable(Scene scene, long long steps) {
  constexpr double push = 1e-9;  // m/s
  program::RandomNumbers random(1);
  for (Particle& p : scene.particles)
    for (int c = 0; c < 3; ++c) p.velocity[c] = random.between(-push, push), p.angular_velocity[c] = 0;
  Reference program = loaded(scene);
  double maximum = 100 * program.energy().kinetic;
  if (VariableCase::integrator == Integrator::impulse) {
    program.run(1);
    maximum = program.energy().elastic;
  }
  for (long long done = 0; done < steps; done += 50) {
    program.run(50);
    if (!(program.energy().kinetic <= maximum)) return false;
  }
  return true;
}

/// Own start for `duration`: mechanical energy 5 % above its start (relative to the largest of start, gravity's and
/// gas's work), an overlap beyond the case's limit, or no number.
inline bool run_is_stable(const Scene& scene, double duration) {
  Reference program = loaded(scene);
  program.run(1);  // elastic energy is that of the last forces, and before the first step there are none
  const double begin = mechanical(program);
  double scale = std::fabs(begin);
  const auto steps = static_cast<long long>(duration / VariableCase::time_step);
  for (long long done = 0; done < steps; done += 20) {
    program.run(20);
    const reference::Energy e = program.energy();
    scale = std::fmax(scale, std::fmax(std::fabs(e.gravity_work), std::fabs(e.gas_work)));
    if (!(mechanical(program) <= begin + 0.05 * scale)) return false;
    if (!(maximum_overlap(program) <= Case::max_overlap * Case::diameter / 2)) return false;
  }
  return true;
}

/// A collision at `speed` and `angle` from the normal; of two particles with each other, or of one with the pipe's wall
/// (with an end, where there is no pipe wall).
struct Impact {
  bool is_pair;
  double speed, angle;
};

inline Scene impact_scene(const Impact& impact, double gap) {
  const double d = VariableCase::diameter, middle = Case::pipe_length / 2;
  const double along = impact.speed * std::cos(impact.angle), across = impact.speed * std::sin(impact.angle);
  Scene scene;
  scene.particles.resize(impact.is_pair ? 2 : 1);
  if (impact.is_pair) {
    for (int k = 0; k < 2; ++k) {
      const double side = k == 0 ? -1 : 1;
      scene.particles[static_cast<std::size_t>(k)].position[2] = middle + side * (d + gap) / 2;
      scene.particles[static_cast<std::size_t>(k)].velocity[2] = -side * along / 2;
      scene.particles[static_cast<std::size_t>(k)].velocity[0] = -side * across / 2;
    }
  } else {
    scene.particles[0].position[0] = Case::pipe_diameter / 2 - d / 2 - gap;
    scene.particles[0].position[2] = middle;
    scene.particles[0].velocity[0] = along;
    scene.particles[0].velocity[2] = across;
  }
  return scene;
}

struct Rebound {
  double energy_ratio;      ///< kinetic energy after over before
  double created;           ///< (after + dissipated - before) / before
  double tangential_share;  ///< of the energy before
  double maximum_overlap;
};

/// The impact is followed until the contact has opened, or for 100 000 steps (then nothing is a number).
inline Rebound rebound(const Impact& impact, double phase) {
  for (double& g : VariableCase::gravity) g = 0;
  VariableCase::particle_count = impact.is_pair ? 2 : 1;
  Reference program =
      loaded(impact_scene(impact, phase * impact.speed * std::cos(impact.angle) * VariableCase::time_step));
  const double before = program.energy().kinetic;
  double deepest = 0;
  bool has_touched = false;
  for (int step = 0; step < 100000; ++step) {
    program.run(1);
    const double overlap = maximum_overlap(program);
    deepest = std::fmax(deepest, overlap);
    if (overlap > 0) has_touched = true;
    if (has_touched && !(overlap > 0)) {
      const reference::Energy e = program.energy();
      const double sine = std::sin(impact.angle);
      return {e.kinetic / before,
              (e.kinetic + e.dissipated_damping + e.dissipated_sliding + e.dissipated_rolling - before) / before,
              sine * sine, deepest};
    }
  }
  return {NAN, NAN, NAN, NAN};
}

inline bool collision_is_stable(const Impact& impact) {
  constexpr int phases = 16;
  for (int k = 0; k < phases; ++k)
    if (!(rebound(impact, (k + 0.5) / phases).energy_ratio <= 1 + 1e-9)) return false;
  return true;
}

/// Maximum stable step between `low` and `high`, to `accuracy`; the ends are moved until one passes and one does not.
inline double measured_limit(double low, double high, double accuracy, const std::function<bool()>& is_stable) {
  const auto passes = [&](double h) {
    VariableCase::time_step = h;
    return is_stable();
  };
  while (!passes(low)) {
    high = low, low *= 0.8;
    if (low < 1e-15) return NAN;
  }
  while (passes(high)) {
    low = high, high *= 1.25;
    if (high > 1e6) return INFINITY;
  }
  while (high > (1 + accuracy) * low) {
    const double middle = std::sqrt(low * high);
    (passes(middle) ? low : high) = middle;
  }
  return low;
}

}  // namespace fixdem::stability
