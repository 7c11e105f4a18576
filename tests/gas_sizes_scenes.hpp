// One slice of bed with two sizes, floaters and drag, written once for the kernel and for the reference.
//
// In a pipe of 50 mm with slices of 10 mm and air at 2.4 m/s; figures by another program from the same equations.
// Forces are read off the change of velocity in the first step, in which nothing touches.
#pragma once

#include <algorithm>
#include <cmath>

#include "listed_sizes.hpp"
#include "scenes.hpp"

namespace fixdem::tests {

struct air_in_pipe : short_pipe {
  static constexpr bool has_gas = true;
  static constexpr double gas_velocity = 2.4, gas_density = 1.2, gas_viscosity = 1.5e-5;
  static constexpr double pipe_length = 0.04, time_step = 1e-5;
  static constexpr int slice_count = 4;
};
struct nine_and_forty {
  static constexpr const char* name = "a full slice of two sizes";
  static constexpr int species_count = 2;
  static constexpr const char* species_names[] = {"10 mm", "5 mm"};
  static constexpr SizeRun sizes[] = {{9, 0.010, 1000, 0}, {40, 0.005, 1000, 1}};
};
struct five_and_sixteen : nine_and_forty {
  static constexpr const char* name = "a bed of two sizes, 27 mm high";
  static constexpr SizeRun sizes[] = {{5, 0.010, 1000, 0}, {16, 0.005, 1000, 1}};
};
struct full_slice : sized<nine_and_forty, air_in_pipe> {
  static constexpr double velocities[] = {0.5, 0.7}, height = 0.05;
};
struct half_slice : sized<five_and_sixteen, air_in_pipe> {
  static constexpr double velocities[] = {0.1, 0.2}, height = 0.027;
};

/// At random in the slice from 10 to 20 mm, below Case::height and each near another, so that none floats and none
/// touches; the last one reaches that height, or almost where the pipe is full.
template <class Case>
Spheres slice_of_spheres(Random random) {
  constexpr double R = Case::pipe_diameter / 2;
  const int count = Case::particle_count, top = count - 1;
  Spheres spheres(count);
  const auto is_placed = [&](int id, int placed) { return id < placed || id == top; };
  spheres[top] = {};
  spheres[top].position[1] = std::min(Case::height - R - radius_of<Case>(top), R - 1.01 * radius_of<Case>(top));
  spheres[top].position[2] = 0.015;
  spheres[top].velocity[2] = Case::velocities[species_of<Case>(top)];
  int id = 0;
  for (int attempt = 0; attempt < 5000000 && id < top; ++attempt) {
    Sphere s{};
    const double r = radius_of<Case>(id), reach = R - 1.01 * r;
    for (int k = 0; k < 2; ++k) s.position[k] = random(-reach, reach);
    s.position[2] = random(0.0101, 0.0199), s.velocity[2] = Case::velocities[species_of<Case>(id)];
    if (std::hypot(s.position[0], s.position[1]) > reach || s.position[1] + R + r > Case::height) continue;
    double nearest = 2;  // over the distance at touch
    for (int other = 0; other < count; ++other) {
      if (!is_placed(other, id)) continue;
      double between[3];
      for (int k = 0; k < 3; ++k) between[k] = s.position[k] - spheres[other].position[k];
      nearest = std::min(nearest, length(between) / (r + radius_of<Case>(other)));
    }
    if (nearest > 1.001 && nearest < 1.095) spheres[id++] = s;
  }
  REQUIRE(id == top);
  return spheres;
}

/// Force along the pipe of the step that led from `before` to `after`, N.
template <class Case, class P>
double axial_force(int id, const Sphere& before, const P& after) {
  return mass_of<Case>(id) * (after.velocity[2] - before.velocity[2]) / Case::time_step;
}

/// The solver has made one step; forces are those on a sphere of 10 and of 5 mm.
template <class Case, class Solver>
void check_slice(Solver& solver, double force_on_large, double force_on_small) {
  enter({Case::name, seed()});
  const Spheres spheres = slice_of_spheres<Case>(Random(seed()));
  place_all(solver, spheres);
  start(solver);
  run(solver, 1);
  for (int id = 0; id < Case::particle_count; ++id) {
    const double expected = species_of<Case>(id) == 0 ? force_on_large : force_on_small;
    CHECK(axial_force<Case>(id, spheres[id], solver.particle(id)) == doctest::Approx(expected).epsilon(2e-9));
  }
}

struct watched_sizes {
  static constexpr const char* name = "floaters of several sizes";
  static constexpr int species_count = 2;
  static constexpr const char* species_names[] = {"10 mm", "4 mm"};
  static constexpr SizeRun sizes[] = {{3, 0.010, 1000, 0}, {4, 0.004, 1000, 1}};
};
struct watched_gas : sized<watched_sizes, air_in_pipe> {
  static constexpr double pipe_length = 0.3;
  static constexpr int slice_count = 30;
};

/// Which of them float: within 1.1 times the sum of radii of another, or on the bottom, none does.
template <class Solver, class Floats>
void check_floaters(Solver& solver, Floats floats) {
  enter({watched_gas::name, 0});
  constexpr double large = 0.005, small = 0.002, R = watched_gas::pipe_diameter / 2;
  for (const double apart : {1.09, 1.11}) {
    solver.place(0, {{0, 0, 0.05}, {0, 0, 0.3}, {0, 0, 0}});  // alone
    solver.place(1, {{0, 0, 0.10}, {0, 0, 0}, {0, 0, 0}});    // with 4 beside it
    solver.place(4, {{0, 0, 0.10 + apart * (large + small)}, {0, 0, 0}, {0, 0, 0}});
    solver.place(2, {{0, 0.01, 0.15}, {0, 0, 0}, {0, 0, 0}});
    solver.place(3, {{0, 0, 0.20}, {0, 0, 0.3}, {0, 0, 0}});                  // alone
    solver.place(5, {{0, -(R - small) - 1e-7, 0.25}, {0, 0, 0}, {0, 0, 0}});  // on the bottom
    solver.place(6, {{0, -(R - large) - 1e-7, 0.28}, {0, 0, 0}, {0, 0, 0}});  // where a large one would touch it
    start(solver);
    run(solver, 1);
    const bool both = apart > 1.1, expected[] = {true, both, true, true, both, false, true};
    for (int id = 0; id < watched_gas::particle_count; ++id) {
      CAPTURE(id);
      CHECK(floats(id) == expected[id]);
    }
  }
  // Drag of 10 and of 4 mm, both at 2.1 m/s through the gas of an empty slice.
  for (const int id : {0, 3}) {
    const double d = diameter_of<watched_gas>(id), u = 2.4 - 0.3, re = u * d / watched_gas::gas_viscosity;
    const double c_d = re < 1000 ? 24 / re * (1 + 0.15 * std::pow(re, 0.687)) : 0.44;
    const double drag = c_d * 3.14159265358979324 * d * d / 8 * watched_gas::gas_density * u * u;
    const Sphere before{{0, 0, 0}, {0, 0, 0.3}, {0, 0, 0}};
    CHECK(axial_force<watched_gas>(id, before, solver.particle(id)) == doctest::Approx(drag).epsilon(1e-9));
  }
}

}  // namespace fixdem::tests
