// The parts of the program that can be tested without a simulation: random numbers, arrangement, schedule, fault
// report.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "tools/run/arrangement.hpp"
#include "tools/run/capacity_advice.hpp"
#include "tools/run/collision_tracker.hpp"
#include "tools/run/energy_balance.hpp"
#include "tools/run/failure.hpp"
#include "tools/run/fault_report.hpp"
#include "tools/run/neighbourhood.hpp"
#include "tools/run/random_numbers.hpp"
#include "tools/run/schedule.hpp"

using namespace fixdem;
using namespace fixdem::program;

namespace {

/// Smallest distance of two centres, by looking at all pairs.
double min_distance(const std::vector<Position>& x, double period) {
  double least = INFINITY;
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      double z = x[i][2] - x[j][2];
      if (period > 0) z -= period * std::round(z / period);
      least = std::min(least, std::hypot(x[i][0] - x[j][0], x[i][1] - x[j][1], z));
    }
  return least;
}

double maximum_reach(const std::vector<Position>& x) {
  double reach = 0;
  for (const Position& p : x) reach = std::max(reach, std::hypot(p[0], p[1]));
  return reach;
}

}  // namespace

TEST_CASE("random numbers are those of the standard, and uniform in [0, 1)") {
  // The standard gives the 10000th value of a default-seeded mt19937_64 (seed 5489).
  RandomNumbers numbers(5489);
  double value = 0;
  for (int k = 0; k < 10000; ++k) value = numbers.unit();
  CHECK(value == static_cast<double>(9981545732273789042ULL >> 11) * 0x1p-53);
  double sum = 0;
  for (int k = 0; k < 100000; ++k) {
    value = numbers.unit();
    if (value < 0 || value >= 1) FAIL("outside [0, 1)");
    sum += value;
  }
  CHECK(sum / 100000 == doctest::Approx(0.5).epsilon(0.01));
}

TEST_CASE("arrangement: no overlap, inside the pipe, reproducible; dense ones are relaxed") {
  const double d = 0.01;
  SUBCASE("dilute, closed") {
    ArrangementReport report;
    const auto x = arrange({0.05, 2.0, false}, 1000, d, 1, &report);
    CHECK(report.inserted_overlapping == 0);
    CHECK(min_distance(x, 0) >= d);
    CHECK(maximum_reach(x) <= 0.02);
    for (const Position& p : x) CHECK((p[2] >= d / 2 && p[2] <= 2 - d / 2));
    CHECK(arrange({0.05, 2.0, false}, 1000, d, 1) == x);
    CHECK(arrange({0.05, 2.0, false}, 1000, d, 2) != x);
  }
  SUBCASE("denser than insertion reaches, periodic") {
    ArrangementReport report;
    const auto x = arrange({0.05, 0.8, true}, 1000, d, 1, &report);
    CHECK(report.inserted_overlapping > 0);
    CHECK(min_distance(x, 0.8) >= d);
    CHECK(maximum_reach(x) <= 0.02);
    for (const Position& p : x) CHECK((p[2] >= 0 && p[2] < 0.8));
  }
  SUBCASE("a wide pipe") { CHECK(min_distance(arrange({0.2, 0.2, true}, 2000, d, 7), 0.2) >= d); }
}

TEST_CASE("arrangement: what cannot be placed is refused with numbers and advice") {
  try {
    arrange({0.05, 0.4, false}, 1000, 0.01, 1);
    FAIL("1000 particles do not fit into 0.4 m");
  } catch (const Failure& failure) {
    CHECK(failure.code() == exit_bad_input);
    const std::string message = failure.what();
    CHECK(message.find("1000 particles") != std::string::npos);
    CHECK(message.find("solids fraction 0.667") != std::string::npos);
    CHECK(message.find("raise [pipe] length") != std::string::npos);
  }
}

TEST_CASE("arrangement: velocities are uniform in their bounds") {
  const auto particles = arrange_moving({0.05, 2.0, false}, 1000, 0.01, 0.5, 1);
  double sum[3] = {}, maximum = 0;
  for (const Particle& p : particles)
    for (int k = 0; k < 3; ++k) {
      sum[k] += p.velocity[k] * p.velocity[k] / 1000;
      maximum = std::max(maximum, std::fabs(p.velocity[k]));
      CHECK(p.angular_velocity[k] == 0);
    }
  CHECK(maximum <= 0.5);
  for (double mean_square : sum) CHECK(mean_square == doctest::Approx(0.25 / 3).epsilon(0.1));
}

TEST_CASE("schedule: whole steps nearest to the events, never skipped by rounding") {
  Schedule every(3, 2);  // 1.5 steps
  std::vector<long long> steps;
  for (long long step = 0; step <= 9; ++step)
    if (every.is_due(step)) steps.push_back(step), every.advance(step);
  CHECK(steps == std::vector<long long>{0, 2, 3, 5, 6, 8, 9});
  CHECK_FALSE(Schedule(0, 0.2).is_due(1000000));
  for (const double interval : {1e14, 1e20, 1e300}) {  // the first event is at the start, the second is never
    Schedule endless(interval, 2e-6);
    CHECK(endless.is_due(0));
    endless.advance(0);
    CHECK_FALSE(endless.is_due(9000000000000000));
  }
  Schedule decimal(0.01, 2e-6);
  long long last = 0;
  for (int k = 0; k < 120; ++k) decimal.advance(decimal.next()), last = decimal.next();
  CHECK(last == 600000);
}

TEST_CASE("energy balance: relative to the largest term") {
  Energy start{}, now{};
  start.kinetic = 2;
  now.kinetic = 1, now.elastic = 0.5, now.dissipated_damping = 0.5, now.dissipated_sliding = 0.25,
  now.gravity_work = 0.25;
  CHECK(balance_error(start, now) == doctest::Approx(0));
  now.kinetic = 1.1;
  CHECK(balance_error(start, now) == doctest::Approx(0.05));
  now.dissipated_sliding = 0.1, now.dissipated_rolling = 0.05;
  CHECK(balance_error(start, now) == doctest::Approx(0));
  CHECK(balance_error(Energy{}, Energy{}) == 0);
}

TEST_CASE("the maximum value of a sampled curve comes from a parabola") {
  ParabolicMaximum maximum;
  for (int k = 0; k <= 10; ++k) {
    const double t = k - 4.3;
    maximum.add(7 - 0.5 * t * t);
  }
  CHECK(maximum.value() == doctest::Approx(7));
}

TEST_CASE("fault report: contact time, advice and exit codes") {
  CaseFacts facts{};
  facts.mass = 3.14159265358979 / 6 * 1e-3, facts.density = 1000, facts.diameter = 0.01;
  facts.stiffness_pair = 1.122e8, facts.stiffness_wall = 1.587e8;
  facts.particle_count = 150, facts.has_wall = true;
  CHECK(contact_time(facts, 1.0) == doctest::Approx(7.16e-5).epsilon(0.002));  // pair; a wall: 8.22e-5 s
  facts.time_step = 1e-5;
  const Status status{Fault::overlap, 318, 41213, 0.61, 0.5};
  CHECK(fault_sentence(facts, status) == "particle 318 has an overlap of 0.61 radii (limit 0.5)");
  CHECK(fault_advice(facts, status, 1.0).find("try [run] time_step = 3.5e-06") != std::string::npos);
  CHECK(fault_exit_code(Fault::overlap) == exit_unstable);
  CHECK(fault_exit_code(Fault::neighbour_capacity) == exit_capacity);
}

TEST_CASE("capacities: how full they were, and what to set") {
  const auto described = [](long long neighbours, long long pairs) {
    return describe_capacities({{"neighbours", 14, neighbours},
                                {"chunk_pairs", 1008, pairs},
                                {"wrap_pairs", 0, 0},
                                {"in_reach", 144, 90},
                                {"memory", 524288, 262144}});
  };
  CHECK(
      described(9, 300) ==
      "capacity: 9 of 14 neighbours, 300 of 1008 pairs in a chunk, 90 of 144 particles within reach; 256.0 KiB in all\n"
      "  [capacity] neighbours = 10 would be enough for this run and save memory\n");
  CHECK(described(9, 900).find("neighbours = ") == std::string::npos);  // 1.1 * 900 pairs need 14
  CHECK(described(14, 300).find("nearly full: [capacity] neighbours = 15") != std::string::npos);
  CHECK(described(12, 1000).find("nearly full: [capacity] neighbours = 16") != std::string::npos);
  CHECK(described(13, 300).find("neighbours = ") == std::string::npos);
  CHECK(describe_capacities({}).empty());
}

TEST_CASE("neighbourhood: the particles within three diameters, across the ends of a periodic pipe too") {
  CaseFacts facts{};
  facts.diameter = 0.01, facts.pipe_length = 0.8, facts.particle_count = 4;
  Snapshot snapshot;
  for (const double z : {0.005, 0.034, 0.036, 0.79}) snapshot.particles.push_back({{0, 0, z}, {}, {}});
  CHECK(neighbourhood(facts, snapshot, 0) == std::vector<int>{0, 1});
  CHECK(neighbourhood(facts, snapshot, 2) == std::vector<int>{1, 2});
  CHECK(neighbourhood(facts, snapshot, -1) == std::vector<int>{0, 1, 2, 3});
  facts.is_periodic = true;
  CHECK(neighbourhood(facts, snapshot, 0) == std::vector<int>{0, 1, 3});
}
