// Hostile inputs, replayed: every file of tests/corpus/ goes through its fuzz target (tests/fuzz/targets.hpp) and must
// be refused in words or accepted, as ever. An input that once did harm is kept there under the name of the harm.
#include <doctest/doctest.h>

#include <filesystem>

#include "fuzz/targets.hpp"
#include "program_run.hpp"

namespace {

void replay(const char* folder, std::string (*target)(std::string_view)) {
  int files = 0;
  for (const auto& file : std::filesystem::directory_iterator(std::filesystem::path(FIXDEM_CORPUS) / folder)) {
    const std::string complaint = target(fixdem::tests::read_bytes(file.path()));
    CHECK_MESSAGE(complaint.empty(), file.path().string(), ": ", complaint);
    ++files;
  }
  CHECK(files > 0);
}

}  // namespace

TEST_CASE("corpus: case files") { replay("case", fixdem::tests::fuzz_case); }
TEST_CASE("corpus: state files") { replay("state", fixdem::tests::fuzz_state); }
TEST_CASE("corpus: checkpoints") { replay("checkpoint", fixdem::tests::fuzz_checkpoint); }
TEST_CASE("corpus: states of particles") { replay("particles", fixdem::tests::fuzz_particles); }
