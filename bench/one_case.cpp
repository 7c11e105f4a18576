// Whole steps of one case, compiled as its program is: step/case/<name>/<precision>.
//
// Usage: bench final STATE | start [STATE] [Google Benchmark's options]. `final`: from the case's own final state;
// `start`: from its start, STATE being the final state of the case it starts from, if it starts from one. Compiled for
// each case like tools/run/main.cpp. Every iteration is the same stretch of steps from the same start.
#include FIXDEM_CASE_HEADER

#include <benchmark/benchmark.h>

#include <iostream>
#include <string>

#include "timed_steps.hpp"
#include "tools/run/case_adapter.hpp"
#include "tools/run/failure.hpp"
#include "tools/run/options.hpp"
#include "tools/run/snapshot.hpp"
#include "tools/run/start.hpp"

namespace {

using namespace fixdem;
using Case = cases::FIXDEM_CASE;

program::StoredState final_state(const std::string& path) {
  program::StoredState state = program::read_state(path);
  if (state.case_name != Case::name || state.source_hash != Case::source_hash)
    throw program::Failure(program::exit_bad_input, path + " is not the final state of " + Case::source +
                                                        " as it is now\n  run it again (make run CASE=" + Case::source +
                                                        "), or remove the file to time the case from its start");
  return state;
}

/// The start of the case as its program makes it, read off a simulation.
program::StoredState start_state(const char* predecessor) {
  const auto simulation = std::make_unique<Simulation<Case>>();
  program::CaseAdapter<Case> view(*simulation);
  const program::CaseFacts facts = program::case_facts<Case>();
  program::Options options;
  options.seed = Case::seed;
  if (predecessor != nullptr) options.start_state = predecessor;
  program::start_simulation(view, facts, options);
  return program::stored_state(facts, program::take_snapshot(view, Case::particle_count), false, 0);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string from = argc > 1 ? argv[1] : "";
  const bool has_state = argc > 2 && argv[2][0] != '-';
  if ((from != "final" && from != "start") || (from == "final" && !has_state)) {
    std::cerr << "usage: bench final STATE | start [STATE] [--benchmark_filter=REGEX ...]\n";
    return program::exit_wrong_usage;
  }
  try {
    const bool is_final = from == "final";
    const program::StoredState stored = is_final ? final_state(argv[2]) : start_state(has_state ? argv[2] : nullptr);
    std::cerr << Case::name << ": timed from " << (is_final ? "its final state" : "its start") << '\n';

    constexpr long long steps = std::max(240, std::min(2500, 2500000 / Case::particle_count));
    const std::string name = std::string("step/case/") + Case::name + "/" + bench::precision_name(Case::precision);
    benchmark::RegisterBenchmark(name.c_str(), [&](benchmark::State& state) {
      auto& simulation =
          bench::first_steps<Case>(state, name, steps, [&](auto& made) { bench::start_stored(made, stored); });
      if (is_final) bench::report_fraction_of_bound(state, simulation);
    });
    const int used = has_state ? 2 : 1;
    argv[used] = argv[0];
    argc -= used;
    benchmark::Initialize(&argc, argv + used);
    if (benchmark::ReportUnrecognizedArguments(argc, argv + used)) return program::exit_wrong_usage;
    benchmark::RunSpecifiedBenchmarks();
  } catch (const program::Failure& failure) {
    std::cerr << "bench: " << failure.what() << '\n';
    return failure.code();
  } catch (const std::exception& error) {
    std::cerr << "bench: " << error.what() << '\n';
    return 1;
  }
}
