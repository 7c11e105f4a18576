// What the programs do when they cannot go on: wrong usage, start states that do not fit, files that cannot be written,
// a run that becomes unstable, signals. Exit codes, messages, and what is left in the folder.
#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <string>
#include <thread>

#include "program_run.hpp"
#include "program_start.hpp"
#include "tools/run/result_folder.hpp"
#include "with_checksum.hpp"

using namespace fixdem::tests;
using fixdem::program::decode_state;
using fixdem::program::encode_state;
using fixdem::program::StoredState;

TEST_CASE("program: wrong usage ends with 2 and leaves nothing") {
  for (const std::string arguments : {"--bogus", "--duration", "--duration -1", "--duration nan", "--duration x",
                                      "--seed -1", "--seed 1.5", "--out ''", "--start-state x", "surplus"}) {
    CAPTURE(arguments);
    const ProgramRun run = run_program("settle", "usage", arguments);
    CHECK(run.exit_code == 2);
    CHECK(contains(run.standard_error, "fixdem: "));
    CHECK(run.standard_output.empty());
    CHECK_FALSE(std::filesystem::exists(run.out));
  }
  CHECK(run_program("collide_pair", "usage", "--seed 2").exit_code == 2);
}

TEST_CASE("program: files that cannot be written end with 6") {
  write_bytes(scratch("a_file"), "in the way");
  const auto out = scratch("a_file") / "out";
  const ProgramRun run =
      run_command(shell_word(program("settle")) + " --duration 0.001 --out " + shell_word(out), "unwritable", out);
  CHECK(run.exit_code == 6);
  CHECK(contains(run.standard_error, out.string()));
  CHECK(read_bytes(scratch("a_file")) == "in the way");
  if (std::filesystem::exists("/dev/full")) {
    std::filesystem::remove_all(scratch("full"));  // a run that is done already writes no table
    const ProgramRun full = run_command(
        "{ " + shell_word(program("collide_pair")) + " --out " + shell_word(scratch("full")) + " > /dev/full; }",
        "full", scratch("full"));
    CHECK(full.exit_code == 6);
    CHECK(contains(full.standard_error, "standard output"));
    CHECK(full.summary()["status"] == "done");
  }
}

namespace {

ProgramRun start_from(const std::string& bytes, const char* name) {
  write_bytes(scratch("start.fixdem"), bytes);
  return run_program("plug_u24_n500", name, "--duration 0.0002 --start-state " + shell_word(scratch("start.fixdem")));
}

}  // namespace

TEST_CASE("program: a start state that is damaged or does not fit is refused with 3, naming what differs") {
  const StoredState good = pile(500, "fill_500");
  const std::string bytes = encode_state(good);
  CHECK(start_from(bytes, "good").exit_code == 0);
  // The finished run is that of this state and no other.
  const auto again = [](const std::filesystem::path& state) {
    return run_command(shell_word(program("plug_u24_n500")) + " --resume --duration 0.0002 --out " +
                           shell_word(scratch("good")) + " --start-state " + shell_word(state),
                       "again", scratch("good"));
  };
  CHECK(again(scratch("start.fixdem")).exit_code == 0);
  CHECK(again("/nowhere/at/all").exit_code == 6);
  StoredState moved = good;
  moved.particles[3].velocity[0] = 1e-3;
  write_bytes(scratch("moved.fixdem"), encode_state(moved));
  const ProgramRun contradicting = again(scratch("moved.fixdem"));
  CHECK(contradicting.exit_code == 2);
  CHECK_MESSAGE(contains(contradicting.standard_error, "--start-state"), contradicting.standard_error);
  const auto refused = [&](const std::string& state, const std::string& reason) {
    CAPTURE(reason);
    const ProgramRun run = start_from(state, "refused");
    CHECK(run.exit_code == 3);
    CHECK_MESSAGE(contains(run.standard_error, reason), run.standard_error);
    CHECK_FALSE(std::filesystem::exists(run.out));
  };
  std::string changed = bytes;
  changed[1000] ^= 1;
  refused(changed, "checksum");
  refused(bytes.substr(0, 5000), "cut short");
  refused("", "no state file");
  changed = bytes;
  changed[12] = 5;
  refused(with_checksum(changed), "version 5");
  changed = bytes;
  std::reverse(changed.begin() + 8, changed.begin() + 12);
  refused(with_checksum(changed), "byte order");
  StoredState other = pile(400, "fill_500");
  refused(encode_state(other), "400 particles");
  other = good;
  other.diameter = 0.009;
  refused(encode_state(other), "0.009 m wide");
  other = good;
  other.particles[7].position[2] = 0.81;
  refused(encode_state(other), "particle 7 lies at z = 0.81 m");
  other = good;
  other.particles[7].position[0] = 0.03;
  refused(encode_state(other), "particle 7");

  // From the usual place, the state must be that of the other case, run to its end.
  other = good;
  other.case_name = "fill_something";
  const auto beside = [&](const StoredState& state) {
    write_bytes(scratch("strange/fill_500/final.fixdem"), encode_state(state));
    return run_program("plug_u24_n500", "strange/plug", "--duration 0.0002");
  };
  CHECK(beside(good).exit_code == 0);
  CHECK(beside(other).exit_code == 3);
  other = good;
  other.complete = false;
  other.time = 0.5;
  const ProgramRun interrupted = beside(other);
  CHECK(interrupted.exit_code == 3);
  CHECK(contains(interrupted.standard_error, "interrupted at 0.5 s of 1.2 s"));
  CHECK(run_program("plug_u24_n500", "absent", "--start-state /nowhere/at/all").exit_code == 6);
}

TEST_CASE("program: a run that becomes unstable ends with 5, says why, and keeps what it has") {
  // A particle and its twelve neighbours of a close packing, pressed together by 0.44 radii, fly apart at hundreds of
  // metres per second.
  StoredState state = pile(500, "fill_500");
  const auto others = fixdem::program::arrange_moving({0.05, 0.36, false}, 487, 0.01, 0, 1);
  std::copy(others.begin(), others.end(), state.particles.begin() + 13);
  int id = 0;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z)
        if ((x + y + z) % 2 == 0) {
          const double spacing = 0.0078 / std::sqrt(2.0);
          state.particles[static_cast<std::size_t>(id++)] = {{x * spacing, y * spacing, 0.4 + z * spacing}, {}, {}};
        }
  REQUIRE(id == 13);
  write_bytes(scratch("pressed.fixdem"), encode_state(state));
  const ProgramRun run = run_program("plug_u24_n500", "unstable",
                                     "--duration 0.05 --start-state " + shell_word(scratch("pressed.fixdem")));
  REQUIRE(run.exit_code == 5);
  CHECK(contains(run.standard_error, "fixdem: stopped at step "));
  CHECK(contains(run.standard_error, "particle "));
  CHECK(contains(run.standard_error, "limit "));
  CHECK(contains(run.standard_error, "last good state: " + (run.out / "checkpoint-").string()));
  const auto summary = run.summary();
  CHECK(summary["status"] != "done");
  CHECK(summary["plug"]["front_velocity"].is_null());
  CHECK_FALSE(std::filesystem::exists(run.out / "final.fixdem"));
  CHECK(std::filesystem::exists(run.out / "frames.pvd"));
  CHECK(std::filesystem::exists(run.out / "frames/frame_000001.vtp"));
  const std::string log = run.file("log.csv");
  CHECK(contains(log, "," + std::to_string(summary["steps"].get<long long>()) + ","));
}

namespace {

long lines(const std::filesystem::path& path) {
  const std::string text = read_bytes(path);
  return std::count(text.begin(), text.end(), '\n');
}

}  // namespace

TEST_CASE("program: a signal ends the run with 128 + its number and a complete set of files") {
  for (int signal : {SIGTERM, SIGINT, SIGXCPU}) {
    const auto out = scratch("signalled");
    std::filesystem::remove_all(out);
    const pid_t child = fork();
    REQUIRE(child >= 0);
    if (child == 0) {
      std::signal(SIGINT, SIG_DFL);  // a test run in the background must not pass on that it ignores it
      const int nowhere = open("/dev/null", O_WRONLY);
      dup2(nowhere, STDOUT_FILENO);
      dup2(nowhere, STDERR_FILENO);
      execl(program("fill_500").c_str(), "fill_500", "--out", out.c_str(), static_cast<char*>(nullptr));
      _exit(99);
    }
    // The first row of the log is written when the time loop has begun.
    for (int k = 0; k < 6000 && lines(out / "log.csv") < 2; ++k)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    kill(child, signal);
    int status = 0;
    waitpid(child, &status, 0);
    REQUIRE(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 128 + signal);
    const auto summary = nlohmann::json::parse(read_bytes(out / "summary.json"));
    CHECK(summary["status"] == "interrupted");
    const StoredState state = decode_state(read_bytes(out / "final.fixdem"), "final.fixdem");
    CHECK_FALSE(state.complete);
    CHECK(state.step == summary["steps"]);
    CHECK(state.time < 1.2);
    const auto checkpoints = fixdem::program::checkpoints_in(out);
    REQUIRE(checkpoints.size() == 1);
    CHECK(checkpoints[0].filename() == "checkpoint-" + std::to_string(state.step) + ".fixdem");
  }
}
