// What a measured program does with one simulation: says its size, runs it, or times it.
#pragma once

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#if defined(__x86_64__)
#include <x86intrin.h>
#endif

#include "kernel/fixdem.hpp"

/// A function that is compiled once and for any arguments: gcc would make copies for some of them.
#if defined(__clang__)
#define FIXDEM_ONE_COPY __attribute__((noinline))
#else
#define FIXDEM_ONE_COPY __attribute__((noipa))
#endif

namespace fixdem::footprint {

/// Ticks of the processor's constant clock: at its nominal frequency, whatever it runs at.
inline unsigned long long ticks() {
#if defined(__x86_64__)
  return __rdtsc();
#else
  return 0;
#endif
}

/// Whole steps and nothing else: what is reachable from here is the code of the step.
template <class Simulation>
FIXDEM_ONE_COPY bool run_steps(Simulation& simulation, long long steps) {
  return simulation.run(steps).ok();
}

/// Cycles per particle-step, least of 100 short blocks; the simulation is started anew for each.
template <class Simulation, class Start>
double least_cycles(Simulation& simulation, Start start) {
  constexpr int steps = 80;  // several intervals of gas and sorting, and short enough that some blocks are undisturbed
  double least = 1e300;
  for (int block = 0; block < 100; ++block) {
    if (!start() || !run_steps(simulation, 20)) return -1;
    const auto begin = ticks();
    if (!run_steps(simulation, steps)) return -1;
    least = std::min(least, static_cast<double>(ticks() - begin) / steps / Simulation::count);
  }
  return least;
}

/// `what`: "size", "time", or a number of steps to run. Returns the exit code: 0, or 1 when the scene stops with a
/// fault.
template <class Simulation, class Start>
int measured(Simulation& simulation, Start start, const char* what) {
  if (std::strcmp(what, "size") == 0)
    std::printf("%zu %d\n", sizeof simulation, Simulation::count);
  else if (std::strcmp(what, "time") == 0)
    std::printf("%.1f\n", least_cycles(simulation, start));
  else
    return start() && run_steps(simulation, std::atoll(what)) ? 0 : 1;
  return 0;
}

}  // namespace fixdem::footprint
