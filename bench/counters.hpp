// What every benchmark reports beside its time.
//
// All are of processor time (core_clock.hpp). `cycles` are cycles of the core at the clock measured right after the
// run, which `core_GHz` gives. `fraction_of_bound` is the share of a step that the law alone would take for the
// contacts of this very scene (law_bound.hpp), measured right after the run as well.
#pragma once

#include <benchmark/benchmark.h>

#include "core_clock.hpp"
#include "kernel/fixdem.hpp"
#include "law_bound.hpp"

namespace fixdem::bench {

/// Contacts of which kind a benchmark works off.
enum class Contacting { none, pairs, walls, all };

/// Near lists made so far, in lists of the whole pipe: ranges are listed one by one, a sort lists all of them.
template <class Case>
double lists_made(const Simulation<Case>& simulation) {
  return static_cast<double>(simulation.sorts()) + static_cast<double>(simulation.listings()) / NearList<Case>::ranges;
}

/// Counters of a benchmark that took `seconds` for `steps` time steps of the simulation.
template <class Case>
void report(benchmark::State& state, const Simulation<Case>& simulation, double steps, double seconds,
            Contacting contacting = Contacting::all) {
  constexpr double count = Case::particle_count;
  const Observation seen = simulation.observe();
  const double pairs = seen.contacts / count, walls = seen.wall_contacts / count;
  const double contacts = (contacting == Contacting::pairs || contacting == Contacting::all ? pairs : 0) +
                          (contacting == Contacting::walls || contacting == Contacting::all ? walls : 0);
  const double clock = core_clock(), seconds_per_particle_step = seconds / steps / count;
  auto& counters = state.counters;
  counters["particle_steps_per_second"] = 1 / seconds_per_particle_step;
  counters["cycles_per_particle_step"] = clock * seconds_per_particle_step;
  if (contacts > 0) counters["cycles_per_contact"] = clock * seconds_per_particle_step / contacts;
  counters["contacts_per_particle"] = pairs + walls;
  counters["bytes_per_particle"] = sizeof(Simulation<Case>) / count;
  counters["core_GHz"] = 1e-9 * clock;
}

/// How near a scene whose contacts stay as they are comes to the arithmetic bound, which is that of equal spheres.
template <class Case>
void report_fraction_of_bound([[maybe_unused]] benchmark::State& state, [[maybe_unused]] Simulation<Case>& simulation) {
  if constexpr (!has_sizes<Case>) {
    const double bound = law_seconds_per_contact(simulation) * state.counters["contacts_per_particle"];
    if (bound > 0) state.counters["fraction_of_bound"] = bound * state.counters["particle_steps_per_second"];
  }
}

}  // namespace fixdem::bench
