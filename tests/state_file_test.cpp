// final.fixdem and what a case takes over from one (tools/run/state_file.hpp, start.hpp), and the hash of a state.
#include "tools/run/state_file.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "program_run.hpp"
#include "tools/run/failure.hpp"
#include "tools/run/no_simulation.hpp"
#include "tools/run/options.hpp"
#include "tools/run/start.hpp"
#include "with_checksum.hpp"

using namespace fixdem;
using namespace fixdem::program;

namespace {

StoredState example_state() {
  StoredState state;
  state.case_name = "example";
  state.source_hash = 0x123456789abcdef0;
  state.complete = true;
  state.diameter = 0.01, state.time = 0.3, state.duration = 0.5;
  state.step = 150000;
  state.particles = {{{0.001, -0.002, 0.1}, {1, 2, 3}, {4, 5, 6}}, {{0, 0, 0.109}, {-1, 0, 1e-300}, {0, 0, -0.0}}};
  state.images = {0, -2};
  state.histories = {{0, 1, {1e-7, 0, -2e-8}}, {1, -1, {3, 2, 1}}};
  return state;
}

std::string refusal(const std::string& bytes) {
  try {
    decode_state(bytes, "some.fixdem");
  } catch (const Failure& failure) {
    CHECK(failure.code() == exit_bad_input);
    return failure.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("state file: reads back exactly; any damage is refused and named") {
  const StoredState state = example_state();
  const std::string bytes = encode_state(state);
  const StoredState again = decode_state(bytes, "some.fixdem");
  CHECK(encode_state(again) == bytes);
  CHECK(again.case_name == "example");
  CHECK(again.complete);
  CHECK(std::memcmp(again.particles.data(), state.particles.data(), 2 * sizeof(Particle)) == 0);
  CHECK(again.images == state.images);
  CHECK(again.histories[1].partner == -1);

  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::string damaged = bytes;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x10);
    if (refusal(damaged) == "accepted") FAIL("a flipped bit at byte ", i, " went unnoticed");
    if (refusal(bytes.substr(0, i)) == "accepted") FAIL("a file cut off at byte ", i, " was accepted");
  }
  CHECK(refusal("something else entirely").find("no state file") != std::string::npos);
  std::string swapped = bytes;
  std::reverse(swapped.begin() + 8, swapped.begin() + 12);
  CHECK(refusal(swapped).find("byte order") != std::string::npos);
  std::string newer = bytes;
  newer[12] = 9;
  CHECK(refusal(newer).find("version 9") != std::string::npos);
  CHECK(refusal(newer).find("reads versions 1 to 4") != std::string::npos);
  // A right checksum over impossible contents: a history of particle 7 of 2.
  StoredState impossible = state;
  impossible.histories[0].partner = 7;
  CHECK(refusal(encode_state(impossible)).find("impossible contact") != std::string::npos);
}

TEST_CASE("state file: rolling histories are in files of the cases that have them, and only there") {
  StoredState state = example_state();
  const std::string plain = encode_state(state);
  CHECK(plain.substr(12, 4) == std::string("\1\0\0\0", 4));
  CHECK_FALSE(decode_state(plain, "some.fixdem").has_rolling);
  state.has_rolling = true;
  state.histories[0].rolling[1] = 3e-8, state.histories[1].rolling[2] = -5;
  const std::string bytes = encode_state(state);
  CHECK(bytes.substr(12, 4) == std::string("\2\0\0\0", 4));
  CHECK(bytes.size() == plain.size() + 2 * 24);
  const StoredState again = decode_state(bytes, "some.fixdem");
  CHECK(again.has_rolling);
  CHECK(again.histories[0].rolling[1] == 3e-8);
  CHECK(again.histories[1].rolling[2] == -5);
  CHECK(encode_state(again) == bytes);
  for (std::size_t i = 0; i < bytes.size(); ++i)
    if (refusal(bytes.substr(0, i)) == "accepted") FAIL("a file cut off at byte ", i, " was accepted");
  // A right checksum over contacts that are too short or too long for the version, and over no number.
  for (const char version : {'\1', '\2'}) {
    std::string other = version == '\1' ? bytes : plain;
    other[12] = version;
    CHECK(refusal(fixdem::tests::with_checksum(other)) != "accepted");
  }
  state.histories[0].rolling[0] = std::nan("");
  CHECK(refusal(encode_state(state)).find("impossible contact") != std::string::npos);
}

TEST_CASE("state hash: rolling histories count where there are any") {
  Snapshot a;
  a.particles = example_state().particles;
  Contact contact{};
  contact.owner = 0, contact.partner = 1, contact.overlap = 1e-6, contact.normal[2] = 1;
  a.contacts.push_back(contact);
  Snapshot b = a;
  b.contacts[0].rolling_history[1] = 1e-9;
  CHECK(state_hash(a) != state_hash(b));
  a.contacts[0].rolling_history[1] = 1.0000001e-9;
  CHECK(state_hash(a) != state_hash(b));
  // What is a force or a normal makes no difference, with or without.
  a = b;
  b.contacts[0].rolling_force[0] = 5;
  CHECK(state_hash(a) == state_hash(b));
}

TEST_CASE("state hash: does not depend on which particle of a pair the kernel calls the owner") {
  Snapshot a;
  a.particles = example_state().particles;
  a.contacts.push_back({0, 1, 1e-6, {0, 0, 1}, 1, {0, 0, 0}, {1e-7, 2e-7, 0}, {}, {}});
  Snapshot b = a;
  CHECK(state_hash(a) == state_hash(b));
  b.contacts[0].history[0] = 1.0000001e-7;
  CHECK(state_hash(a) != state_hash(b));
  b = a;
  b.particles[1].velocity[2] = 2e-300;
  CHECK(state_hash(a) != state_hash(b));
}

namespace {

/// Takes down the histories that a start gives back.
class Recorder final : public NoSimulation {
 public:
  void restore_history(int owner, int partner, const double (&h)[3], const double (&rolling)[3]) override {
    histories.push_back({owner, partner, {h[0], h[1], h[2]}, {rolling[0], rolling[1], rolling[2]}});
  }

  std::vector<StoredHistory> histories;
};

/// The histories that a case with these rolling frictions takes over from the state, which went through a file.
std::vector<StoredHistory> taken_over(const StoredState& state, double of_pairs, double at_walls) {
  CaseFacts facts{};
  facts.name = "later", facts.start = StartKind::from, facts.start_from = "example", facts.start_keeps_motion = true;
  facts.particle_count = 2, facts.diameter = state.diameter, facts.pipe_length = 1;
  facts.has_wall = facts.has_rotation = facts.is_periodic = true;
  facts.pair_contact.rolling_friction = of_pairs, facts.wall_contact.rolling_friction = at_walls;
  facts.has_rolling = of_pairs > 0 || at_walls > 0;
  const std::filesystem::path file = fixdem::tests::scratch("taken_over.fixdem");
  write_state(file, state);
  Options options;
  options.quiet = true, options.start_state = file;
  Recorder recorder;
  start_simulation(recorder, facts, options);
  return recorder.histories;
}

bool is_zero(const double (&v)[3]) { return v[0] == 0 && v[1] == 0 && v[2] == 0; }

}  // namespace

TEST_CASE("start: rolling histories are taken over where a contact rolls against resistance, and begin at zero else") {
  StoredState with = example_state(), without = with;
  with.has_rolling = true;
  with.histories[0].rolling[1] = 3e-8, with.histories[1].rolling[2] = -5;
  const auto all = taken_over(with, 0.05, 0.05);
  REQUIRE(all.size() == 2);
  CHECK(all[0].rolling[1] == 3e-8);
  CHECK(all[1].rolling[2] == -5);
  const auto dropped = taken_over(with, 0, 0), begun = taken_over(without, 0.05, 0.05);
  for (const auto& histories : {dropped, begun}) {
    REQUIRE(histories.size() == 2);
    for (std::size_t k = 0; k < 2; ++k) {
      CHECK(is_zero(histories[k].rolling));
      CHECK(std::memcmp(histories[k].history, with.histories[k].history, sizeof with.histories[k].history) == 0);
    }
  }
  const auto pairs_only = taken_over(with, 0.05, 0);
  CHECK(pairs_only[0].rolling[1] == 3e-8);
  CHECK(is_zero(pairs_only[1].rolling));
}
