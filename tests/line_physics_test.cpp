// The physics of an open line: its energy adds up, what leaves and enters included; it does not matter how it lies; and
// the feed section takes what was measured with another program.
#include <numbers>

#include "agreement.hpp"
#include "line_checks.hpp"

namespace fixdem::tests {
namespace {

/// Ledger of a line, to a share of the energy that has been turned over.
template <class Case>
void check_energy(const Spheres& spheres, double time, double share) {
  static Simulation<Case> line;
  enter({Case::name, seed()});
  place_all(line, spheres);
  fixdem::tests::start(line);
  const Energy start = line.energy();
  run_until(line, time);
  const Energy now = line.energy();
  const LineTotals totals = line.line();
  CHECK(totals.fed > 20);
  CHECK(totals.left > 20);
  CHECK(now.entered == doctest::Approx(totals.accepted * Case::feed_velocity * Case::feed_velocity / 2).epsilon(1e-12));
  CHECK(now.left_with > 0);
  const double turned_over = start.kinetic + now.entered + now.left_with + std::abs(now.gravity_work) +
                             std::abs(now.gas_work) + now.dissipated_damping + now.dissipated_sliding +
                             now.dissipated_rolling;
  INFO(now.kinetic, " J, turned over ", turned_over, " J");
  CHECK(std::abs(imbalance(start, now)) < share * turned_over);
  if (std::getenv("FIXDEM_FIGURES") != nullptr)
    std::cerr << std::scientific << "  imbalance " << imbalance(start, now) / turned_over << " of " << turned_over
              << " J, left with " << now.left_with << ", made by law " << now.made_by_law << "\n";
}

template <class Base>
struct in_small_steps : Base {
  static constexpr double time_step = 2e-6;
  static constexpr int feed_interval = 500, gas_update_interval = 5, gas_floater_interval = 25;
};
template <class Base>
struct leapfrog : Base {
  static constexpr Integrator integrator = Integrator::leapfrog;
};
template <class Base>
struct impulse : Base {
  static constexpr Integrator integrator = Integrator::impulse;
  static constexpr Slider slider = Slider::exact;
};
template <class Base>
struct rolling : Base {
  static constexpr double rolling_friction = 0.1, wall_rolling_friction = 0.2;
};
struct on_a_slope : short_line {
  static constexpr double gravity[3] = {0, -9.81 * 0.86602540378443865, -9.81 * 0.5};
};

template <class Case>
void check_energy() {
  check_energy<Case>(spheres_of_line<Case>(0.5, 1, Random(seed())), 0.1, 5e-4);
}

TEST_CASE("line: energy is kept, with what is fed and what leaves") {
  check_energy<in_small_steps<short_line>>();
  check_energy<in_small_steps<leapfrog<short_line>>>();
  check_energy<in_small_steps<impulse<on_a_slope>>>();
  check_energy<in_small_steps<rolling<in_two_species<on_a_slope>>>>();
}

TEST_CASE("line: a plug takes the energy of its contacts along") {
  check_energy<in_small_steps<short_line>>(plug_at_outlet<short_line>(Random(seed())), 0.04, 5e-4);
}

constexpr double cosine = 0.76484218728448843, sine = 0.64421768723769105;  // of 0.7

template <class Base>
struct turned : Base {
  static constexpr double gravity[3] = {cosine * Base::gravity[0] - sine * Base::gravity[1],
                                        sine* Base::gravity[0] + cosine* Base::gravity[1], Base::gravity[2]};
};

void turn(double (&v)[3]) {
  const double x = v[0];
  v[0] = cosine * x - sine * v[1];
  v[1] = sine * x + cosine * v[1];
}

template <class Case>
void check_turned() {
  static Simulation<Case> line;
  static Simulation<turned<Case>> turned_line;
  start_line(line, 0.5, 2);
  Spheres spheres = spheres_of_line<Case>(0.5, 2, Random(seed()));
  for (Sphere& s : spheres) turn(s.position), turn(s.velocity), turn(s.angular_velocity);
  place_all(turned_line, spheres);
  start(turned_line);
  constexpr int steps = 3000;  // 15 ms
  run(line, steps);
  run(turned_line, steps);
  CHECK(line.line().fed == turned_line.line().fed);
  CHECK(line.line().left == turned_line.line().left);
  CHECK(line.line().left > 3);
  double maximum = 0;
  const BySerial<Case> expected(line);
  const BySerial<turned<Case>> found(turned_line);
  REQUIRE(expected.present() == found.present());
  for (int serial = 0; serial < Case::start_count + line.line().fed; ++serial) {
    REQUIRE(expected.is_present(serial) == found.is_present(serial));
    if (!expected.is_present(serial)) continue;
    Particle p = expected.particle(serial);
    const Particle q = found.particle(serial);
    turn(p.position);
    for (int c = 0; c < 3; ++c) maximum = std::max(maximum, std::abs(p.position[c] - q.position[c]) / Case::diameter);
  }
  CHECK(maximum < 1e-10);
  for (int s = 0; s < Case::slice_count; ++s)
    CHECK(line.pressure_gradient(s) == doctest::Approx(turned_line.pressure_gradient(s)).epsilon(1e-9));
}

TEST_CASE("line: turned about the axis of the pipe it is the same") {
  check_turned<short_line>();
  check_turned<on_a_slope>();
}

/// A feed slower than a particle in a second is not blocked between two of them, nor is one that has paused.
struct slow_feed : empty_at_start<short_line> {
  static constexpr bool has_gas = false;
  static constexpr TimeValue feed_rate[] = {{0, 2e-3}, {0.3, 2e-3}, {0.30001, 0}};
};
/// Without gas the section fills, and what does not find room is owed.
struct blocked_feed : empty_at_start<short_line> {
  static constexpr bool has_gas = false;
  static constexpr TimeValue feed_rate[] = {{0, 5}, {0.05, 5}, {0.06, 0.01}};
};

TEST_CASE("line: blocked is a feed whose particles find no room, for a second of the feed or more") {
  static Simulation<slow_feed> slow;
  enter({slow_feed::name, 0});
  start(slow);
  run_until(slow, 0.35);
  CHECK(slow.line().fed == 1);
  CHECK(slow.line().blocked_time == 0);

  static Simulation<blocked_feed> blocked;
  start(blocked);
  run_until(blocked, 0.05);
  CHECK(blocked.line().backlog > 0.1);
  CHECK(blocked.line().blocked_time == 0);
  run_until(blocked, 0.16);
  const LineTotals totals = blocked.line();
  CHECK(totals.asked == doctest::Approx(5 * 0.05 + 0.01 * (5 + 0.01) / 2 + 0.1 * 0.01).epsilon(1e-3));
  CHECK(totals.backlog == doctest::Approx(totals.asked - totals.accepted).epsilon(1e-12));
  CHECK(totals.blocked_time > 0.099);
  CHECK(totals.blocked_time < 0.105);
}

/// Of particles that come near the bottom, the first in the order is taken away every four steps, as if through the
/// outlet: a section that is always empty, as far as it can be.
template <class Case>
void take_away_at_bottom(Simulation<Case>& line) {
  auto& particles = line.state().particles;
  for (int row = 0; row < particles.rows(); ++row) {
    double* x = particles.position[row];
    if (!particles.is_present(row) || x[1] > -0.6 * Case::pipe_diameter / 2) continue;
    x[2] = Case::pipe_length * 1.001;
    line.state().line.front[row / Capacity<Case>::chunk_size] = x[2];
    return;
  }
}

template <int millimetres>
struct emptied : empty_at_start<short_line> {
  static constexpr bool has_gas = false;
  static constexpr double time_step = 2e-5, feed_length = 1e-3 * millimetres;
  static constexpr int feed_interval = 50;
  static constexpr TimeValue feed_rate[] = {{0, 5}};
};

/// Per length, feed velocity, diameter of the pipe and density of the particles.
template <class Case>
double share_taken() {
  static Simulation<Case> line;
  enter({Case::name, 0});
  start(line);
  while (line.time() < 0.6) {
    run(line, 4);
    take_away_at_bottom(line);
  }
  CHECK(line.line().backlog > 0.5 * line.line().asked);
  const double taken = line.line().accepted / line.time() /
                       (Case::density * Case::feed_velocity * Case::feed_length * Case::pipe_diameter);
  if (std::getenv("FIXDEM_FIGURES") != nullptr) std::cerr << "  section takes " << taken << "\n";
  return taken;
}

TEST_CASE("line: what a feed section takes is limited, as another program found") {
  CHECK(share_taken<emptied<50>>() == doctest::Approx(0.28).epsilon(0.1));
  CHECK(share_taken<emptied<100>>() == doctest::Approx(0.28).epsilon(0.1));
  CHECK(share_taken<emptied<200>>() == doctest::Approx(0.28).epsilon(0.1));
}

}  // namespace
}  // namespace fixdem::tests
