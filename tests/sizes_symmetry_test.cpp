// Numbers, sides and the way in which sizes are listed do not matter.
#include <algorithm>
#include <cmath>

#include "sized_impacts.hpp"
#include "sizes_scenes.hpp"

namespace fixdem::tests {
namespace {

double maximum_difference(const Spheres& a, const Spheres& b) {
  double maximum = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (int c = 0; c < 3; ++c)
      for (const double difference : {(a[i].position[c] - b[i].position[c]) * 1e3, a[i].velocity[c] - b[i].velocity[c],
                                      (a[i].angular_velocity[c] - b[i].angular_velocity[c]) * 0.005}) {
        CHECK(std::isfinite(difference));
        maximum = std::max(maximum, std::abs(difference));  // m/s; places over 1 ms
      }
  return maximum;
}

template <Integrator scheme>
struct impacts_by : sized_impacts {
  static constexpr Integrator integrator = scheme;
  static constexpr double rolling_friction = 0.1;
};

/// Seen in a mirror across the pipe each sphere of a pair takes the place of the other. Places round differently, and a
/// contact that begins in an overlap of 1e-17 m is damped by its fourth root.
template <class Case>
void check_mirror() {
  const auto mirror = [](Spheres spheres) {
    for (Sphere& s : spheres) {
      s.position[2] = Case::pipe_length - s.position[2], s.velocity[2] = -s.velocity[2];
      for (int c = 0; c < 2; ++c) s.angular_velocity[c] = -s.angular_velocity[c];
    }
    return spheres;
  };
  const Spheres before = oblique_impacts<Case>(Random(seed()));
  CHECK(maximum_difference(mirror(after_impacts<Case>(before)), after_impacts<Case>(mirror(before))) < 1e-8);
}

TEST_CASE("sizes: impacts seen in a mirror") {
  check_mirror<impacts_by<Integrator::euler>>();
  check_mirror<impacts_by<Integrator::leapfrog>>();
  check_mirror<impacts_by<Integrator::impulse>>();
}

struct one_way : sized<two_sizes, closed_pipe> {};
struct the_other : sized<exchanged, closed_pipe> {};

TEST_CASE("sizes: other numbers, the same motion, exactly") {
  constexpr int large = 45, count = one_way::particle_count;
  const auto renumbered = [](const Spheres& spheres) {
    Spheres out(spheres.begin() + large, spheres.end());
    out.insert(out.end(), spheres.begin(), spheres.begin() + large);
    return out;
  };
  enter({one_way::name, seed()});
  const Spheres spheres = random_spheres<one_way>(0.5, Random(seed()));
  place_all(kernel<one_way>(), spheres);
  place_all(kernel<the_other>(), renumbered(spheres));
  start(kernel<one_way>()), start(kernel<the_other>());
  run(kernel<one_way>(), 5000), run(kernel<the_other>(), 5000);
  CHECK(kernel<one_way>().energy().dissipated_damping > 0);
  CHECK(maximum_difference(renumbered(all_particles(kernel<one_way>(), count)),
                           all_particles(kernel<the_other>(), count)) == 0);
}

// ---- one size listed as several ------------------------------------------------------------------------------------

template <class Rest>
struct plain : Rest {
  static constexpr const char* name = "one size";
  static constexpr int particle_count = 110;
  static constexpr double diameter = 0.008, density = 1200;
  static constexpr int neighbour_capacity = 14;
};
template <class Base, Integrator scheme>
struct moved_by : Base {
  static constexpr Integrator integrator = scheme;
  static constexpr double rolling_friction = 0.1, wall_friction = 0.2;
};

template <class Rest>
void check_equal() {
  using Plain = plain<Rest>;
  using Listed = sized<equal_runs, Rest>;
  enter({Listed::name, seed()});
  const Spheres spheres = random_spheres<Plain>(1, Random(seed()));
  const auto after = [&]<class Solver>(Solver& solver, int steps) {
    place_all(solver, spheres);
    start(solver);
    run(solver, steps);
    return all_particles(solver, Plain::particle_count);
  };
  CHECK(maximum_difference(after(kernel<Plain>(), 800), after(kernel<Listed>(), 800)) < 1e-12);
  CHECK(kernel<Plain>().energy().dissipated_damping > 0);
  CHECK(kernel<Listed>().energy().kinetic == doctest::Approx(kernel<Plain>().energy().kinetic).epsilon(1e-12));
  // The reference writes eqs. (42)-(46) so that they round as the equations of equal spheres do.
  static reference::Reference<Plain> program;
  static reference::Reference<Listed> listed;
  CHECK(maximum_difference(after(program, 200), after(listed, 200)) == 0);
}

TEST_CASE("sizes: equal ones listed as several move as one size does") {
  check_equal<short_pipe>();
  check_equal<moved_by<closed_pipe, Integrator::leapfrog>>();
  check_equal<moved_by<closed_pipe, Integrator::impulse>>();
  check_equal<gas_pipe>();
}

}  // namespace
}  // namespace fixdem::tests
