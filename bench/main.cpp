// The standard set of benchmarks: whole steps, stages, and the arithmetic bound, timed with Google Benchmark.
//
// Usage: bench FOLDER [Google Benchmark's options]. In the folder lie the final states of pipe_bed, settle and plug_u24
// (`make bench` sees to them). Names: step/<scene>/<N>/<precision>, step/<scene>/<N>/<D over d>/<precision>
// (pipes.cpp), stage/<stage>/<N>/<precision>, bound/law/<precision>.
#include <benchmark/benchmark.h>

#include <iostream>

#include "scenes.hpp"
#include "stages.hpp"
#include "timed_steps.hpp"
#include "tools/run/case_facts.hpp"

namespace fixdem::bench {
namespace {

template <class Case, class Start>
void add_steady(const std::string& scene, Start start) {
  const std::string name =
      "step/" + scene + "/" + std::to_string(Case::particle_count) + "/" + precision_name(Case::precision);
  benchmark::RegisterBenchmark(name.c_str(),
                               [name, start](benchmark::State& state) { steady_steps<Case>(state, name, start); });
}

/// A scene whose contacts change has no bound of its own.
enum class ContactsOfScene { change, stay };

template <class Case, ContactsOfScene contacts, class Start>
void add_first(const std::string& scene, long long steps, Start start) {
  const std::string name =
      "step/" + scene + "/" + std::to_string(Case::particle_count) + "/" + precision_name(Case::precision);
  benchmark::RegisterBenchmark(name.c_str(), [name, steps, start](benchmark::State& state) {
    Simulation<Case>& simulation = first_steps<Case>(state, name, steps, start);
    if (contacts == ContactsOfScene::stay) report_fraction_of_bound(state, simulation);
  });
}

/// The law alone, on contacts of the bed.
template <Precision P>
void law_bound(benchmark::State& state) {
  using Case = bed<1000, P>;
  const std::string name = "bound/law/" + precision_name(P);
  Simulation<Case>& simulation = hold<Case>(name, [](auto& made) {
    start_bed(made);
    require(made.run(1000));
  });
  using Packed = PackedContacts<Case>;
  std::vector<std::unique_ptr<Packed>> samples;
  for (int sample = 0; sample < Packed::samples; ++sample)
    samples.push_back(std::make_unique<Packed>(simulation, sample));
  constexpr int passes = 200;  // of one sample before the next takes its place in the cache
  const double begin = processor_seconds();
  for (auto _ : state)
    for (const auto& packed : samples)
      for (int k = 0; k < passes; ++k) packed->pass();
  const double seconds = processor_seconds() - begin;
  const Observation seen = simulation.observe();
  const double contacts_per_step = seen.contacts + seen.wall_contacts;
  const double contacts = static_cast<double>(state.iterations()) * Packed::samples * passes * samples[0]->count();
  report(state, simulation, contacts / contacts_per_step, seconds);
}

template <Precision P>
void register_steps() {
  const auto bed_start = [](auto& simulation) { start_bed(simulation); };
  const auto agitated_start = [](auto& simulation) { start_agitated(simulation); };
  benchmark::RegisterBenchmark(("bound/law/" + precision_name(P)).c_str(), law_bound<P>);
  add_steady<drum<P>>("bed", [](auto& simulation) { start_drum(simulation); });
  add_steady<bed<1000, P>>("bed", bed_start);
  add_steady<bed<10000, P>>("bed", bed_start);
  add_steady<bed<100000, P>>("bed", bed_start);
  add_steady<bed<1000000, P>>("bed", bed_start);
  add_steady<bed_with_ledger<P>>("bed_with_ledger", bed_start);
  add_steady<bed_rolling<P>>("bed_rolling", bed_start);
  add_steady<bed_two_sizes<P>>("bed_two_sizes", [](auto& simulation) { start_two_sizes(simulation); });
  add_first<agitated<1000, P>, ContactsOfScene::change>("agitated", 25000, agitated_start);
  add_first<agitated<1000000, P>, ContactsOfScene::change>("agitated", 240, agitated_start);
  add_first<plug<P>, ContactsOfScene::stay>("plug", 2500,
                                            [](auto& simulation) { start_stored(simulation, states.plug); });
}

void read_states(const std::string& folder) {
  const auto read = [&](const char* name) { return program::read_state(folder + "/" + name + "/final.fixdem"); };
  states = {read("pipe_bed"), read("settle"), read("plug_u24")};
}

}  // namespace
}  // namespace fixdem::bench

int main(int argc, char** argv) {
  using namespace fixdem::bench;
  if (argc < 2 || argv[1][0] == '-') {
    std::cerr << "usage: bench FOLDER [--benchmark_filter=REGEX ...]\n";
    return 2;
  }
  try {
    read_states(argv[1]);
    register_steps<fixdem::Precision::double_precision>();
    register_steps<fixdem::Precision::mixed_precision>();
    register_pipes();
    register_stages();
    argv[1] = argv[0];
    --argc;
    benchmark::AddCustomContext("compiler", fixdem::program::compiler_name());
    benchmark::AddCustomContext("instruction_set", fixdem::program::compiled_instruction_set());
    benchmark::Initialize(&argc, argv + 1);
    if (benchmark::ReportUnrecognizedArguments(argc, argv + 1)) return 2;
    benchmark::RunSpecifiedBenchmarks();
  } catch (const std::exception& error) {
    std::cerr << "bench: " << error.what() << '\n';
    return 1;
  }
}
