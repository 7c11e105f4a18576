// The open line: where particles are fed, that none is lost or counted twice, what happens when it is full, empty or
// blocked, and that its energy adds up.
#include <limits>
#include <memory>

#include "line_checks.hpp"
#include "reference/reference.hpp"

namespace fixdem::tests {
namespace {

struct without_gas : short_line {
  static constexpr bool has_gas = false;
};

template <class Case>
Simulation<Case>& simulation() {
  static Simulation<Case> line;
  return line;
}

struct first_fed : empty_at_start<without_gas> {
  static constexpr int feed_interval = 200;  // 1 ms
};
struct lying : first_fed {
  static constexpr double gravity[3] = {9.81 * 0.6, -9.81 * 0.8, 0};  // up is (-0.6, 0.8)
};

/// After the first feeding event at which anything is due, and one step: after 1 ms, when 2 kg/s are 3.8 particles.
template <class Case, class Solver>
void check_first_fed(Solver& solver, double up_x, double up_y) {
  // Drawn by another program (in Python) with seed 1: across, upwards, along the pipe.
  constexpr double drawn[3][3] = {{0.00774048556040917, 0.008464228963916545, 0.012479806265495455},
                                  {0.0132944380050745, 0.009487573135716576, 0.05744817266280951},
                                  {0.010480693146010496, 0.016416537461166152, 0.0696929437402712}};
  enter({Case::name, 0});
  start(solver);
  run(solver, Case::feed_interval);
  CHECK(solver.line().fed == 0);
  run(solver, 1);
  REQUIRE(solver.line().fed == 3);
  CHECK(solver.line().asked == doctest::Approx(2e-3).epsilon(1e-12));
  CHECK(solver.line().backlog == doctest::Approx(2e-3 - 3 * mass_of<Case>(0)).epsilon(1e-12));
  const double v = Case::feed_velocity + 9.81 * Case::time_step, way = v * Case::time_step;
  for (int id = 0; id < 3; ++id) {
    const auto p = solver.particle(id);
    const double *x = drawn[id], height = x[1] - way;
    CHECK(p.position[0] == doctest::Approx(x[0] * up_y + height * up_x).epsilon(1e-14));
    CHECK(p.position[1] == doctest::Approx(height * up_y - x[0] * up_x).epsilon(1e-14));
    CHECK(p.position[2] == doctest::Approx(x[2]).epsilon(1e-14));
    CHECK(p.velocity[0] == doctest::Approx(-v * up_x).epsilon(1e-14));
    CHECK(p.velocity[1] == doctest::Approx(-v * up_y).epsilon(1e-14));
    CHECK(p.velocity[2] == 0);
    for (const double spin : p.angular_velocity) CHECK(spin == 0);
  }
}

TEST_CASE("line: the first particles fed are where another program computes them") {
  check_first_fed<first_fed>(simulation<first_fed>(), 0, 1);
  check_first_fed<lying>(simulation<lying>(), -0.6, 0.8);
  reference::Reference<first_fed> program;
  check_first_fed<first_fed>(program, 0, 1);
  reference::Reference<lying> lying_program;
  check_first_fed<lying>(lying_program, -0.6, 0.8);
}

struct impulse_of_kinds : in_two_species<short_line> {
  static constexpr Integrator integrator = Integrator::impulse;
};

TEST_CASE_TEMPLATE("line: nobody is lost, and serial numbers are never used again", Case, short_line,
                   impulse_of_kinds) {
  Simulation<Case>& line = simulation<Case>();
  start_line(line);
  Attendance<Case> attendance(line);
  int wrong = !attendance.is_right(), used_again = 0;
  for (int step = 0; step < 40000; ++step) {
    run(line, 1);
    wrong += !attendance.is_right();
  }
  CHECK(wrong == 0);
  for (int id = 0; id < Case::particle_count; ++id)
    used_again += line.is_present(id) && line.serial(id) >= Case::particle_count;
  const LineTotals totals = line.line();
  CHECK(used_again > 0);
  CHECK(totals.fed > 100);
  CHECK(totals.left > 50);
  double mass = 0;
  for (int id = 0; id < Case::particle_count; ++id)
    if (line.is_present(id)) mass += mass_of<Case>(line.kind(id));
  double at_start = 0;
  for (int kind = 0; kind < Case::start_count; ++kind) at_start += mass_of<Case>(kind);
  CHECK(at_start + totals.accepted == doctest::Approx(mass + totals.left_mass).epsilon(1e-12));
  CHECK(totals.asked == doctest::Approx(2 * line.time()).epsilon(1e-3));
  CHECK(totals.backlog == doctest::Approx(totals.asked - totals.accepted).epsilon(1e-12));
}

TEST_CASE_TEMPLATE("line: a run that is cut at odd steps comes to the same bytes", Case, short_line, impulse_of_kinds) {
  auto whole = std::make_unique<Simulation<Case>>(), cut = std::make_unique<Simulation<Case>>();
  start_line(*whole);
  start_line(*cut);
  constexpr int steps = 6000;
  run(*whole, steps);
  int piece = 1;
  for (int done = 0; done < steps; done += piece) {
    piece = std::min((piece * 7 + 3) % 53, steps - done);
    run(*cut, piece);
  }
  CHECK(cut->step() == steps);
  CHECK(same_line(*whole, *cut));
  CHECK(whole->line().left > 5);
}

struct small_capacity : without_gas {
  static constexpr int particle_count = 127, feed_interval = 200;  // several are due at once
};

/// Pairs that overlap, counted without the lists of the kernel.
template <class Case>
int overlapping_pairs(const Simulation<Case>& line) {
  Spheres present;
  for (int id = 0; id < Case::particle_count; ++id) {
    if (!line.is_present(id)) continue;
    const Particle p = line.particle(id);
    present.push_back({{p.position[0], p.position[1], p.position[2]}, {}, {}});
  }
  int pairs = 0;
  for (std::size_t i = 0; i < present.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      double between[3];
      for (int c = 0; c < 3; ++c) between[c] = present[i].position[c] - present[j].position[c];
      pairs += length(between) < Case::diameter;
    }
  return pairs;
}

TEST_CASE("line: a full one stops, and nothing is lost") {
  Simulation<small_capacity>& line = simulation<small_capacity>();
  enter({small_capacity::name, seed()});
  place_all(line, plug_at_outlet<small_capacity>(Random(seed())));
  start(line);
  Attendance<small_capacity> attendance(line);
  Status status;
  int wrong = 0;
  for (int step = 0; step < 10000 && status.ok(); ++step) {
    status = line.run(1);
    wrong += !attendance.is_right();
  }
  CHECK(wrong == 0);
  CHECK(status.fault == Fault::line_full);
  CHECK(status.value == 128);
  CHECK(status.limit == 127);
  CHECK(status.particle == -1);
  CHECK(status.step == line.step());
  CHECK(line.present() == 127);
  const LineTotals before = line.line();
  CHECK(!line.run(100).ok());
  const LineTotals after = line.line();
  CHECK(std::memcmp(&before, &after, sizeof before) == 0);
  // What is looked at for the report is what is there.
  line.for_each_contact([&](const Contact& c) {
    CHECK(line.is_present(c.owner));
    if (c.partner >= 0) CHECK(line.is_present(c.partner));
  });
  CHECK(line.observe().contacts == overlapping_pairs(line));
  CHECK(line.observe().contacts > 0);
}

TEST_CASE("line: whoever is placed beyond an end is refused") {
  Simulation<small_capacity>& line = simulation<small_capacity>();
  enter({small_capacity::name, seed()});
  constexpr double L = small_capacity::pipe_length;
  for (const double z : {L, L + 1e-9, L + 0.02, 100 * L, -1e-9, -1.0}) {
    CAPTURE(z);
    Spheres spheres = spheres_of_line<small_capacity>(0.5, 1, Random(seed()));
    spheres[7].position[2] = z;
    place_all(line, spheres);
    const Status status = line.start();
    CHECK(status.fault == Fault::outside_pipe);
    CHECK(status.particle == 7);
    CHECK(status.value == z);
  }
}

/// A velocity that no particle can have is a fault, and no way out.
template <class Case>
Status status_after_blow(double axial_velocity) {
  Simulation<Case>& line = simulation<Case>();
  start_line(line);
  run(line, 10);
  auto& particles = line.state().particles;
  int row = 0;
  while (particles.id[row] != 7) ++row;
  particles.motion[row][2] = axial_velocity;
  return line.run(1);
}

TEST_CASE("line: nobody leaves by a fault") {
  const Status fast = status_after_blow<without_gas>(1e5);  // half a metre in a step
  CHECK(fast.fault == Fault::too_fast);
  CHECK(fast.particle == 7);
  for (const double bad : {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    const Status status = status_after_blow<without_gas>(bad);
    CHECK(status.fault == Fault::non_finite);
    CHECK(status.particle == 7);
  }
}

struct large_and_empty : empty_at_start<short_line> {
  static constexpr int particle_count = 20000;
  static constexpr double pipe_length = 10;
  static constexpr int slice_count = 1000;
  static constexpr TimeValue feed_rate[] = {{0, 0.5}};
};

TEST_CASE("line: an empty one runs, and one of large capacity works on those present alone") {
  auto line = std::make_unique<Simulation<large_and_empty>>();
  start(*line);
  CHECK(line->present() == 0);
  CHECK(line->state().particles.rows() == 0);
  CHECK(line->observe().contacts == 0);
  CHECK(line->energy().kinetic == 0);
  CHECK(std::isfinite(line->observe().coordination_number));
  run(*line, 100);
  CHECK(line->present() == 0);
  CHECK(line->pressure_drop() > 0);
  run(*line, 20000);
  CHECK(line->present() > 50);
  CHECK(line->state().particles.rows() == line->present());
  CHECK(Attendance<large_and_empty>(*line).is_right());
  start(*line);
  CHECK(line->present() == 0);
  CHECK(line->line().fed == 0);
}

}  // namespace
}  // namespace fixdem::tests
