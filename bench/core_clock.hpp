// Processor time, and the clock of the core in that time.
//
// Counters are in cycles of the core, not in ticks of a time-stamp counter, which runs at a rate of its own. The clock
// is measured: a chain of dependent 64-bit multiplications takes three cycles each on every x86-64 core of the last ten
// years (on other machines take cycles as relative). Processor time leaves out what other programs take from the core.
#pragma once

#include <time.h>

#include <algorithm>
#include <cstdint>

namespace fixdem::bench {

/// Processor time of this thread, s.
inline double processor_seconds() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Clock of the core in Hz, best of ten chains of a tenth of a millisecond.
inline double core_clock() {
  constexpr int links = 100000, cycles_per_link = 3;
  double best = 1e300;
  for (int trial = 0; trial < 10; ++trial) {
    std::uint64_t x = 3;
    const double begin = processor_seconds();
    for (int k = 0; k < links; ++k) {
      x *= x;
      asm volatile("" : "+r"(x));  // keeps the chain one multiplication after the other
    }
    best = std::min(best, processor_seconds() - begin);
  }
  return cycles_per_link * static_cast<double>(links) / best;
}

}  // namespace fixdem::bench
