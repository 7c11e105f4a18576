// Checkpoints as bytes, and outputs that are continued: what comes back, and what is refused.
#include "tools/run/checkpoint.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "program_run.hpp"
#include "tools/run/failure.hpp"
#include "tools/run/result_folder.hpp"
#include "with_checksum.hpp"

using namespace fixdem::tests;
using namespace fixdem::program;
namespace files = std::filesystem;

namespace {

Checkpoint example() {
  Checkpoint c;
  c.identity = {{"case", "settle"}, {"precision", "double"}};
  c.duration = 0.2, c.case_duration = 0.1, c.start = 11, c.seed = 7, c.frames = false, c.step = 1200, c.time = 0.0024;
  c.outputs.grown = {{"log.csv", {100, 200}}, {"dump.lammpstrj", {300, 400}}};
  c.outputs.contacts = {{0.003, {9, 10}}};
  c.outputs.frames = {{0.001, {5, 6}}, {0.002, {7, 8}}};
  c.simulation = std::string("\0simulation", 11), c.program = "program";
  return c;
}

/// The message of a refusal; empty when there was none.
template <class Call>
std::string refusal(Call&& call) {
  try {
    call();
  } catch (const Failure& failure) {
    CHECK(failure.code() == exit_bad_input);
    return failure.what();
  }
  return "";
}

}  // namespace

TEST_CASE("checkpoint: comes back as it was, and nothing else does") {
  Checkpoint c = example();
  const std::string bytes = encode_checkpoint(c);
  const Checkpoint back = decode_checkpoint(bytes, "it");
  CHECK(back.identity == c.identity);
  CHECK(back.duration == 0.2);
  CHECK(back.case_duration == 0.1);
  CHECK(back.start == 11);
  CHECK(back.seed == 7);
  CHECK_FALSE(back.frames);
  CHECK(back.step == 1200);
  CHECK(back.time == 0.0024);
  REQUIRE(back.outputs.grown.size() == 2);
  CHECK(back.outputs.grown[0].name == "log.csv");
  CHECK(back.outputs.grown[0].file.size == 100);
  CHECK(back.outputs.grown[0].file.hash == 200);
  CHECK(back.outputs.grown[1].name == "dump.lammpstrj");
  CHECK(back.outputs.grown[1].file.hash == 400);
  REQUIRE(back.outputs.contacts.size() == 1);
  CHECK(back.outputs.contacts[0].file.hash == 10);
  REQUIRE(back.outputs.frames.size() == 2);
  CHECK(back.outputs.frames[1].time == 0.002);
  CHECK(back.outputs.frames[1].file.hash == 8);
  CHECK(back.simulation == c.simulation);
  CHECK(back.program == c.program);

  for (std::size_t size = 0; size < bytes.size(); ++size)
    if (refusal([&] { decode_checkpoint(bytes.substr(0, size), "it"); }).empty()) FAIL("accepted, cut to ", size);
  CHECK_FALSE(refusal([&] { decode_checkpoint(bytes + "x", "it"); }).empty());
  std::string changed = bytes;
  for (std::size_t at = 0; at < bytes.size(); ++at)
    for (int bit = 0; bit < 8; ++bit) {
      changed[at] = static_cast<char>(bytes[at] ^ (1 << bit));
      if (refusal([&] { decode_checkpoint(changed, "it"); }).empty()) FAIL("accepted with bit ", bit, " of ", at);
      // With the right checksum the contents must be looked at without harm, whatever they say.
      refusal([&] { decode_checkpoint(with_checksum(changed), "it"); });
      changed[at] = bytes[at];
    }
  changed = bytes;
  changed[12] = 9;
  CHECK(contains(refusal([&] { decode_checkpoint(with_checksum(changed), "it"); }), "it has version 9, this program"));
  changed = bytes;
  std::reverse(changed.begin() + 8, changed.begin() + 12);
  CHECK(contains(refusal([&] { decode_checkpoint(changed, "it"); }), "byte order"));
  CHECK(contains(refusal([&] { decode_checkpoint("something else", "it"); }), "it is no checkpoint"));
}

TEST_CASE("checkpoint: another program's is refused with all that differs") {
  const Identity there = example().identity;
  CHECK(differences(there, there).empty());
  const std::string text = differences(there, {{"case", "settle"}, {"precision", "mixed"}, {"kernel", "1"}});
  CHECK(text == "\n  precision: double there, mixed here\n  kernel: nothing there, 1 here");
  CHECK(contains(differences(there, {{"case", "settle"}}), "precision: double there, nothing here"));
}

TEST_CASE("outputs: log, dump and frames go on behind a position, whatever came after it") {
  CaseFacts facts{};
  facts.diameter = 0.01, facts.pipe_diameter = 0.05, facts.pipe_length = 0.8, facts.dump = true;
  Options options;
  options.out = scratch("outputs_unit");
  prepare_folder(options.out);
  Snapshot snapshot;
  snapshot.particles.resize(2);
  const auto write = [&](Outputs& outputs, int k) {
    snapshot.step = k, snapshot.time = 1e-3 * k;
    LogRow row;
    row.step = k;
    outputs.log(row);
    outputs.frame(snapshot);
  };
  const auto bytes = [&] {
    std::vector<std::string> all;
    for (const char* name : {"log.csv", "dump.lammpstrj", "frames.pvd", "frames/frame_000002.vtp"})
      all.push_back(read_bytes(options.out / name));
    return all;
  };
  std::vector<std::string> whole;
  OutputPosition position;
  {
    Outputs outputs(facts, options, nullptr);
    for (int k = 0; k < 3; ++k) {
      write(outputs, k);
      if (k == 0) position = outputs.position();
    }
    outputs.flush();
    whole = bytes();
    write(outputs, 9);
  }
  CHECK(difference(options, position).empty());
  {
    Outputs outputs(facts, options, &position);
    CHECK(outputs.frame_count() == 1);
    CHECK_FALSE(files::exists(frame_path(options.out, 1)));
    for (int k = 1; k < 3; ++k) write(outputs, k);
  }
  CHECK(bytes() == whole);
  CHECK_FALSE(files::exists(frame_path(options.out, 3)));
  write_bytes(options.out / "dump.lammpstrj", "x");
  CHECK(contains(difference(options, position), "dump.lammpstrj is cut short: it has 1 bytes"));
}
