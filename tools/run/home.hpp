// Where the simulation of a program lives: in static storage, or, when it is large, in pages of its own.
//
// Compilers address static objects by 32 bits (on x86-64 and, nearly so, on aarch64), so a program whose objects reach
// beyond 2 GB does not link. Anonymous pages have no such limit. Both begin as zeros and take real memory only where
// they are written, and what lies there is the same to the last byte.
#pragma once

#include <fmt/format.h>
#include <sys/mman.h>

#include <cstdio>
#include <cstdlib>
#include <new>

#include "failure.hpp"

namespace fixdem::program {

inline constexpr unsigned long long largest_static = 1ULL << 30;  // bytes; leaves room for all else in the 2 GB

template <class Simulation, bool is_large = (sizeof(Simulation) > largest_static)>
class Home {
 public:
  Simulation& simulation() { return simulation_; }

 private:
  Simulation simulation_;
};

template <class Simulation>
class Home<Simulation, true> {
 public:
  Simulation& simulation() {
    if (simulation_ == nullptr) {
      void* pages = mmap(nullptr, sizeof(Simulation), PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
      if (pages == MAP_FAILED) {
        fmt::print(stderr,
                   "fixdem: this case needs {:.1f} GB of memory for its simulation, and the system does not give them\n"
                   "  lower [particles] count or [capacity] neighbours, or take a machine with more memory\n",
                   1e-9 * static_cast<double>(sizeof(Simulation)));
        std::exit(exit_input_output);
      }
      simulation_ = ::new (pages) Simulation;
    }
    return *simulation_;
  }

 private:
  Simulation* simulation_ = nullptr;
};

}  // namespace fixdem::program
