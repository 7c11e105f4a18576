// Particles of several sizes in what a run writes and reads: frames, dump, log, summary, final state, and what a
// checkpoint must be of. One size alone leaves every byte as it was: the other tests say so.
#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>

#include "cases/settle.hpp"
#include "program_run.hpp"
#include "sized_case.hpp"
#include "tools/run/checkpoint.hpp"
#include "tools/run/dump.hpp"
#include "tools/run/failure.hpp"
#include "tools/run/frames_vtp.hpp"
#include "tools/run/log.hpp"
#include "tools/run/no_simulation.hpp"
#include "tools/run/side_view.hpp"
#include "tools/run/start.hpp"
#include "tools/run/state_file.hpp"
#include "tools/run/summary.hpp"
#include "with_checksum.hpp"

using namespace fixdem;
using namespace fixdem::program;
using doctest::Approx;
using fixdem::tests::contains, fixdem::tests::read_bytes, fixdem::tests::scratch;
using fixdem::tests::FourSizes, fixdem::tests::TwoSpecies;

namespace {

Snapshot four_particles() {
  Snapshot snapshot;
  for (int k = 0; k < 4; ++k) {
    snapshot.particles.push_back({{0, 0, 0.01 * (k + 1)}, {0, 0, 0.1 * k}, {}});
    snapshot.images.push_back(0);
  }
  return snapshot;
}

class CountsPlaced final : public NoSimulation {
 public:
  void place(int, const Particle&) override { ++placed; }
  int placed = 0;
};

/// What is said when a case starts from a file; "accepted" where it does.
std::string start_from(CaseFacts facts, const StoredState& state) {
  const std::filesystem::path file = scratch("sizes.fixdem");
  write_state(file, state);
  facts.start = StartKind::from, facts.start_from = "fill", facts.pipe_length = 1;
  Options options;
  options.quiet = true, options.start_state = file;
  CountsPlaced view;
  try {
    start_simulation(view, facts, options);
  } catch (const Failure& failure) {
    CHECK(failure.code() == exit_bad_input);
    return failure.what();
  }
  CHECK(view.placed == 4);
  return "accepted";
}

template <class Case>
StoredState state_of() {
  return stored_state(case_facts<Case>(), four_particles(), true, 1);
}

}  // namespace

TEST_CASE("dump: the type is the species, and each particle has its radius and mass") {
  const std::string text = encode_dump(four_particles(), case_facts<TwoSpecies<5000>>());
  CHECK(contains(text, "omegaz radius mass\n1 1 0 0 0.01 0 0 0 0 0 0 0.005 0.000523"));
  CHECK(contains(text, "\n3 2 0 0 0.03 0 0 0.2 0 0 0 0.0025 6.54"));
  CHECK(
      contains(encode_dump(four_particles(), case_facts<FourSizes>()), "\n2 1 0 0 0.02 0 0 0.1 0 0 0 0.005 0.000523"));
}

TEST_CASE("frame: own radii; species and densities where they differ") {
  const auto array = [](const std::string& vtp, const std::string& name) {
    const std::size_t at = vtp.find("Name=\"" + name + "\"");
    if (at == std::string::npos) return std::string();
    const std::size_t begin = vtp.find('>', at) + 1;
    return vtp.substr(begin, vtp.find('<', begin) - begin);
  };
  const Snapshot snapshot = four_particles();
  const std::string alike = encode_vtp(snapshot, case_facts<TwoSpecies<5000>>(), VtpData::text);
  CHECK(array(alike, "radius") == "0.005 0.005 0.0025 0.0025");
  CHECK(array(alike, "species") == "0 0 1 1");
  CHECK_FALSE(contains(alike, "density"));
  const CaseFacts heavy = case_facts<TwoSpecies<5000, 2500>>();
  const std::string chosen = encode_vtp(snapshot, heavy, VtpData::text, {1, 3});
  CHECK(array(chosen, "radius") == "0.005 0.0025");
  CHECK(array(chosen, "density") == "1000 2500");
  CHECK(array(encode_vtp(snapshot, heavy, VtpData::text, {0, 1}), "density") == "1000 1000");
  const std::string each = encode_vtp(snapshot, case_facts<FourSizes>(), VtpData::text);
  CHECK(array(each, "radius") == "0.003 0.005 0.002 0.004");
  CHECK_FALSE(contains(each, "species"));
}

TEST_CASE("state file: own diameters and densities, and any damage is refused") {
  StoredState state = state_of<TwoSpecies<5000, 2500>>();
  state.histories = {{0, 1, {1e-7, 0, -2e-8}}};
  const std::string bytes = encode_state(state);
  CHECK(bytes.substr(12, 4) == std::string("\3\0\0\0", 4));
  const StoredState again = decode_state(bytes, "some.fixdem");
  CHECK(again.diameter == 0.01);
  CHECK(again.diameters == std::vector<double>{0.01, 0.01, 0.005, 0.005});
  CHECK(again.densities == std::vector<double>{1000, 1000, 2500, 2500});
  CHECK(encode_state(again) == bytes);
  state.has_rolling = true;
  CHECK(encode_state(state)[12] == '\4');
  CHECK(decode_state(encode_state(state), "some.fixdem").has_rolling);
  const auto refusal = [](const std::string& text) {
    try {
      decode_state(text, "some.fixdem");
    } catch (const Failure& failure) {
      return std::string(failure.what());
    }
    return std::string("accepted");
  };
  for (std::size_t i = 0; i < bytes.size(); ++i)
    if (refusal(bytes.substr(0, i)) == "accepted") FAIL("a file cut off at byte ", i, " was accepted");
  for (const char version : {'\1', '\4'}) {
    std::string other = bytes;
    other[12] = version;
    CHECK(refusal(fixdem::tests::with_checksum(other)) != "accepted");
  }
  for (const double bad : {0.0, -1.0, static_cast<double>(NAN), static_cast<double>(INFINITY)}) {
    state.diameters[2] = bad;
    CHECK(contains(refusal(encode_state(state)), "impossible diameter or density of particle 2"));
  }
}

TEST_CASE("start: from a state whose particles are the same, number by number, or not at all") {
  using Light = TwoSpecies<5000>;
  using Heavy = TwoSpecies<5000, 2500>;
  const CaseFacts facts = case_facts<Light>();
  CHECK(start_from(facts, state_of<Light>()) == "accepted");
  CHECK(
      contains(start_from(facts, state_of<TwoSpecies<4000>>()),
               "particle 2 has diameter 0.004 there and 0.005 here; allowed: the same diameters and densities, number "
               "by number"));
  CHECK(contains(start_from(facts, state_of<Heavy>()), "particle 2 has density 2500 there and 1000 here"));
  CHECK(contains(start_from(facts, state_of<FourSizes>()), "particle 0 has diameter 0.006 there and 0.01 here"));
  CaseFacts equal = case_facts<cases::settle>();
  equal.particle_count = 4;
  CHECK(contains(start_from(equal, state_of<Light>()), "particle 2 has diameter 0.005 there and 0.01 here"));
  // A state of one size knows no densities.
  const StoredState one_size = stored_state(equal, four_particles(), true, 1);
  CHECK(contains(start_from(facts, one_size), "particle 2 has diameter 0.01 there and 0.005 here"));
  CHECK(start_from(case_facts<TwoSpecies<10000, 2500>>(), one_size) == "accepted");
}

TEST_CASE("summary: sizes, and what each species is and does") {
  Outcome outcome;
  outcome.snapshot = four_particles();
  const auto summary_of = [&](const CaseFacts& facts) {
    return nlohmann::json::parse(encode_summary(facts, Options{}, outcome));
  };
  const auto mixed = summary_of(case_facts<TwoSpecies<5000, 2500>>());
  CHECK(mixed["sizes"]["minimum_diameter"] == 0.005);
  CHECK(mixed["sizes"]["maximum_diameter"] == 0.01);
  CHECK(mixed["sizes"]["sauter_diameter"].get<double>() == Approx(0.009));
  CHECK(mixed["particles"][3]["diameter"] == 0.005);
  REQUIRE(mixed["species"].size() == 2);
  const auto& small = mixed["species"][1];
  CHECK(small["name"] == "small");
  CHECK(small["count"] == 2);
  CHECK(small["diameter"] == 0.005);
  CHECK(small["density"] == 2500);
  CHECK(small["mean_axial_velocity"].get<double>() == Approx(0.25));
  CHECK(small["mass"].get<double>() == Approx(2 * 2500 * 3.14159265358979 / 6 * 125e-9));
  CHECK_FALSE(summary_of(case_facts<FourSizes>()).contains("species"));
  const auto equal = summary_of(case_facts<cases::settle>());
  CHECK_FALSE(equal.contains("sizes"));
  CHECK_FALSE(equal.contains("species"));
  CHECK_FALSE(equal["particles"][0].contains("diameter"));
}

TEST_CASE("log: with gas, how fast each species goes; overlaps in radii of the smallest") {
  CaseFacts facts = case_facts<TwoSpecies<5000>>();
  facts.has_gas = true;
  LogRow row;
  row.observation.max_overlap = 0.0025;
  row.species_velocity = {1.25, 2.5};
  const std::string text = log_header(facts) + log_line(facts, row);
  CHECK(contains(text, ",mean axial velocity of large [m/s],mean axial velocity of small [m/s],"));
  CHECK(contains(text, ",1.25,2.5,"));
  CHECK(contains(text, "\n0,0,0,0,0,0,0,1,"));
  facts.has_gas = false;
  CHECK_FALSE(contains(log_header(facts), "mean axial velocity of"));
}

TEST_CASE("checkpoint: of the same particles only") {
  CountsPlaced view;
  const Identity here = identity(case_facts<TwoSpecies<5000>>(), view);
  CHECK(differences(identity(case_facts<TwoSpecies<5000>>(), view), here).empty());
  for (const Identity& there :
       {identity(case_facts<TwoSpecies<4000>>(), view), identity(case_facts<TwoSpecies<5000, 2500>>(), view)})
    CHECK(contains(differences(there, here), "diameters, densities and species (XXH64)"));
}

TEST_CASE("side view: a small sphere covers less") {
  CaseFacts facts = case_facts<TwoSpecies<5000>>();
  facts.pipe_diameter = 0.05, facts.pipe_length = 0.1;
  Snapshot snapshot;
  for (const double z : {0.02, 0.05, 0.07, 0.09}) snapshot.particles.push_back({{0, 0, z}, {}, {}});
  SideView view(facts, 100);
  view.draw(snapshot);
  const auto covered = [&](int first, int last) {
    int count = 0;
    for (int row = 0; row < view.rows(); ++row)
      for (int column = first; column < last; ++column) count += view.letter(row, column) != ' ' ? 1 : 0;
    return count;
  };
  CHECK(covered(0, 35) > 2 * covered(60, 80));
  CHECK(covered(60, 80) > 0);
}
