// How long contacts last, by one formula for casegen and the programs; and what is said of a time step that gives them
// too few steps: a warning in every run, figures in summary.json, a line at the end.
#include "tools/run/contact_time.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "program_run.hpp"
#include "tools/run/fault_report.hpp"
#include "tools/run/summary.hpp"

using namespace fixdem;
using namespace fixdem::program;
using fixdem::tests::contains;

TEST_CASE("steps per contact: counted at the deepest overlap, warned of below twenty, never called stable") {
  CaseFacts facts{};
  facts.mass = 3.14159265358979 / 6 * 1e-3, facts.density = 1000, facts.diameter = 0.01;
  facts.stiffness_pair = 1.122e8, facts.stiffness_wall = 1.587e8;
  facts.particle_count = 1, facts.has_wall = true, facts.is_periodic = true;
  // The overlap of a wall impact at 1 m/s gives its duration back; there are no pairs.
  const double overlap = std::pow(1.25 * facts.mass / facts.stiffness_wall, 0.4);
  CHECK(contact_time_of(facts, overlap) == doctest::Approx(8.22e-5).epsilon(0.002));
  CHECK(contact_time_of(facts, overlap) == doctest::Approx(contact_time(facts, 1.0)).epsilon(1e-12));
  CHECK(std::isinf(contact_time_of(facts, 0)));
  facts.time_step = 8.22e-5 / 3.5, facts.reference_speed = 1;
  for (const double deepest : {0.0, overlap}) {
    const std::string warning = contact_warning(facts, deepest);
    CHECK_MESSAGE(contains(warning, "gives only 3.5 steps per contact at "), warning);
    CHECK(contains(warning, deepest > 0 ? "the deepest overlap so far" : "1 m/s"));
    CHECK(contains(warning, "try time_step = 4.1e-06"));
  }
  facts.time_step = 8.22e-5 / 21;
  CHECK(contact_warning(facts, overlap).empty());
  facts.reference_speed = 0;
  facts.time_step = 1;
  CHECK(contact_warning(facts, 0).empty());
  CHECK_FALSE(contact_warning(facts, overlap).empty());

  Outcome outcome;
  Options options;
  facts.name = "x", facts.kernel = "k";
  outcome.status = "done", outcome.steps_per_contact = 3.5;
  const auto summary = nlohmann::json::parse(encode_summary(facts, options, outcome));
  CHECK(summary["stability"]["steps_per_contact"] == 3.5);
  CHECK(summary["stability"]["steps_per_contact_needed"] == 20);
  CHECK(contains(describe_outcome(facts, outcome), "only 3.5 steps per contact"));
  outcome.steps_per_contact = INFINITY;
  CHECK(nlohmann::json::parse(encode_summary(facts, options, outcome))["stability"]["steps_per_contact"].is_null());
}

TEST_CASE("contact time: at compile time and in running, at rest and beyond all bounds") {
  constexpr double at_compile_time = hertz_contact_time(5e-4, 1e8, 1);
  CHECK(hertz_contact_time(5e-4, 1e8, 1) == at_compile_time);
  CHECK(at_compile_time == doctest::Approx(2.9433 * std::pow(1.25 * 5e-4 / 1e8, 0.4)).epsilon(1e-12));
  CHECK(hertz_impact_speed(5e-4, 1e8, std::pow(1.25 * 5e-4 * 9 / 1e8, 0.4)) == doctest::Approx(3).epsilon(1e-12));
  CHECK(linear_contact_time(2, 8) == doctest::Approx(3.14159265358979 / 2));
  CHECK(std::isinf(hertz_contact_time(5e-4, 1e8, 0)));
  CHECK(hertz_contact_time(5e-4, 1e8, INFINITY) == 0);
  CHECK(hertz_impact_speed(5e-4, 1e8, NAN) == 0);
}
