// Whole time steps and their stages, timed with Google Benchmark.
//
// Usage: bench BED_STATE PLUG_STATE [Google Benchmark's options]. The two files are the final states of pipe_bed and
// plug_u24; `make bench` sees to them. Names: step/<scene>/<N>/<precision>, stage/<stage>/<N>/<precision>.
#include <benchmark/benchmark.h>

#include <iostream>
#include <memory>
#include <string>

#include "counters.hpp"
#include "scenes.hpp"

namespace fixdem::bench {
namespace {

program::StoredState bed_state, plug_state;

/// Whole steps, about 1e5 particle-steps an iteration, of a scene that stays as it is: started once, then carried on.
template <class Case, class Start>
void steady_steps(benchmark::State& state, Start start) {
  static const auto simulation = std::make_unique<Simulation<Case>>();
  if (simulation->step() == 0) start(*simulation);
  constexpr long long steps = Case::particle_count < 100000 ? 100000 / Case::particle_count : 1;
  require(simulation->run(steps));  // warm
  const double begin = clock_cycles();
  for (auto _ : state) require(simulation->run(steps));
  report(state, *simulation, static_cast<double>(steps), clock_cycles() - begin);
}

/// Whole steps of a scene that changes as it goes: every iteration is the same stretch from the same start.
template <class Case, class Start>
void first_steps(benchmark::State& state, Start start) {
  static const auto simulation = std::make_unique<Simulation<Case>>();
  constexpr long long steps = 2500;
  double cycles = 0;
  for (auto _ : state) {
    state.PauseTiming();
    start(*simulation);
    state.ResumeTiming();
    const double begin = clock_cycles();
    require(simulation->run(steps));
    cycles += clock_cycles() - begin;
  }
  report(state, *simulation, static_cast<double>(steps), cycles);
}

constexpr int W = native_lanes;
using Bed = bed<1000>;
using Cap = Capacity<Bed>;

/// One stage of a step, called for the whole pipe on a settled bed of its own.
template <void (*stage)(State<Bed>&)>
void one_stage(benchmark::State& state) {
  static const auto simulation = [] {
    auto made = std::make_unique<Simulation<Bed>>();
    start_bed(*made, bed_state);
    require(made->run(1000));
    return made;
  }();
  const double begin = clock_cycles();
  for (auto _ : state) {
    stage(simulation->state());
    benchmark::ClobberMemory();
  }
  report(state, *simulation, 1, clock_cycles() - begin);
}

void pair_stage(State<Bed>& s) {
  for (int range = 0; range < PairBatches<Bed>::ranges; ++range)
    pair_contacts<Bed, W>(s.contacts.pairs, s.particles, range, s.contacts.rows[0], s.watch[range]);
}

void wall_stage(State<Bed>& s) {
  for (int chunk = 0; chunk < Cap::chunks; ++chunk)
    wall_contacts<Bed, W, PipeSurface<Bed>>(s.contacts.pipe, s.particles, chunk, s.contacts.rows[0], s.watch[chunk]);
}

/// The force rows are what the last two chunks left, so the particles drift; the time does not depend on values.
void motion_stage(State<Bed>& s) {
  for (int chunk = 0; chunk < Cap::chunks; ++chunk)
    move<Bed, W>(s.contacts, s.particles, chunk, s.contacts.rows[0], s.watch[chunk]);
}

void near_list_stage(State<Bed>& s) {
  for (int range = 0; range < PairBatches<Bed>::ranges; ++range)
    require(list_again<Bed, W>(s.contacts, s.near_list, s.particles, s.scratch, range));
  for (int chunk = 0; chunk < Cap::chunks; ++chunk)
    require(list_slots(s.contacts, s.near_list, s.particles, s.scratch, chunk));
}

template <int N>
void register_bed() {
  benchmark::RegisterBenchmark(("step/bed/" + std::to_string(N) + "/double").c_str(), [](benchmark::State& state) {
    steady_steps<bed<N>>(state, [](auto& simulation) { start_bed(simulation, bed_state); });
  });
}

void register_all() {
  register_bed<1000>();
  register_bed<10000>();
  register_bed<100000>();
  benchmark::RegisterBenchmark("step/bed_with_ledger/1000/double", [](benchmark::State& state) {
    steady_steps<bed_with_ledger>(state, [](auto& simulation) { start_bed(simulation, bed_state); });
  });
  benchmark::RegisterBenchmark("step/agitated/1000/double", [](benchmark::State& state) {
    first_steps<agitated>(state, [](auto& simulation) { start_agitated(simulation); });
  });
  benchmark::RegisterBenchmark("step/plug/1000/double", [](benchmark::State& state) {
    first_steps<plug>(state, [](auto& simulation) { start_plug(simulation, plug_state); });
  });
  benchmark::RegisterBenchmark("stage/pair/1000/double", one_stage<pair_stage>);
  benchmark::RegisterBenchmark("stage/wall/1000/double", one_stage<wall_stage>);
  benchmark::RegisterBenchmark("stage/motion/1000/double", one_stage<motion_stage>);
  benchmark::RegisterBenchmark("stage/near_list/1000/double", one_stage<near_list_stage>);
}

}  // namespace
}  // namespace fixdem::bench

int main(int argc, char** argv) {
  if (argc < 3) {
    std::cerr << "usage: bench BED_STATE PLUG_STATE [--benchmark_filter=REGEX ...]\n";
    return 2;
  }
  try {
    fixdem::bench::bed_state = fixdem::program::read_state(argv[1]);
    fixdem::bench::plug_state = fixdem::program::read_state(argv[2]);
    fixdem::bench::register_all();
    argv[2] = argv[0];
    argc -= 2;
    benchmark::Initialize(&argc, argv + 2);
    benchmark::RunSpecifiedBenchmarks();
  } catch (const std::exception& error) {
    std::cerr << "bench: " << error.what() << '\n';
    return 1;
  }
}
