// What every benchmark reports beside its time.
//
// Rates are of the loop alone. Cycles are those of the time-stamp counter's clock, which need not be the core's:
// compare them within one run only.
#pragma once

#include <benchmark/benchmark.h>

#include "kernel/fixdem.hpp"

#if defined(__x86_64__)
#include <x86intrin.h>
#endif

namespace fixdem::bench {

inline double clock_cycles() {
#if defined(__x86_64__)
  return static_cast<double>(__rdtsc());
#else
  return 0;
#endif
}

/// Counters of `steps` steps per iteration of a simulation with this number of contacts (pairs and walls).
template <class Simulation>
void report(benchmark::State& state, const Simulation& simulation, double steps_per_iteration, double cycles) {
  const double particle_steps = static_cast<double>(state.iterations()) * steps_per_iteration * Simulation::count;
  const Observation seen = simulation.observe();
  const double contacts = static_cast<double>(seen.contacts + seen.wall_contacts) / Simulation::count;
  state.counters["particle_steps_per_second"] = benchmark::Counter(particle_steps, benchmark::Counter::kIsRate);
  state.counters["cycles_per_particle_step"] = cycles / particle_steps;
  if (contacts > 0) state.counters["cycles_per_contact"] = cycles / particle_steps / contacts;
  state.counters["contacts_per_particle"] = contacts;
  state.counters["bytes_per_particle"] = static_cast<double>(sizeof(Simulation)) / Simulation::count;
}

}  // namespace fixdem::bench
