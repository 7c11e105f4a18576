// Which way is up in the pipe: beds and floaters under gravity that points elsewhere than along -y, and gas whose
// velocity follows a table.
#include <cmath>

#include "gas_pipes.hpp"
#include "kernel/fixdem.hpp"
#include "scenes.hpp"

namespace fixdem::tests {
namespace {

constexpr double g = 9.81;

/// A short pipe in which some lie, some float and some are close to others.
struct level : cases::plug_u24 {
  static constexpr const char* name = "a bed and floaters";
  static constexpr int particle_count = 60;
  static constexpr double pipe_length = 0.2;
  static constexpr int slice_count = 20, gas_update_interval = 1, gas_floater_interval = 1;
};
/// The same with the pipe turned about its axis, so that gravity comes from the side (sine and cosine 0.6, 0.8).
struct turned : level {
  static constexpr double gravity[3] = {-0.6 * g, -0.8 * g, 0};
};
struct upside_down : level {
  static constexpr double gravity[3] = {0, g, 0};
};
struct from_the_left : level {
  static constexpr double gravity[3] = {-g, 0, 0};
};
/// 30 degrees upwards; and the same turned.
struct inclined : level {
  static constexpr double gravity[3] = {0, -0.86602540378443865 * g, -0.5 * g};
};
struct inclined_turned : level {
  static constexpr double gravity[3] = {-0.6 * 0.86602540378443865 * g, -0.8 * 0.86602540378443865 * g, -0.5 * g};
};
/// Against gravity through an upright pipe: whatever is across is rounding.
struct upright : level {
  static constexpr double gravity[3] = {0, 0, -g};
};
struct upright_turned : level {
  static constexpr double gravity[3] = {1e-9, -2e-9, -g};
};

static_assert(Derived<level>::up[0] == 0 && Derived<level>::up[1] == 1);
static_assert(Derived<inclined>::up[0] == 0 && Derived<inclined>::up[1] == 1 && !Derived<inclined>::is_steep);
static_assert(Derived<upright>::is_steep && Derived<upright_turned>::is_steep && !Derived<turned>::is_steep);

/// What level gravity does to a sphere, gravity from another side does to it turned.
template <class Case>
Spheres turned_spheres(Spheres spheres) {
  const double x = Derived<Case>::up[0], y = Derived<Case>::up[1];  // where +y goes
  for (Sphere& s : spheres)
    for (double* v : {s.position, s.velocity, s.angular_velocity}) {
      const double a = v[0], b = v[1];
      v[0] = y * a + x * b, v[1] = -x * a + y * b;
    }
  return spheres;
}

template <class Case>
Simulation<Case>& after_a_step(const Spheres& spheres) {
  static Simulation<Case> simulation;
  place_all(simulation, spheres);
  start(simulation);
  run(simulation, 1);
  return simulation;
}

/// Slices, floaters and forces (by the change of axial velocity in a step) are those of the unturned pipe.
template <class Case, class Unturned>
void check_turned(const char* what) {
  CAPTURE(what);
  enter({level::name, seed()});
  const Spheres spheres = random_spheres<level>(0.5, Random(seed()));
  auto& expected = after_a_step<Unturned>(spheres);
  auto& found = after_a_step<Case>(turned_spheres<Case>(spheres));
  int floating = 0;
  for (int id = 0; id < Case::particle_count; ++id) {
    CHECK(found.state().gas.floats[id] == expected.state().gas.floats[id]);
    CHECK(found.particle(id).velocity[2] == doctest::Approx(expected.particle(id).velocity[2]).epsilon(1e-12));
    floating += expected.state().gas.floats[id];
  }
  CHECK((Derived<Case>::is_steep ? floating == 0 : floating > 0 && floating < Case::particle_count));
  for (int s = 0; s < Case::slice_count; ++s) {
    CHECK(found.bed_area(s) == doctest::Approx(expected.bed_area(s)).epsilon(1e-12));
    CHECK(found.pressure_gradient(s) == doctest::Approx(expected.pressure_gradient(s)).epsilon(1e-10));
    CHECK(found.gas_velocity_above(s) == doctest::Approx(expected.gas_velocity_above(s)).epsilon(1e-10));
  }
}

TEST_CASE("gas: a pipe turned about its axis has the same beds, floaters and forces") {
  check_turned<turned, level>("turned");
  check_turned<upside_down, level>("upside down");
  check_turned<from_the_left, level>("from the left");
  check_turned<inclined_turned, inclined>("inclined");
  check_turned<upright_turned, upright>("upright");
}

/// Along the wall, from the lowest place on.
template <class Case>
void check_bottom() {
  const double reach = Case::pipe_diameter / 2 - Case::diameter / 2 + 1e-6;
  for (int degrees = 0; degrees < 360; degrees += 10) {
    const double angle = degrees * 3.14159265358979323846 / 180, c = std::cos(angle), s = std::sin(angle);
    const double down[2] = {-Derived<Case>::up[0], -Derived<Case>::up[1]};
    const double x = reach * (c * down[0] - s * down[1]), y = reach * (s * down[0] + c * down[1]);
    CAPTURE(degrees);
    if (degrees != 90 && degrees != 270) CHECK(is_on_bottom<Case>(x, y) == (degrees < 90 || degrees > 270));
    CHECK(!is_on_bottom<Case>(0.99 * x, 0.99 * y));
  }
}

TEST_CASE("gas: the lower half of the wall is where gravity points") {
  check_bottom<level>();
  check_bottom<turned>();
  check_bottom<upside_down>();
  check_bottom<from_the_left>();
}

TEST_CASE("gas: without turning them the beds would be others") {
  enter({level::name, seed()});
  const Spheres spheres = random_spheres<level>(0.5, Random(seed()));
  const auto& below = after_a_step<level>(spheres);
  const auto& beside = after_a_step<from_the_left>(spheres);
  int other = 0;
  for (int s = 0; s < level::slice_count; ++s) other += std::abs(below.bed_area(s) - beside.bed_area(s)) > 1e-6;
  CHECK(other > 5);
}

TEST_CASE("gas: inclined, the bed is measured as in a level pipe, bit for bit") {
  enter({level::name, seed()});
  const Spheres spheres = random_spheres<level>(0.5, Random(seed()));
  const auto& flat = after_a_step<level>(spheres);
  const auto& steeper = after_a_step<inclined>(spheres);
  for (int s = 0; s < level::slice_count; ++s) CHECK(flat.pressure_gradient(s) == steeper.pressure_gradient(s));
}

/// The velocity rises from the fourth step on, over ten steps, and then stays.
template <int interval>
struct ramp : level {
  static constexpr const char* name = "a velocity that rises";
  static constexpr int particle_count = 2, gas_update_interval = interval;
  static constexpr TimeValue gas_velocity_in_time[] = {{4 * time_step, 2}, {14 * time_step, 3}};
  static constexpr double gas_velocity = 2;
};

template <int interval>
void check_ramp() {
  using Case = ramp<interval>;
  CAPTURE(interval);
  static Simulation<Case> simulation;
  simulation.place(0, {{0, 0, 0.05}, {}, {}});
  simulation.place(1, {{0, 0, 0.10}, {}, {}});
  start(simulation);
  for (int step = 0; step < 24; ++step) {
    run(simulation, 1);
    const int updated = step / interval * interval;
    const double U = updated <= 4 ? 2 : updated >= 14 ? 3 : 2 + 0.1 * (updated - 4);
    CAPTURE(step);
    CHECK(simulation.gas_velocity_above(15) == doctest::Approx(U).epsilon(1e-12));
    CHECK(simulation.bulk_velocity(15) == doctest::Approx(U).epsilon(1e-12));
    CHECK(simulation.pressure_gradient(15) ==
          doctest::Approx(reference::free_gradient(U, 0.05, {U, 1.2, 1.5e-5})).epsilon(1e-11));
  }
}

TEST_CASE("gas: a velocity in time is that of each update") {
  check_ramp<1>();
  check_ramp<5>();
}

TEST_CASE("gas: pressures at nodes add up, and the flow is the velocity times the section") {
  enter({level::name, seed()});
  auto& simulation = after_a_step<level>(random_spheres<level>(0.5, Random(seed())));
  CHECK(simulation.pressure(0) == simulation.pressure_drop());
  CHECK(simulation.pressure(level::slice_count) == 0);
  for (int s = 0; s < level::slice_count; ++s) {
    CHECK(simulation.pressure(s) - simulation.pressure(s + 1) ==
          doctest::Approx(simulation.pressure_gradient(s) * 0.01).epsilon(1e-9));
    CHECK(simulation.gas_density(s) == 1.2);
    CHECK(simulation.bulk_velocity(s) == doctest::Approx(2.4).epsilon(1e-12));
  }
  CHECK(simulation.gas_supply() == doctest::Approx(1.2 * 2.4 * section_of<level>).epsilon(1e-12));
}

}  // namespace
}  // namespace fixdem::tests
