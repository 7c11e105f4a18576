// Timing whole steps, of a scene that stays as it is or of one that changes.
//
// One simulation is held at a time: Google Benchmark calls a benchmark several times, and the largest scene is over a
// gigabyte. A call of run() is long, so that the kernel may order the steps of a long pipe as it likes. What happens
// now and then, the renewal of the near list, is paid when it falls into the time of the run: `steps_per_renewal`.
#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <memory>
#include <string>

#include "counters.hpp"
#include "stored_start.hpp"

namespace fixdem::bench {

struct Held {
  std::string name;
  std::shared_ptr<void> simulation;
};
inline Held held;

/// The simulation held under this name; made anew by `start(simulation)` when it is another one so far.
template <class Case, class Start>
Simulation<Case>& hold(const std::string& name, Start start) {
  if (held.name != name) {
    held = {};
    auto made = std::make_shared<Simulation<Case>>();
    start(*made);
    held = {name, made};
  }
  return *static_cast<Simulation<Case>*>(held.simulation.get());
}

/// Counter of how long a near list lasted; nothing when it was not renewed.
template <class Case>
void report_renewals(benchmark::State& state, const Simulation<Case>& simulation, double steps, double before) {
  const double lists = lists_made(simulation) - before;
  if (lists > 0) state.counters["steps_per_renewal"] = steps / lists;
}

/// Whole steps of a scene that stays as it is: started once, then carried on.
template <class Case, class Start>
void steady_steps(benchmark::State& state, const std::string& name, Start start) {
  constexpr long long steps = std::max(240, 100000 / Case::particle_count);
  Simulation<Case>& simulation = hold<Case>(name, [&](Simulation<Case>& made) {
    start(made);
    require(made.run(16));  // warm
  });
  const double lists = lists_made(simulation);
  const double begin = processor_seconds();
  for (auto _ : state) require(simulation.run(steps));
  const double seconds = processor_seconds() - begin, done = static_cast<double>(state.iterations() * steps);
  report(state, simulation, done, seconds);
  report_renewals(state, simulation, done, lists);
  report_fraction_of_bound(state, simulation);
}

/// Whole steps of a scene that changes as it goes: every iteration is the same `steps` from the same start. Contacts
/// per particle are those at the end of them. Returns the simulation as it is then.
template <class Case, class Start>
Simulation<Case>& first_steps(benchmark::State& state, const std::string& name, long long steps, Start start) {
  Simulation<Case>& simulation = hold<Case>(name, [](auto&) {});
  double seconds = 0;
  for (auto _ : state) {
    state.PauseTiming();
    start(simulation);
    state.ResumeTiming();
    const double begin = processor_seconds();
    require(simulation.run(steps));
    seconds += processor_seconds() - begin;
  }
  report(state, simulation, static_cast<double>(state.iterations() * steps), seconds);
  report_renewals(state, simulation, static_cast<double>(steps), 1);  // start() has made the first list
  return simulation;
}

}  // namespace fixdem::bench
