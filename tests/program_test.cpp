// Runs the programs as a user does: what they promise about results, files, messages and exit codes.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "program_run.hpp"
#include "program_start.hpp"

using namespace fixdem::tests;
using fixdem::program::decode_state;
using fixdem::program::encode_state;
using fixdem::program::StoredState;
using nlohmann::json;

namespace {

const char* const shipped[] = {"collide_pair",  "collide_wall", "oblique_wall", "drag_single", "settle",
                               "settle_mixed",  "pipe_bed",     "fill_1000",    "fill_500",    "plug_u24",
                               "plug_u24_n500", "plug_u17",     "plug_u17_d3",  "plug_u24_d3"};

bool is_plug(const std::string& name) { return name.rfind("plug", 0) == 0; }

/// The option that gives a plug case something to start from.
std::string start_option(const std::string& name) {
  if (!is_plug(name)) return "";
  const int count = contains(name, "n500") ? 500 : 1000;
  const auto path = scratch("pile_" + std::to_string(count) + ".fixdem");
  if (!std::filesystem::exists(path)) write_bytes(path, encode_state(pile(count, "fill_" + std::to_string(count))));
  return " --start-state " + shell_word(path);
}

void check_keys(const json& object, std::initializer_list<const char*> keys) {
  for (const char* key : keys) CHECK_MESSAGE(object.contains(key), key, " is missing");
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

}  // namespace

TEST_CASE("program: a short run of every shipped case") {
  for (const std::string name : shipped) {
    CAPTURE(name);
    const ProgramRun run = run_program(name, name, "--duration 0.0004" + start_option(name));
    REQUIRE_MESSAGE(run.exit_code == 0, run.standard_error);
    const json s = run.summary();
    check_keys(s, {"case",      "case_hash", "features",  "precision",   "integrator", "time_step",   "steps",
                   "status",    "final",     "stability", "energy",      "capacity",   "performance", "plug",
                   "collision", "particles", "kernel",    "start_state", "duration",   "frames"});
    check_keys(s["stability"], {"maximum_step_ratio", "steps_per_contact", "steps_per_contact_needed"});
    check_keys(s["final"], {"time", "kinetic_energy", "contacts", "coordination_number", "max_overlap", "max_speed",
                            "mean_axial_velocity", "mean_height", "state_hash"});
    check_keys(s["energy"], {"kinetic", "elastic", "elastic_tangential", "dissipated", "dissipated_damping",
                             "dissipated_sliding", "made_by_law", "gravity_work", "gas_work", "balance_error"});
    check_keys(s["performance"], {"wall_time", "particle_steps_per_second"});
    for (const auto& use : s["capacity"]) CHECK(use["high_water"] <= use["limit"]);
    CHECK(s["case"] == name);
    CHECK(s["status"] == "done");
    CHECK(s["precision"] == (contains(name, "mixed") ? "mixed" : "double"));
    CHECK(s["steps"] == 200);
    CHECK(s["final"]["time"].get<double>() == doctest::Approx(0.0004));
    CHECK(s["plug"].is_object() == (is_plug(name) || name == "drag_single"));
    if (is_plug(name))
      check_keys(s["plug"], {"front_velocity", "particle_velocity", "length", "layer_area_ratio",
                             "layer_area_ratio_eq41", "pressure_gradient"});

    const StoredState state = decode_state(run.file("final.fixdem"), "final.fixdem");
    CHECK(state.case_name == name);
    CHECK(state.complete);
    CHECK(state.step == 200);
    CHECK(s["particles"].is_null() == (state.particles.size() > 64));
    const auto log = lines_of(run.file("log.csv"));
    REQUIRE(log.size() >= 3);
    CHECK(contains(log[0], "time [s],step,kinetic energy translation [J]"));
    for (const std::string& line : log)
      CHECK(std::count(line.begin(), line.end(), ',') == std::count(log[0].begin(), log[0].end(), ','));
    for (const auto& entry : std::filesystem::recursive_directory_iterator(run.out))
      CHECK_FALSE(entry.path().extension() == ".part");
  }
}

TEST_CASE("program: collisions give back their restitution, contact time and overlap") {
  const json pair = run_program("collide_pair", "pair", "").summary()["collision"];
  CHECK(pair["restitution"].get<double>() == doctest::Approx(0.9).epsilon(0.002));
  CHECK(pair["tangential_restitution"].is_null());
  const json wall = run_program("collide_wall", "wall", "").summary()["collision"];
  CHECK(wall["restitution"].get<double>() == doctest::Approx(0.9).epsilon(0.002));
  // Without damping 8.22e-5 s and 2.79e-5 m; damping lengthens and flattens a little.
  CHECK(wall["contact_time"].get<double>() == doctest::Approx(8.22e-5).epsilon(0.02));
  CHECK(wall["max_overlap"].get<double>() == doctest::Approx(2.79e-5).epsilon(0.05));
  CHECK(wall["max_overlap"].get<double>() < 2.79e-5);

  const json s = run_program("oblique_wall", "oblique", "").summary();
  const json oblique = s["collision"];
  CHECK(oblique["restitution"].get<double>() == doctest::Approx(0.9).epsilon(0.002));
  const double tangential = oblique["tangential_restitution"], spin = oblique["angular_velocity"];
  CHECK(tangential < 1);
  CHECK(tangential > 0.5);
  // The impulse that slows the centre spins the sphere: I omega = m r (v_t' - v_t), I = (2/5) m r^2.
  const double incoming = 1.648211, radius = 0.005;
  CHECK(spin == doctest::Approx(2.5 * (tangential - 1) * incoming / radius).epsilon(1e-9));
  CHECK(s["particles"][0]["velocity"][0].get<double>() == doctest::Approx(tangential * incoming).epsilon(1e-9));
}

TEST_CASE("program: mixed precision is named, and differs by rounding") {
  const json full = run_program("settle", "double", "--duration 0.01 --quiet").summary()["final"];
  const json mixed = run_program("settle_mixed", "mixed", "--duration 0.01 --quiet").summary()["final"];
  CHECK(mixed["state_hash"] != full["state_hash"]);
  CHECK(mixed["kinetic_energy"].get<double>() == doctest::Approx(full["kinetic_energy"].get<double>()).epsilon(1e-5));
  CHECK(contains(run_program("settle_mixed", "mixed_version", "--version").standard_output, "precision:       mixed"));
}

TEST_CASE("program: a single particle in rising gas falls as published") {
  const json s = run_program("drag_single", "drag", "").summary();
  CHECK(s["particles"][0]["velocity"][2].get<double>() == doctest::Approx(-0.05263133).epsilon(1e-4));
  CHECK(s["collision"].is_null());
  CHECK(s["plug"]["front_velocity"].is_null());
}

TEST_CASE("program: the same seed gives the same bytes, another seed others") {
  const ProgramRun a = run_program("settle", "seed_a", "--duration 0.01 --seed 5");
  const ProgramRun b = run_program("settle", "seed_b", "--duration 0.01 --seed 5 --quiet");
  const ProgramRun c = run_program("settle", "seed_c", "--duration 0.01 --seed 6");
  CHECK(a.file("final.fixdem") == b.file("final.fixdem"));
  CHECK(a.file("log.csv") == b.file("log.csv"));
  CHECK(a.file("frames/frame_000002.vtp") == b.file("frames/frame_000002.vtp"));
  CHECK(a.summary()["final"] == b.summary()["final"]);
  CHECK(a.summary()["final"]["state_hash"] != c.summary()["final"]["state_hash"]);
  CHECK(a.summary()["seed"] == 5);
}

TEST_CASE("program: table on stdout, plain progress on stderr, silence when asked for") {
  const ProgramRun run = run_program("settle", "output", "--duration 0.02");
  CHECK(contains(run.standard_output, "E transl"));
  CHECK(contains(run.standard_output, "settle: done, 10000 steps"));
  CHECK(contains(run.standard_error, "settle: 100 %"));
  CHECK_FALSE(contains(run.standard_error + run.standard_output, "\r"));
  CHECK_FALSE(contains(run.standard_error + run.standard_output, "\033"));
  CHECK(lines_of(run.standard_error).size() <= 10);
  const ProgramRun quiet = run_program("settle", "quiet", "--duration 0.001 --quiet --no-frames");
  CHECK(quiet.standard_output.empty());
  CHECK(quiet.standard_error.empty());
  CHECK_FALSE(std::filesystem::exists(quiet.out / "frames.pvd"));
  const ProgramRun version = run_program("settle", "version", "--version");
  CHECK(version.exit_code == 0);
  for (const char* part :
       {"case:            settle", "hertz displacement clip rotation", "neighbours 14", "precision:       double"})
    CHECK(contains(version.standard_output, part));
  CHECK_FALSE(std::filesystem::exists(version.out));
  CHECK(run_program("settle", "help", "--help").exit_code == 0);
}

namespace {

/// Values of a named array in a VTP file, read from its raw appended data by the offset and size that it gives.
template <class T>
std::vector<T> vtp_array(const std::string& vtp, const std::string& name) {
  const std::size_t tag = vtp.find("Name=\"" + name + "\"");
  REQUIRE(tag != std::string::npos);
  const std::size_t offset = std::stoull(vtp.substr(vtp.find("offset=\"", tag) + 8));
  const std::size_t data = vtp.find("<AppendedData encoding=\"raw\">");
  REQUIRE(data != std::string::npos);
  const std::size_t begin = vtp.find('_', data) + 1 + offset;
  std::uint64_t bytes;
  std::memcpy(&bytes, vtp.data() + begin, sizeof bytes);
  REQUIRE(begin + sizeof bytes + bytes <= vtp.size());
  std::vector<T> values(bytes / sizeof(T));
  std::memcpy(values.data(), vtp.data() + begin + sizeof bytes, bytes);
  return values;
}

}  // namespace

TEST_CASE("program: the last frame holds the final state, and frames.pvd lists every frame") {
  const ProgramRun run = run_program("settle", "frames", "--duration 0.1");
  const StoredState state = decode_state(run.file("final.fixdem"), "final.fixdem");
  const auto pvd = lines_of(run.file("frames.pvd"));
  std::vector<std::string> frames;
  for (const std::string& line : pvd)
    if (const auto at = line.find("file=\""); at != std::string::npos)
      frames.push_back(line.substr(at + 6, line.find('"', at + 6) - at - 6));
  REQUIRE(frames.size() == 21);  // every 5 ms
  for (const std::string& frame : frames) CHECK(std::filesystem::exists(run.out / frame));
  CHECK(contains(pvd[pvd.size() - 3], "timestep=\"0.1\""));

  const std::string vtp = run.file(frames.back().c_str());
  CHECK(contains(vtp, "header_type=\"UInt64\""));
  CHECK(contains(vtp, "NumberOfPoints=\"150\" NumberOfVerts=\"150\""));
  const auto position = vtp_array<double>(vtp, "Points"), velocity = vtp_array<double>(vtp, "velocity"),
             spin = vtp_array<double>(vtp, "angular_velocity"), radius = vtp_array<double>(vtp, "radius");
  const auto id = vtp_array<std::int32_t>(vtp, "id"), contacts = vtp_array<std::int32_t>(vtp, "contacts");
  const auto connectivity = vtp_array<std::int64_t>(vtp, "connectivity"),
             offsets = vtp_array<std::int64_t>(vtp, "offsets");
  REQUIRE(position.size() == 450);
  REQUIRE(radius.size() == 150);
  REQUIRE(offsets.size() == 150);
  std::map<int, int> expected;
  for (const auto& h : state.histories) {
    ++expected[h.owner];
    if (h.partner >= 0) ++expected[h.partner];
  }
  CHECK(state.histories.size() > 5);
  for (std::size_t i = 0; i < 150; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      CHECK(position[3 * i + k] == state.particles[i].position[k]);
      CHECK(velocity[3 * i + k] == state.particles[i].velocity[k]);
      CHECK(spin[3 * i + k] == state.particles[i].angular_velocity[k]);
    }
    CHECK(radius[i] == 0.005);
    CHECK(id[i] == static_cast<int>(i));
    CHECK(contacts[i] == expected[static_cast<int>(i)]);
    CHECK(connectivity[i] == static_cast<int>(i));
    CHECK(offsets[i] == static_cast<int>(i) + 1);
  }
}

TEST_CASE("program: [start] from finds the other case's final state beside its own folder") {
  write_bytes(scratch("beside/fill_500/final.fixdem"), encode_state(pile(500, "fill_500")));
  const ProgramRun run = run_program("plug_u24_n500", "beside/plug_u24_n500", "--duration 0.0002");
  CHECK(run.exit_code == 0);
  std::filesystem::remove(scratch("beside/fill_500/final.fixdem"));
  const ProgramRun missing = run_program("plug_u24_n500", "beside/plug_u24_n500", "--duration 0.0002");
  CHECK(missing.exit_code == 6);
  CHECK(contains(missing.standard_error, "make run CASE=fill_500"));
}
