// Head-on impacts that must return the restitution asked, written once for the kernel and for the reference.
//
// The damping of eq. (26) with the closed form of alpha, eq. (30), makes the restitution independent of speed and
// material: four speeds over three decades, pairs and wall impacts, in one simulation each. SI units.
//
// A coarser step is off by more, and by how much depends on the phase of the first contact in the step: see
// restitution_error, which acceptance_test.cpp evaluates at 1/41, 1/8 and 1/4 of the contact time.
#pragma once

#include <array>

#include "cases/collide_wall.hpp"
#include "recorded.hpp"
#include "support.hpp"
#include "tools/run/contact_time.hpp"

namespace fixdem::tests {

/// Contact time under Hertz' law with e = 1; reduced modulus, radius and mass.
inline double contact_time_of(double modulus, double radius, double mass, double speed) {
  return hertz_contact_time(mass, 4.0 / 3.0 * modulus * std::sqrt(radius), speed);
}

inline constexpr std::array impact_speeds = {0.01, 0.1, 1.0, 10.0};

/// Materials, with the contact time of a pair that meets at 10 m/s or of a wall impact, whichever is shorter.
struct shipped_material : cases::collide_wall {
  static constexpr double shortest_contact = 4.5e-5;
};
struct large_aluminium : cases::collide_wall {
  static constexpr double diameter = 0.2, density = 2699, youngs_modulus = 70e9, poisson_ratio = 0.30;
  static constexpr double wall_youngs_modulus = __builtin_inf(), wall_poisson_ratio = 0.30;
  static constexpr double shortest_contact = 3.3e-4;
};
struct small_rubber : cases::collide_wall {
  static constexpr double diameter = 1e-4, density = 1200, youngs_modulus = 1e9, poisson_ratio = 0.48;
  static constexpr double wall_youngs_modulus = 1e9, wall_poisson_ratio = 0.48;
  static constexpr double shortest_contact = 7e-7;
};

/// Four spheres against the end wall and four pairs head on, at the four speeds; restitution in thousandths. The time
/// step is 1/1000 (Euler) or 1/200 (leapfrog) of the contact time of the fastest, less of the slower ones'.
template <int restitution_permille, Integrator chosen, class Material = shipped_material>
struct impacts : Material {
  static constexpr int particle_count = 12;
  static constexpr double restitution = restitution_permille / 1000.0;
  static constexpr Integrator integrator = chosen;
  static constexpr bool has_wall = false;
  static constexpr Ends ends = Ends::closed;
  static constexpr double pipe_diameter = 5 * Material::diameter;
  static constexpr double pipe_length = 40 * Material::diameter;
  static constexpr double gravity[3] = {0, 0, 0};
  static constexpr double time_step = Material::shortest_contact / (chosen == Integrator::euler ? 1000 : 200);
};

/// Every impact returns the restitution asked to 1e-3.
template <template <class> class Solver, class Case>
void check_restitution(const Table& table = unrecorded) {
  enter({Case::name, 0});
  static Solver<Case> solver;
  const double d = Case::diameter, r = d / 2, dt = Case::time_step;
  const double compliance = (1 - Case::poisson_ratio * Case::poisson_ratio) / Case::youngs_modulus;
  const double wall_compliance = (1 - Case::wall_poisson_ratio * Case::wall_poisson_ratio) / Case::wall_youngs_modulus;
  const double mass = 3.14159265358979323846 / 6 * d * d * d * Case::density;
  REQUIRE(Case::shortest_contact < contact_time_of(1 / (2 * compliance), r / 2, mass / 2, 10));
  REQUIRE(Case::shortest_contact < contact_time_of(1 / (compliance + wall_compliance), r, mass, 10));
  for (int k = 0; k < 4; ++k) {
    const double v = impact_speeds[k], gap = (0.13 + 0.2 * k) * v * dt;  // first contact at a different phase each
    const double x = (3 * k - 4) * d;
    solver.place(k, {{x, 0, r + gap}, {0, 0, -v}, {0, 0, 0}});
    solver.place(4 + 2 * k, {{x, 0, 20 * d}, {0, 0, v / 2}, {0, 0, 0}});
    solver.place(5 + 2 * k, {{x, 0, 21 * d + gap}, {0, 0, -v / 2}, {0, 0, 0}});
  }
  start(solver);
  const auto gap_of = [&](int k, bool pair) {
    return pair ? solver.particle(5 + 2 * k).position[2] - solver.particle(4 + 2 * k).position[2] - d
                : solver.particle(k).position[2] - r;
  };
  const auto parting_speed = [&](int k, bool pair) {
    return pair ? solver.particle(5 + 2 * k).velocity[2] - solver.particle(4 + 2 * k).velocity[2]
                : solver.particle(k).velocity[2];
  };
  // Run in pieces until all have parted: far less than the time in which the fastest crosses its free way.
  const auto parted = [&] {
    for (int k = 0; k < 4; ++k) {
      for (bool pair : {false, true}) {
        if (gap_of(k, pair) <= 0 || parting_speed(k, pair) <= 0) return false;
      }
    }
    return true;
  };
  for (int piece = 0; piece < 400 && !parted(); ++piece) run(solver, 100);
  REQUIRE(parted());
  WorstFigures worst(table, "e = " + in_words(Case::restitution));
  for (int k = 0; k < 4; ++k) {
    for (bool pair : {false, true}) {
      const double e = parting_speed(k, pair) / impact_speeds[k];
      worst.check((pair ? "pair at " : "wall at ") + in_words(impact_speeds[k]) + " m/s",
                  {"rebound over impact velocity", ""}, Case::restitution, e, 1e-3);
    }
  }
}

/// 32 spheres of the shipped material against the wall at 1 m/s, restitution 0.9, at as many phases of the step.
template <int step_in_hundred_ns, Integrator chosen>
struct phases : cases::collide_wall {
  static constexpr int particle_count = 32;
  static constexpr Integrator integrator = chosen;
  static constexpr bool has_wall = false;
  static constexpr Ends ends = Ends::closed;
  static constexpr double gravity[3] = {0, 0, 0};
  static constexpr double time_step = step_in_hundred_ns * 1e-7;
};

/// Root mean square error of the restitution over the phases.
template <template <class> class Solver, class Case>
double restitution_error() {
  enter({Case::name, 0});
  static Solver<Case> solver;
  const double d = Case::diameter;
  for (int k = 0; k < Case::particle_count; ++k) {
    solver.place(k, {{2 * d * (k - 16), 0, d / 2 + Case::time_step * (1 + k / 32.0)}, {0, 0, -1}, {0, 0, 0}});
  }
  start(solver);
  run(solver, static_cast<long long>(3e-4 / Case::time_step));
  double squares = 0;
  for (int k = 0; k < Case::particle_count; ++k) {
    REQUIRE(solver.particle(k).position[2] > d / 2);
    squares += std::pow(solver.particle(k).velocity[2] - Case::restitution, 2);
  }
  return std::sqrt(squares / Case::particle_count);
}

}  // namespace fixdem::tests
