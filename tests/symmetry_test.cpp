// The kernel has no preferred direction, place or numbering: a transformed state gives the transformed result.
//
// What is exact in floating point must come out exactly: changing signs (mirror) and renumbering (particles are sorted
// along the pipe, so the order of all sums stays). What rounds anew, a turned or shifted state, must agree as closely
// as kernel and reference do: to 1e-11 diameters after 1000 steps. Then, what rests stays at rest.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "cases/plug_u24.hpp"
#include "small_scene.hpp"

namespace fixdem::tests {
namespace {

struct weightless : small_periodic {
  static constexpr double gravity[3] = {0, 0, 0};
};
struct weightless_closed : small_closed {
  static constexpr double gravity[3] = {0, 0, 0};
  static constexpr TangentialLaw tangential = TangentialLaw::rescale;
  static constexpr Integrator integrator = Integrator::leapfrog;
};
struct gas_scene : cases::plug_u24 {
  static constexpr int particle_count = 133;
  static constexpr double pipe_length = 0.10;
  static constexpr int slice_count = 10;
};

/// A running state with histories, and the state 1000 steps later.
template <class Case>
struct Course {
  HandOver begin;
  Spheres end;
};

template <class Case>
Spheres after_1000_steps(const HandOver& begin) {
  start_from(kernel<Case>(), begin);
  run(kernel<Case>(), 1000);
  return all_particles(kernel<Case>(), Case::particle_count);
}

template <class Case>
Course<Case> course() {
  enter({Case::name, seed()});
  place_all(kernel<Case>(), layered_spheres<Case>(Case::pipe_length / 7, 0.5, Random(seed())));
  start(kernel<Case>());
  run(kernel<Case>(), 3000);
  Course<Case> c;
  c.begin = hand_over_from(kernel<Case>(), Case::particle_count);
  REQUIRE(!c.begin.histories.empty());
  c.end = after_1000_steps<Case>(c.begin);
  return c;
}

/// Applies `vector` to places, velocities and histories, `axial_vector` to spins.
template <class Vector, class AxialVector>
void transform(Spheres& spheres, Vector vector, AxialVector axial_vector) {
  for (Sphere& s : spheres) vector(s.position), vector(s.velocity), axial_vector(s.angular_velocity);
}
template <class Vector, class AxialVector>
HandOver transformed(HandOver state, Vector vector, AxialVector axial_vector) {
  transform(state.spheres, vector, axial_vector);
  for (KeptHistory& h : state.histories) vector(h.history);
  return state;
}

template <class Case>
double maximum_distance(const Spheres& a, const Spheres& b) {
  double maximum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double between[3] = {a[i].position[0] - b[i].position[0], a[i].position[1] - b[i].position[1],
                               axial_difference<Case>(a[i].position[2], b[i].position[2])};
    if (!std::isfinite(length(between))) return length(between);
    maximum = std::max(maximum, length(between) / Case::diameter);
  }
  return maximum;
}

bool same(const Spheres& a, const Spheres& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      if (a[i].position[k] != b[i].position[k] || a[i].velocity[k] != b[i].velocity[k] ||
          a[i].angular_velocity[k] != b[i].angular_velocity[k]) {
        return false;
      }
    }
  }
  return true;
}

template <class Case>
void check_rotation() {
  Course<Case> c = course<Case>();
  for (const double angle : {0.7, 2.5}) {
    const double cosine = std::cos(angle), sine = std::sin(angle);
    const auto turn = [&](double* v) {
      const double x = v[0];
      v[0] = cosine * x - sine * v[1];
      v[1] = sine * x + cosine * v[1];
    };
    const Spheres found = after_1000_steps<Case>(transformed(c.begin, turn, turn));
    Spheres expected = c.end;
    transform(expected, turn, turn);
    CHECK(maximum_distance<Case>(found, expected) < 1e-11);
  }
}

TEST_CASE("symmetry: rotation about the axis without gravity") {
  check_rotation<weightless>();
  check_rotation<weightless_closed>();
}

template <class Case>
void check_mirror() {
  Course<Case> c = course<Case>();
  const auto flip = [](double* v) { v[0] = -v[0]; };
  const auto flip_axial = [](double* v) { v[1] = -v[1], v[2] = -v[2]; };
  const Spheres found = after_1000_steps<Case>(transformed(c.begin, flip, flip_axial));
  CHECK_FALSE(same(found, c.end));
  transform(c.end, flip, flip_axial);
  CHECK(same(found, c.end));
}

TEST_CASE("symmetry: mirror in x, exactly") {
  check_mirror<small_periodic>();
  check_mirror<weightless_closed>();
  check_mirror<gas_scene>();
}

template <class Case>
void check_shift(double shift) {
  Course<Case> c = course<Case>();
  const auto moved = [&](Spheres spheres) {
    for (Sphere& s : spheres) {
      s.position[2] += shift;
      if (s.position[2] >= Case::pipe_length) s.position[2] -= Case::pipe_length;
    }
    return spheres;
  };
  HandOver begin = c.begin;
  begin.spheres = moved(begin.spheres);
  CHECK(maximum_distance<Case>(after_1000_steps<Case>(begin), moved(c.end)) < 1e-11);
}

TEST_CASE("symmetry: shift along a periodic pipe") {
  check_shift<small_periodic>(0.0123);
  check_shift<small_periodic>(0.0571);
  check_shift<gas_scene>(3 * gas_scene::pipe_length / gas_scene::slice_count);  // slices onto slices
}

template <class Case>
void check_renumbering() {
  Course<Case> c = course<Case>();
  std::vector<int> number(Case::particle_count);  // new number of each
  std::iota(number.begin(), number.end(), 0);
  Random random(seed() + 1);
  for (int i = Case::particle_count - 1; i > 0; --i) std::swap(number[i], number[static_cast<int>(random(0, i + 1))]);

  HandOver begin = c.begin;
  Spheres expected = c.end;
  for (int i = 0; i < Case::particle_count; ++i) {
    begin.spheres[number[i]] = c.begin.spheres[i];
    expected[number[i]] = c.end[i];
  }
  for (KeptHistory& h : begin.histories) {
    h.owner = number[h.owner];
    if (h.partner >= 0) h.partner = number[h.partner];
  }
  CHECK(same(after_1000_steps<Case>(begin), expected));

  // Handing a pair's history over from the other side is the same, too.
  for (KeptHistory& h : begin.histories) {
    if (h.partner < 0) continue;
    std::swap(h.owner, h.partner);
    for (double& component : h.history) component = -component;
  }
  CHECK(same(after_1000_steps<Case>(begin), expected));
}

TEST_CASE("symmetry: renumbering, exactly") {
  check_renumbering<small_periodic>();
  check_renumbering<weightless_closed>();
  check_renumbering<gas_scene>();
}

TEST_CASE("rest: what does not touch and is not pulled stays exactly where it is") {
  enter({weightless::name, seed()});
  Spheres spheres = layered_spheres<weightless>(weightless::pipe_length / 7, 0, Random(seed()));
  place_all(kernel<weightless>(), spheres);
  start(kernel<weightless>());
  run(kernel<weightless>(), 5000);
  CHECK(same(all_particles(kernel<weightless>(), weightless::particle_count), spheres));
}

struct still_gas : gas_scene {
  static constexpr double gas_velocity = 0;
  static constexpr bool is_coupled = true;  // a gas is for a bed, which needs weight; it is taken away below
};

TEST_CASE("rest: still gas moves nothing") {
  enter({still_gas::name, seed()});
  Spheres spheres = layered_spheres<still_gas>(still_gas::pipe_length / 7, 0, Random(seed()));
  place_all(kernel<still_gas>(), spheres);
  start(kernel<still_gas>());
  kernel<still_gas>().set_gravity({0, 0, 0});
  run(kernel<still_gas>(), 1000);
  CHECK(same(all_particles(kernel<still_gas>(), still_gas::particle_count), spheres));
}

struct row_on_the_bottom : small_periodic {
  static constexpr int particle_count = 5;
};

TEST_CASE("rest: spheres on the bottom of the pipe, in equilibrium with their weight") {
  enter({row_on_the_bottom::name, 0});
  using D = Derived<row_on_the_bottom>;
  const double overlap = std::pow(D::mass * 9.81 / D::stiffness_wall, 2.0 / 3);  // K overlap^1.5 = m g: 10 nm
  Spheres spheres(5);
  for (int k = 0; k < 5; ++k) {
    spheres[k] = {};
    spheres[k].position[1] = -(D::pipe_radius - D::radius) - overlap;
    spheres[k].position[2] = 0.008 + 0.016 * k;
  }
  place_all(kernel<row_on_the_bottom>(), spheres);
  start(kernel<row_on_the_bottom>());
  run(kernel<row_on_the_bottom>(), 20000);
  const Spheres found = all_particles(kernel<row_on_the_bottom>(), 5);
  for (int k = 0; k < 5; ++k) {
    // The place is a multiple of 3.5e-18 m, so the balance is off by 1e-9 g at most; the damped spring takes it up.
    CHECK(std::abs(found[k].position[1] - spheres[k].position[1]) < 1e-6 * overlap);
    CHECK(found[k].position[0] == 0);
    CHECK(found[k].position[2] == spheres[k].position[2]);
    CHECK(length(found[k].velocity) < 1e-9);
  }
}

}  // namespace
}  // namespace fixdem::tests
