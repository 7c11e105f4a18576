// A line in what the program writes and reads: those present under numbers of their own and by serial number, kinds,
// state files, the log's balance, messages, the live picture.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "line_output_case.hpp"
#include "program_run.hpp"
#include "tools/run/contacts_vtp.hpp"
#include "tools/run/dump.hpp"
#include "tools/run/energy_balance.hpp"
#include "tools/run/failure.hpp"
#include "tools/run/fault_report.hpp"
#include "tools/run/frames_vtp.hpp"
#include "tools/run/line_record.hpp"
#include "tools/run/log.hpp"
#include "tools/run/snapshot.hpp"
#include "tools/run/species_velocity.hpp"
#include "tools/run/stability_watch.hpp"
#include "tools/run/start.hpp"
#include "tools/run/state_file.hpp"
#include "tools/run/summary.hpp"
#include "tools/run/watch.hpp"

using namespace fixdem;
using namespace fixdem::program;
using doctest::Approx;
using fixdem::tests::contains, fixdem::tests::facts_of_line, fixdem::tests::ThreePresent;

namespace {

class ElsewhereInTheArrays final : public ThreePresent {
 public:
  bool is_present(int id) const override { return ThreePresent::is_present(slot(id)); }
  long long serial(int id) const override { return ThreePresent::serial(slot(id)); }
  int kind(int id) const override { return ThreePresent::kind(slot(id)); }
  Particle particle(int id) const override { return ThreePresent::particle(slot(id)); }
  std::vector<Contact> contacts() const override {
    std::vector<Contact> list = ThreePresent::contacts();
    for (Contact& contact : list)
      for (int* id : {&contact.owner, &contact.partner}) *id = *id == 5 ? 4 : *id == 2 ? 3 : *id;
    return list;
  }

 private:
  static int slot(int id) { return id == 3 ? 2 : id == 4 ? 5 : id == 0 ? 0 : 1; }
};

/// What a case of so many at the start says to the state of three.
std::string started(CaseFacts facts, int count, const StoredState& state) {
  const auto file = fixdem::tests::scratch("line.fixdem");
  write_state(file, state);
  facts.start = StartKind::from, facts.start_from = "line", facts.start_keeps_motion = true;
  facts.line.start_count = facts.particle_count = count;
  if (facts.line.is_open) facts.particle_count = 100;
  Options options;
  options.quiet = true, options.start_state = file;
  class Placed final : public NoSimulation {
   public:
    void place(int, const Particle&) override { ++placed; }
    void restore_history(int owner, int partner, const double (&)[3], const double (&)[3]) override {
      histories += " " + std::to_string(owner) + ":" + std::to_string(partner);
    }
    int placed = 0;
    std::string histories;
  } view;
  try {
    start_simulation(view, facts, options);
  } catch (const Failure& failure) {
    CHECK(failure.code() == exit_bad_input);
    return failure.what();
  }
  return std::to_string(view.placed) + " placed," + view.histories;
}

const ParticleKind three_kinds[] = {{0.01, 1000, 0}, {0.01, 1000, 0}, {0.006, 1500, 1}};
const char* const names[] = {"large", "small"};

CaseFacts facts_of_species() {
  CaseFacts facts = facts_of_line();
  facts.kinds = three_kinds, facts.kind_count = 3, facts.smallest_diameter = 0.006;
  facts.species_count = 2, facts.species = names;
  return facts;
}

}  // namespace

TEST_CASE("line: a snapshot has those present, from 0 on, with serial numbers and kinds; contacts follow") {
  const Snapshot snapshot = take_snapshot(ThreePresent(), 6);
  REQUIRE(snapshot.particles.size() == 3);
  CHECK(snapshot.particles[1].position[2] == Approx(0.3));
  CHECK(snapshot.serials == std::vector<long long>{1, 5000000009, 6});
  CHECK(snapshot.kind(2) == 2);
  CHECK(snapshot.find(5000000009) == 1);
  CHECK(snapshot.find(2) == -1);
  CHECK(snapshot.find(-1) == -1);
  REQUIRE(snapshot.contacts.size() == 2);
  CHECK(snapshot.contacts[0].owner == 1);  // the lower number owns
  CHECK(snapshot.contacts[0].partner == 2);
  CHECK(snapshot.contacts[0].normal[2] == 1);
  CHECK(snapshot.contacts[1].owner == 2);
  CHECK(snapshot.contacts[1].partner == -1);
  CHECK(state_hash(snapshot) == state_hash(take_snapshot(ElsewhereInTheArrays(), 6)));
  const Snapshot closed = take_snapshot(NoSimulation(), 2);
  CHECK(closed.find(1) == 1);
  CHECK(closed.serial(1) == 1);
  CHECK(closed.kind(1) == 1);
}

TEST_CASE("line: frames have serial numbers, the dump is numbered by them, and kinds say what each is") {
  const Snapshot snapshot = take_snapshot(ThreePresent(), 6);
  const CaseFacts facts = facts_of_species();
  const std::string vtp = encode_vtp(snapshot, facts, VtpData::text);
  CHECK(contains(vtp, "Name=\"id\" NumberOfComponents=\"1\" format=\"ascii\">0 1 2<"));
  CHECK(contains(vtp, "Name=\"serial\" NumberOfComponents=\"1\" format=\"ascii\">1 5000000009 6<"));
  CHECK(contains(vtp, "Name=\"radius\" NumberOfComponents=\"1\" format=\"ascii\">0.005 0.005 0.003<"));
  CHECK(contains(vtp, "Name=\"density\" NumberOfComponents=\"1\" format=\"ascii\">1000 1000 1500<"));
  CHECK(contains(vtp, "Name=\"species\" NumberOfComponents=\"1\" format=\"ascii\">0 0 1<"));
  CHECK_FALSE(contains(encode_vtp(take_snapshot(NoSimulation(), 2), facts, VtpData::text), "serial"));
  const std::string dump = encode_dump(snapshot, facts);
  CHECK(contains(dump, "NUMBER OF ATOMS\n3\n"));
  CHECK(contains(dump, "\n5000000010 1 0 "));
  CHECK(contains(dump, "\n7 2 0 "));
  CHECK(axial_velocities(facts, snapshot) == std::vector<double>{0.5, 0.5});
}

TEST_CASE("line: its final state has those present, and starts cases of that many") {
  CaseFacts facts = facts_of_line();
  StoredState state = stored_state(facts, take_snapshot(ThreePresent(), 6), true, 1);
  REQUIRE(state.particles.size() == 3);
  CHECK(stored_state(facts_of_species(), take_snapshot(ThreePresent(), 6), true, 1).diameters ==
        std::vector<double>{0.01, 0.01, 0.006});
  state.histories.push_back({0, -3, {1, 0, 0}});
  state.histories.push_back({0, -2, {1, 0, 0}});
  CHECK(started(facts, 3, state) == "3 placed, 1:2 2:-1 0:-2");  // a line has no wall at the outlet
  CHECK(contains(started(facts, 4, state), "it has 3 particles, the case 4\n  set [particles] count = 3"));
  state.particles[1].position[2] = 2;
  CHECK(contains(started(facts, 3, state), "particle 1 lies at z = 2 m, the pipe ends at 2 m"));
  facts.line.is_open = false;
  CHECK(started(facts, 3, state) == "3 placed, 1:2 2:-1 0:-3 0:-2");
  // With several sizes number by number, as everywhere.
  StoredState mixed = stored_state(facts_of_species(), take_snapshot(ThreePresent(), 6), true, 1);
  CHECK(started(facts_of_species(), 3, mixed) == "3 placed, 1:2 2:-1");
  std::swap(mixed.diameters[0], mixed.diameters[2]);
  CHECK(contains(started(facts_of_species(), 3, mixed), "particle 0 has diameter 0.006 there and 0.01 here"));
}

TEST_CASE("line: no particles at the start, nothing placed") {
  CaseFacts facts = facts_of_line();
  for (const StartKind kind : {StartKind::random, StartKind::placed}) {
    facts.start = kind;
    class None final : public NoSimulation {
     public:
      void place(int, const Particle&) override { FAIL("nobody is there"); }
    } view;
    start_simulation(view, facts, Options{});
  }
}

TEST_CASE("line: rows of the log have its numbers and rates, and particles that do not add up stop the run") {
  const CaseFacts facts = facts_of_line();
  ThreePresent view;
  LineRecord record(facts);
  Snapshot snapshot = take_snapshot(view, 6);
  LogRow row;
  row.line = record.row(view, snapshot);
  CHECK_FALSE(std::isfinite(row.line.asked_rate));  // an empty cell
  snapshot.time = 0.5;
  view.totals = {4, 5, 6, 3, 0.005, 0.004, 0.002, 0.001, 0.5};
  row.line = record.row(view, snapshot);
  CHECK(row.line.asked_rate == Approx(0.004));
  CHECK(row.line.accepted_rate == Approx(0.004));
  CHECK(row.line.left_rate == Approx(0.002));
  CHECK(row.line.holdup == Approx(3 * facts.mass));
  CHECK(contains(log_header(facts),
                 ",present,fed,left,holdup [kg],asked rate [kg/s],accepted rate [kg/s],leaving rate"
                 " [kg/s],backlog [kg],blocked time [s]"));
  CHECK(contains(log_line(facts, row), ",3,5,6,0.0015"));
  CHECK_FALSE(contains(log_header(CaseFacts{}), "present"));
  for (const LineTotals& wrong : {LineTotals{4, 5, 7, 3, 0, 0, 0, 0, 0}, LineTotals{4, 5, 5, 4, 0, 0, 0, 0, 0}}) {
    view.totals = wrong;
    try {
      record.row(view, snapshot);
      FAIL("it does not add up");
    } catch (const Failure& failure) {
      CHECK(failure.code() == exit_unstable);
      CHECK(contains(failure.what(), "at 0.5 s particles do not add up: 4 at the start and 5 fed"));
    }
  }
}

TEST_CASE("line: energy that enters and leaves is in the balance") {
  Energy start{}, now{};
  start.kinetic = 1, now.kinetic = 2, now.entered = 3, now.left_with = 2;
  CHECK(balance_error(start, now) == Approx(0));
  now.left_with = 1.5;
  CHECK(balance_error(start, now) == Approx(-0.5 / 3));
}

TEST_CASE("line: messages name serial numbers, diameters of the kind, and what to do when it is full") {
  const CaseFacts facts = facts_of_species();
  CHECK(fault_sentence(facts, {Fault::overlap, 5, 10, 0.61, 0.5}, {6, 2}) ==
        "particle 6 (diameter 0.006 m) has an overlap of 0.61 radii of the smallest particle (limit 0.5)");
  const Status full{Fault::line_full, -1, 10, 7, 6};
  CHECK(fault_name(full.fault) == std::string("line_full"));
  CHECK(fault_exit_code(full.fault) == exit_capacity);
  CHECK(contains(fault_sentence(facts, full), "7 (limit 6)"));
  CHECK(contains(fault_advice(facts, full, 0), "raise [particles] capacity"));

  CaseFacts soft = facts;
  soft.stability_limit = 1e9, soft.max_overlap = soft.overlap_warning = 1, soft.integrator = Integrator::euler;
  soft.pair_contact = soft.wall_contact = {1e8, 0, 0, 0, 0, 1};
  soft.pair_radius = 0.005, soft.pair_mass = soft.mass;
  StabilityWatch watch(soft);
  const Snapshot snapshot = take_snapshot(ThreePresent(), 6);
  CHECK_FALSE(watch.look(0.1, {snapshot.contacts[1]}, 2e-5, &snapshot));
  CHECK(watch.particle() == 6);
}

TEST_CASE("line: the summary's entry has these keys, and null where nothing was seen") {
  Outcome outcome;
  outcome.snapshot = take_snapshot(ThreePresent(), 6);
  const CaseFacts facts = facts_of_species();
  CHECK_FALSE(nlohmann::json::parse(encode_summary(facts, Options{}, outcome)).contains("line"));
  outcome.line = line_result(facts, ThreePresent().line(), {}, {}, 1);
  const auto summary = nlohmann::ordered_json::parse(encode_summary(facts, Options{}, outcome));
  std::vector<std::string> keys;
  for (const auto& [key, value] : summary["line"].items()) keys.push_back(key);
  CHECK(keys == std::vector<std::string>{"at_start", "fed", "left", "present", "asked_rate", "accepted_rate", "backlog",
                                         "blocked_time", "holdup", "plug_velocity", "plug_particle_velocity",
                                         "plug_length", "layer_ratio", "layer_ratio_eq41", "plug_frequency", "plugs",
                                         "inlet_pressure"});
  CHECK(summary["line"]["left"] == 4);
  CHECK(summary["line"]["plugs"] == 0);
  CHECK(summary["line"]["backlog"] == 0.001);
  CHECK(summary["line"]["plug_velocity"].is_null());
  CHECK(summary["line"]["plug_frequency"].is_null());
  CHECK(summary["line"]["holdup"].is_null());
  CHECK(summary["species"][0]["count"] == 2);  // of those present
  CHECK(summary["species"][1]["mass"].get<double>() == Approx(three_kinds[2].mass()));
  CHECK(summary["sizes"]["total_mass"].get<double>() == Approx(2 * facts.mass + three_kinds[2].mass()));
  CHECK(summary["particles"][2]["diameter"] == 0.006);
}

TEST_CASE("line: the live picture shows it in pieces") {
  const CaseFacts facts = facts_of_line();
  Watch watch(facts, 1, 60, false);
  LogRow row;
  row.line.totals = ThreePresent().line();
  const std::string picture = watch.picture(take_snapshot(ThreePresent(), 6), row);
  std::size_t rules = 0;
  for (std::size_t at = picture.find("+--"); at != std::string::npos; at = picture.find("+--", at + 1)) ++rules;
  CHECK(rules == 3);  // two pieces of twenty diameters
  CHECK(contains(picture, "3 particles present, 3 fed, 4 left, 0.001 kg wait"));
}
