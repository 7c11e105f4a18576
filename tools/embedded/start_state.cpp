// Writes the start state of a case as a header of constants, for programs that have no files and no library to make it
// with: exactly what the case's own program would place.
//
// Usage: start_state [STATE_FILE]     STATE_FILE: the final state that the case starts from, if it does.
// Exit codes: those of the program (tools/run/failure.hpp).
#include FIXDEM_CASE_HEADER

#include <fmt/format.h>

#include <cstdio>

#include "tools/run/case_facts.hpp"
#include "tools/run/failure.hpp"
#include "tools/run/no_simulation.hpp"
#include "tools/run/start.hpp"

namespace {

using namespace fixdem;

std::string triple(const double (&v)[3]) { return fmt::format("{{{:a}, {:a}, {:a}}}", v[0], v[1], v[2]); }

/// Takes down what is placed and restored; nothing is ever run.
class Recorder final : public program::NoSimulation {
 public:
  void place(int, const Particle& p) override {
    particles +=
        fmt::format("    {{{}, {}, {}}},\n", triple(p.position), triple(p.velocity), triple(p.angular_velocity));
  }
  void restore_history(int owner, int partner, const double (&history)[3], const double (&rolling)[3]) override {
    histories += fmt::format("    {{{}, {}, {}, {}}},\n", owner, partner, triple(history), triple(rolling));
    ++history_count;
  }
  /// C++ knows no array without entries.
  std::string placed() const { return particles.empty() ? "    {},\n" : particles; }

  std::string particles, histories;
  int history_count = 0;
};

}  // namespace

int main(int argc, char** argv) try {
  constexpr program::CaseFacts facts = program::case_facts<cases::FIXDEM_CASE>();
  program::Options options;
  options.seed = facts.seed;
  options.quiet = true;
  if (argc > 1) options.start_state = argv[1];
  Recorder recorder;
  program::start_simulation(recorder, facts, options);
  fmt::print(
      "// The start state of {}; generated, do not edit.\n#pragma once\n\n#include \"kernel/particles.hpp\"\n\n"
      "namespace fixdem::embedded {{\n\ninline constexpr Particle start[] = {{\n{}}};\n\n"
      "struct History {{\n  int owner, partner;\n  double value[3], rolling[3];\n}};\n"
      "inline constexpr int history_count = {};\ninline constexpr History histories[] = {{\n{}}};\n\n"
      "}}  // namespace fixdem::embedded\n",
      facts.name, recorder.placed(), recorder.history_count,
      recorder.history_count > 0 ? recorder.histories : "    {0, 0, {0, 0, 0}, {0, 0, 0}}\n");
  return 0;
} catch (const program::Failure& failure) {
  fmt::print(stderr, "start_state: {}\n", failure.what());
  return failure.code();
}
