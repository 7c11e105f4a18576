// The plugs of a line as objects, on profiles of which everything is known: seen, followed, merged, split, gone; what
// passes a station; and the means of a run.
#include <doctest/doctest.h>

#include <cmath>

#include "line_output_case.hpp"
#include "tools/run/line_result.hpp"
#include "tools/run/line_station.hpp"
#include "tools/run/plug_tracks.hpp"

using namespace fixdem;
using namespace fixdem::program;
using doctest::Approx;
using fixdem::tests::facts_of_line;

namespace {

constexpr double layer = 0.2, plug = 0.55;

struct Piece {
  int first, count;
};

/// 200 slices of 10 mm with a layer, and plugs whose particles move at 0.6 m/s under 5 kPa/m.
SliceProfile profile_of(const std::vector<Piece>& plugs) {
  SliceProfile profile;
  profile.slice_length = 0.01, profile.is_periodic = false;
  profile.solids_fraction.assign(200, layer);
  profile.axial_momentum.assign(200, 0);
  profile.particles.assign(200, 10);
  profile.pressure_gradient.assign(200, 100);
  for (const Piece& piece : plugs)
    for (int k = std::max(piece.first, 0); k < std::min(piece.first + piece.count, 200); ++k) {
      const auto slice = static_cast<std::size_t>(k);
      profile.solids_fraction[slice] = plug;
      profile.particles[slice] = 30, profile.axial_momentum[slice] = 30 * 0.6;
      profile.pressure_gradient[slice] = 5000;
    }
  return profile;
}

/// Samples every 10 ms; a plug that moves one slice in each goes 1 m/s.
class Samples {
 public:
  void look(const std::vector<Piece>& plugs) { rows += tracks.look(profile_of(plugs), 0.01 * count++); }
  PlugTrack track(int number) const {
    for (const PlugTrack& track : tracks.all())
      if (track.number == number) return track;
    FAIL("no plug ", number);
    return {};
  }

  CaseFacts facts = facts_of_line();
  PlugTracks tracks{facts};
  std::string rows;
  int count = 0;
};

LineSample sample_at(double time, int passages, double blocked = 0) {
  return {time, 1000 + 100 * time, 1 + 0.1 * time, 0.2 * time, 0.15 * time, 0.1 * time, blocked, passages};
}

}  // namespace

TEST_CASE("plugs of a line: eight diameters long, with their layer, pressure drop and particles") {
  const CaseFacts facts = facts_of_line();
  CHECK(followed_stretch(facts).begin == Approx(0.4));
  CHECK(followed_stretch(facts).end == Approx(1.8));
  CHECK(seen_plugs(facts, profile_of({{50, 7}, {90, 5}})).empty());
  const auto seen = seen_plugs(facts, profile_of({{60, 20}, {120, 30}}));
  REQUIRE(seen.size() == 2);
  // Smoothed over three, 0.40 lies 2/7 of a slice beyond the centre of the last slice (plug_analysis_test.cpp).
  CHECK(seen[0].front == Approx((79.5 + 2.0 / 7) * 0.01));
  CHECK(seen[0].rear == Approx((60.5 - 2.0 / 7) * 0.01));
  CHECK(seen[0].particle_velocity == Approx(0.6));
  CHECK(seen[0].pressure_drop == Approx(20 * 0.01 * 5000));
  CHECK(seen[1].layer_ratio == Approx(layer / 0.52));
  // The layer is that of the followed stretch, to fifty diameters on, and four slices from any plug on.
  SliceProfile profile = profile_of({{60, 20}, {120, 30}});
  for (std::size_t k = 0; k < 40; ++k) profile.solids_fraction[k] = 0.35;
  for (std::size_t k = 180; k < 200; ++k) profile.solids_fraction[k] = 0.35;
  for (const std::size_t k : {56u, 83u, 117u, 150u}) profile.solids_fraction[k] = 0.3;
  for (const SeenPlug& one : seen_plugs(facts, profile)) CHECK(one.layer_ratio == Approx(layer / 0.52));
  profile.solids_fraction[100] = 0.3;  // between them
  for (const SeenPlug& one : seen_plugs(facts, profile)) CHECK(one.layer_ratio > layer / 0.52);
  // A plug at either end of the pipe ends there.
  const auto ends = seen_plugs(facts, profile_of({{0, 10}, {185, 15}}));
  REQUIRE(ends.size() == 2);
  CHECK(ends[0].rear == 0);
  CHECK(ends[1].front == Approx(2));
}

TEST_CASE("plugs of a line: followed from birth to the outlet") {
  Samples run;
  for (int k = 0; k < 200; ++k) run.look({{20 + k, 25}});
  const PlugTrack track = run.track(0);
  CHECK(track.born == 0);
  CHECK(track.born_at == Approx((44.5 + 2.0 / 7) * 0.01));
  CHECK(track.fate == PlugFate::left);
  CHECK(track.front_velocity() == Approx(1));
  CHECK(track.particle_velocity.value() == Approx(0.6));
  CHECK(track.length.value() == Approx(0.24 + 0.02 * 2 / 7));
  CHECK(track.layer_ratio.value() == Approx(layer / 0.52));
  CHECK(track.samples == 136);  // fronts from 0.448 to 1.798 m
  CHECK(track.path() == Approx(1.35));
  CHECK(track.counts());
  CHECK(run.rows.starts_with("0,0,0.447857,,left,,"));
  CHECK(run.tracks.rows_of_present().empty());
}

TEST_CASE("plugs of a line: a short gap is bridged, a death is noticed, and flickers are forgotten") {
  Samples run;
  for (int k = 0; k < 30; ++k) run.look(k == 10 || k == 11 ? std::vector<Piece>{} : std::vector<Piece>{{50 + k, 20}});
  CHECK(run.track(0).last_time == Approx(0.29));
  CHECK(run.track(0).seen == 28);
  for (int k = 0; k < 5; ++k) run.look({});
  CHECK(run.track(0).fate == PlugFate::died);
  CHECK(run.track(0).last_time == Approx(0.29));
  const std::string before = run.rows;
  run.look({{100, 20}});
  run.look({{101, 20}});
  for (int k = 0; k < 5; ++k) run.look({});
  CHECK(run.rows == before);
  CHECK(run.tracks.all().size() == 1);
}

TEST_CASE("plugs of a line: merging and splitting") {
  Samples run;
  for (int k = 0; k < 20; ++k) run.look({{50 + 2 * k, 12}, {90 + k, 30}});  // the shorter one gains on the other
  for (int k = 0; k < 5; ++k) run.look({{100 + k, 50}});
  const PlugTrack merged = run.track(0);
  CHECK(merged.fate == PlugFate::merged);
  CHECK(merged.into == 1);
  CHECK(run.track(1).fate == PlugFate::present);
  CHECK(run.rows.find(",merged,1,") != std::string::npos);
  for (int k = 0; k < 5; ++k) run.look({{105 + k, 12}, {125 + k, 30}});
  const PlugTrack split = run.track(2);
  CHECK(split.parent == 1);
  CHECK(split.born_at < run.track(1).last.front);
  CHECK(run.track(1).last.front == Approx((158.5 + 2.0 / 7) * 0.01));
}

TEST_CASE("plugs of a line: few samples or a short way do not count") {
  Samples slow, brief;
  for (int k = 0; k < 60; ++k) slow.look({{60 + k / 4, 20}});
  CHECK(slow.track(0).samples == 60);
  CHECK_FALSE(slow.track(0).counts());
  for (int k = 0; k < 11; ++k) brief.look({{60 + 3 * k, 20}});
  CHECK(brief.track(0).path() == Approx(0.3));
  CHECK_FALSE(brief.track(0).counts());
  brief.look({{93, 20}});
  CHECK(brief.track(0).counts());
}

TEST_CASE("station: a plug passes when it rises through 0.40, once it has been below 0.30") {
  Passages passages;
  for (const double solids : {0.2, 0.41, 0.5, 0.35, 0.45, 0.31, 0.42, 0.29, 0.39, 0.41}) passages.look(solids);
  CHECK(passages.count() == 2);
}

TEST_CASE("station: rows with pressure, solids, and the mass that went by") {
  const CaseFacts facts = facts_of_line();
  LineSlices slices;
  slices.profile = profile_of({{90, 20}});
  slices.number.assign(200, 1);
  for (int k = 0; k <= 200; ++k) slices.node_pressure.push_back(10 * (200 - k));
  Snapshot snapshot;
  snapshot.is_of_line = true, snapshot.kinds = {0, 0, 0};
  snapshot.particles = {{{0, 0, 0.9}, {}, {}}, {{0, 0, 1.0}, {}, {}}, {{0, 0, 1.5}, {}, {}}};
  LineTotals totals{};
  Station station(1.0);
  station.look(slices);
  CHECK(station.row(facts, snapshot, slices, totals) == "0,1000,0.55,,1\n");
  slices.time = 0.1;
  snapshot.particles[0].position[2] = 1.1;
  snapshot.particles.pop_back();
  snapshot.kinds.pop_back();
  totals.left_mass = facts.mass;
  station.look(slices);
  CHECK(station.row(facts, snapshot, slices, totals) == "0.1,1000,0.55,0.00523599,1\n");
  snapshot.particles[0].position[2] = 0.99;  // it comes back
  slices.time = 0.2;
  CHECK(station.row(facts, snapshot, slices, totals) == "0.2,1000,0.55,-0.00523599,1\n");
}

TEST_CASE("result of a line: means from a time on, scatter, and a verdict") {
  CaseFacts facts = facts_of_line();
  std::vector<LineSample> samples;
  for (int k = 0; k <= 100; ++k) samples.push_back(sample_at(0.1 * k, k / 20));
  std::vector<PlugTrack> plugs;
  for (const int slices_per_sample : {1, 2}) {
    Samples run;
    run.count = 600;
    for (int k = 0; k < 40; ++k) run.look({{50 + slices_per_sample * k, 20}});
    plugs.push_back(run.track(0));
    run.count = 0, run.tracks = PlugTracks(run.facts);
    for (int k = 0; k < 40; ++k) run.look({{50 + k, 20}});
    plugs.push_back(run.track(0));  // too early
  }
  const LineTotals totals{10, 20, 5, 25, 2, 1.5, 1, 0.5, 0};
  const LineResult result = line_result(facts, totals, samples, plugs, 10);
  CHECK(result.plugs == 2);
  CHECK(result.plug_velocity.mean == Approx(1.5));
  CHECK(result.plug_velocity.deviation == Approx(std::sqrt(0.5)));
  CHECK(result.plug_length.mean == Approx(0.19 + 0.02 * 2 / 7));
  CHECK(result.plug_particle_velocity.mean == Approx(0.6));
  CHECK(result.layer_ratio_eq41 == Approx(1 / (1 + 1.84 * 0.6 / std::sqrt(9.81 * 0.05))));
  CHECK(result.asked_rate == Approx(0.2));
  CHECK(result.accepted_rate == Approx(0.15));
  CHECK(result.left_rate == Approx(0.1));
  CHECK(result.holdup.mean == Approx(1.75));
  CHECK(result.inlet_pressure.mean == Approx(1750));
  CHECK(result.plug_frequency == Approx(0.6));  // from 2 at 5 s to 5 at 10 s
  CHECK(verdict(result) == std::string("flows in plugs"));
  CHECK(describe_line(result).find("2 plugs: front 1.5 +- 0.71 m/s") != std::string::npos);

  facts.line.statistics_from = 0;
  CHECK(line_result(facts, totals, samples, plugs, 10).plugs == 4);
  facts.line.statistics_from = 9;
  CHECK(line_result(facts, totals, samples, plugs, 10).plugs == 0);
  CHECK(verdict(line_result(facts, totals, samples, {}, 10)) == std::string("flows without plugs"));
  CHECK(verdict(line_result(facts, LineTotals{3, 0, 0, 3, 0, 0, 0, 0, 0}, samples, {}, 10)) == std::string("fills"));
  CHECK(verdict(line_result(facts, LineTotals{}, samples, {}, 10)) == std::string("empty"));
  samples.push_back(sample_at(10.1, 5, 0.05));
  const LineResult blocked = line_result(facts, totals, samples, plugs, 10);
  CHECK(verdict(blocked) == std::string("blocked"));
  facts.gravity[2] = -9.81, facts.gravity[1] = -1e-15;  // upright: no layer
  CHECK(std::isnan(line_result(facts, totals, samples, plugs, 10).layer_ratio_eq41));
  const LineResult nothing = line_result(facts, totals, {}, {}, 10);
  CHECK(std::isnan(nothing.asked_rate));
  CHECK(std::isnan(nothing.holdup.mean));
  CHECK_FALSE(nothing.is_blocked);
}
