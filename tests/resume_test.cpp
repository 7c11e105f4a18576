// Going on from a checkpoint with the programs: what is refused and what is offered instead, what stands in the way of
// writing one; and two runs in one folder. That killed runs end in the right bytes is the business of kill_test.py.
#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "program_run.hpp"
#include "support.hpp"
#include "tools/run/checkpoint.hpp"
#include "tools/run/result_folder.hpp"
#include "with_checksum.hpp"

using namespace fixdem::tests;
using fixdem::program::checkpoints_in;
using fixdem::program::decode_checkpoint;
namespace files = std::filesystem;

namespace {

constexpr const char* short_run = "--quiet --duration 0.006 --checkpoint-interval 0.001";

/// A run of settle that crashes while it writes the checkpoint after its second frame, at 0.005 s; the two before it
/// are there.
ProgramRun crashed(const std::string& name) {
  ::setenv("FIXDEM_DISK_FAULT", "crash@40", 1);
  ProgramRun run = run_program("settle", name, short_run);
  ::unsetenv("FIXDEM_DISK_FAULT");
  REQUIRE(checkpoints_in(run.out).size() == 2);
  return run;
}

ProgramRun resume(const files::path& out, const std::string& arguments = "", const std::string& name = "settle") {
  return run_command(shell_word(program(name)) + " --quiet --resume --out " + shell_word(out) + " " + arguments,
                     "resume", out);
}

std::string final_state() {
  static const std::string bytes = run_program("settle", "whole", short_run).file("final.fixdem");
  return bytes;
}

}  // namespace

TEST_CASE("resume: what is damaged is refused, and an older checkpoint that is good is offered") {
  const ProgramRun run = crashed("damaged");
  const auto checkpoints = checkpoints_in(run.out);
  const std::string good = read_bytes(checkpoints[0]);
  const auto refused = [&](const std::string& bytes, const std::string& reason) {
    CAPTURE(reason);
    write_bytes(checkpoints[0], bytes);
    const ProgramRun again = resume(run.out);
    CHECK(again.exit_code == 3);
    CHECK_MESSAGE(contains(again.standard_error, reason), again.standard_error);
    CHECK(contains(again.standard_error, checkpoints[0].string()));
    CHECK_MESSAGE(contains(again.standard_error, "--resume-from " + checkpoints[1].string()), again.standard_error);
    CHECK(read_bytes(checkpoints[0]) == bytes);
  };
  std::string changed = good;
  changed[good.size() / 2] ^= 4;
  refused(changed, "is damaged or cut short: checksum");
  refused(good.substr(0, good.size() / 2), "is damaged or cut short");
  refused("", "is no checkpoint");
  const ProgramRun older = resume(run.out, "--resume-from " + shell_word(checkpoints[1]));
  CHECK(older.exit_code == 0);
  CHECK(older.file("final.fixdem") == final_state());
  CHECK(checkpoints_in(run.out).size() == 1);
}

TEST_CASE("resume: the program of another case or precision is refused with what differs") {
  const ProgramRun run = crashed("foreign");
  const ProgramRun other = resume(run.out, "", "settle_mixed");
  CHECK(other.exit_code == 3);
  CHECK(contains(other.standard_error, "case: settle there, settle_mixed here"));
  CHECK(contains(other.standard_error, "precision: double there, mixed here"));
  for (const std::string arguments : {"--duration 0.005", "--seed 3", "--no-frames"}) {
    const ProgramRun contradicting = resume(run.out, arguments);
    CHECK(contradicting.exit_code == 2);
    CHECK_MESSAGE(contains(contradicting.standard_error, arguments.substr(0, arguments.find(' '))),
                  contradicting.standard_error);
  }
  CHECK(checkpoints_in(run.out).size() == 2);
  CHECK(resume(run.out, "--duration 0.006 --seed 1").exit_code == 0);
  CHECK(read_bytes(run.out / "final.fixdem") == final_state());
}

TEST_CASE("resume: a log or frame that is not what it was is noticed") {
  const ProgramRun run = crashed("outputs");
  for (const char* name : {"log.csv", "frames/frame_000000.vtp"}) {
    CAPTURE(name);
    const files::path path = run.out / name;
    const std::string good = read_bytes(path);
    std::string changed = good;
    changed[good.size() / 2] ^= 1;
    const std::vector<std::pair<std::string, const char*>> damages = {
        {changed, "has been changed"}, {good.substr(0, 20), "is cut short: it has 20 bytes"}, {"", "is cut short"}};
    for (const auto& [bytes, reason] : damages) {
      write_bytes(path, bytes);
      const ProgramRun again = resume(run.out);
      CHECK(again.exit_code == 3);
      CHECK_MESSAGE(contains(again.standard_error, path.string() + " " + reason), again.standard_error);
    }
    files::remove(path);
    CHECK(contains(resume(run.out).standard_error, path.string() + " is missing"));
    write_bytes(path, good + "surplus");  // cut off, or written anew
    if (name == std::string("frames/frame_000000.vtp")) write_bytes(path, good);
  }
  const ProgramRun again = resume(run.out);
  CHECK_MESSAGE(again.exit_code == 0, again.standard_error);
  CHECK(again.file("final.fixdem") == final_state());
  CHECK(again.file("log.csv") == read_bytes(scratch("whole") / "log.csv"));
}

TEST_CASE("resume: begins where there is nothing to go on from, and says when all is done") {
  const auto out = scratch("from_nothing");
  files::remove_all(out);
  const ProgramRun first = resume(out, "--duration 0.006");
  CHECK(first.exit_code == 0);
  CHECK(contains(first.standard_error, "there is no checkpoint in"));
  CHECK(first.file("final.fixdem") == final_state());
  const ProgramRun second = resume(out, "--duration 0.006");
  CHECK(second.exit_code == 0);
  CHECK(contains(second.standard_error, "is done already"));
  const ProgramRun shorter = resume(out, "--duration 0.005");
  CHECK(shorter.exit_code == 2);
  CHECK(contains(shorter.standard_error, "it can be made longer, not shorter"));
  CHECK(resume(out, "", "settle_mixed").exit_code == 3);
  CHECK(first.file("final.fixdem") == final_state());
}

TEST_CASE("checkpoint: when one can be written is no influence on results, nor are frames") {
  const ProgramRun bare =
      run_program("settle", "bare", "--quiet --duration 0.006 --no-frames --checkpoint-interval inf");
  CHECK(bare.file("final.fixdem") == final_state());
  CHECK(bare.file("log.csv") == read_bytes(scratch("whole") / "log.csv"));
  for (const char* interval : {"0", "-1", "nan", "1e-7", "x"})
    CHECK(run_program("settle", "bare", std::string("--checkpoint-interval ") + interval).exit_code == 2);
}

TEST_CASE("resume: a changed case is refused by the keys that have changed, with both values") {
  const ProgramRun run = crashed("changed_case");
  for (const files::path& path : checkpoints_in(run.out)) {
    std::string bytes = read_bytes(path);
    const std::string key = "[material] friction";
    const std::size_t at = bytes.find(key);
    REQUIRE(at != std::string::npos);
    std::string& value = bytes.replace(at + key.size() + 8, 3, "0.4");  // behind its length
    write_bytes(path, with_checksum(value));
  }
  const ProgramRun refused = resume(run.out);
  CHECK(refused.exit_code == 3);
  CHECK_MESSAGE(contains(refused.standard_error, "\n  [material] friction: 0.4 there, 0.3 here\n"),
                refused.standard_error);
  CHECK_FALSE(contains(refused.standard_error, "XXH64"));
}

TEST_CASE("resume: altered bytes with a checksum that fits are refused, or run on, but do not crash") {
  const ProgramRun run = crashed("hostile");
  const files::path path = checkpoints_in(run.out).front();
  const std::string good = read_bytes(path);
  Random chance(seed());
  const double end = static_cast<double>(good.size()) - 8;
  const files::path kept = run.out.string() + ".kept";
  files::remove_all(kept);
  files::copy(run.out, kept, files::copy_options::recursive);
  int refused = 0;
  for (int k = 0; k < 40; ++k) {
    const int flips = 10 << k % 4;
    std::string changed = good;
    for (int c = 0; c < flips; ++c) changed[static_cast<std::size_t>(chance(6000, end))] ^= 0x55;
    files::remove_all(run.out);
    files::copy(kept, run.out, files::copy_options::recursive);
    write_bytes(path, with_checksum(changed));
    const ProgramRun again = resume(run.out);
    CHECK_MESSAGE(again.exit_code >= 0, again.standard_error);
    CHECK_MESSAGE(again.exit_code < 128, again.standard_error);  // a shell says so of a signal
    refused += again.exit_code == 3;
  }
  CHECK(refused > 0);
}

namespace {

/// fill_500 in the background, begun in earnest.
pid_t start_long_run(const files::path& out) {
  files::remove_all(out);
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    std::signal(SIGINT, SIG_DFL);
    const int output = open((out.string() + ".stderr").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
    dup2(output, STDOUT_FILENO);
    dup2(output, STDERR_FILENO);
    execl(program("fill_500").c_str(), "fill_500", "--quiet", "--out", out.c_str(), static_cast<char*>(nullptr));
    _exit(99);
  }
  for (int k = 0; k < 6000 && !contains(read_bytes(out / "log.csv"), "\n0,"); ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  return child;
}

int end(pid_t child, int signal) {
  kill(child, signal);
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

}  // namespace

TEST_CASE("lock: a second run in the folder is refused, a lock whose owner is gone is not") {
  const auto out = scratch("shared");
  const pid_t first = start_long_run(out);
  const std::string log = read_bytes(out / "log.csv");
  const auto second = [&](const char* arguments) {
    return run_command(
        shell_word(program("fill_500")) + " --quiet --duration 1e-4 " + arguments + " --out " + shell_word(out),
        "second", out);
  };
  for (const char* arguments : {"", "--resume", "--fresh", "--replace"}) {
    const ProgramRun refused = second(arguments);
    CHECK(refused.exit_code == 6);
    CHECK_MESSAGE(contains(refused.standard_error, "in use by process " + std::to_string(first) + " on "),
                  refused.standard_error);
  }
  CHECK(contains(read_bytes(out / "log.csv"), log));
  CHECK(end(first, SIGKILL) == -SIGKILL);
  CHECK(files::exists(out / "lock"));
  CHECK(second("--replace").exit_code == 0);
  CHECK_FALSE(files::exists(out / "lock"));
  write_bytes(out / "lock", "process 1 on host of-someone-else\n");
  const ProgramRun elsewhere = second("");
  CHECK(elsewhere.exit_code == 6);
  CHECK(contains(elsewhere.standard_error, "process 1 on of-someone-else"));
  CHECK(contains(elsewhere.standard_error, "remove " + (out / "lock").string()));
}

TEST_CASE("checkpoint: a folder that vanishes, or cannot be written any more, ends the run with 6 and a message") {
  const auto out = scratch("vanishing");
  const pid_t run = start_long_run(out);
  files::remove_all(out);
  CHECK(end(run, SIGTERM) == 6);
  const std::string message = read_bytes(out.string() + ".stderr");
  CHECK_MESSAGE(contains(message, "fixdem: cannot "), message);
  CHECK(contains(message, out.string()));
  CHECK_FALSE(files::exists(out));
}

TEST_CASE("disk: a full one ends the run with 6, and the last good checkpoint stays and is named") {
  ::setenv("FIXDEM_DISK_FAULT", "full@40", 1);
  const ProgramRun run = run_program("settle", "full_disk", short_run);
  ::unsetenv("FIXDEM_DISK_FAULT");
  CHECK(run.exit_code == 6);
  CHECK(contains(run.standard_error, "No space left on device"));
  const auto checkpoints = checkpoints_in(run.out);
  REQUIRE(checkpoints.size() == 2);
  CHECK(contains(run.standard_error, "last good state: " + checkpoints[0].string()));
  for (const files::path& path : checkpoints) CHECK_NOTHROW(decode_checkpoint(read_bytes(path), path.string()));
  for (const auto& entry : files::recursive_directory_iterator(run.out))
    CHECK_FALSE(entry.path().extension() == ".part");
  CHECK(resume(run.out).exit_code == 0);
  CHECK(read_bytes(run.out / "final.fixdem") == final_state());
  ::setenv("FIXDEM_DISK_FAULT", "full@x", 1);
  CHECK(run_program("settle", "full_disk", short_run).exit_code == 2);
  ::unsetenv("FIXDEM_DISK_FAULT");
}
