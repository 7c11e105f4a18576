// What every test needs: the scene to name when a check fails, random numbers, and running either program.
//
// A `solver` is fixdem::Simulation<Case> or fixdem::reference::Reference<Case>: both are placed, started, run and
// looked at by the same names, so a scene is written once.
#pragma once

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <type_traits>

#include "kernel/case.hpp"

// gcc 12 merges identical functions of different simulations and then warns of the size of the other one.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Warray-bounds"
#endif
// Numbers of particles are int, here as in the kernel; clang counts their use as an index to -Wconversion.
#if defined(__clang__)
#pragma clang diagnostic ignored "-Wsign-conversion"
#endif

namespace fixdem::tests {

/// Named in a failure's report.
struct Scene {
  const char* case_name;
  unsigned long long seed;
};

/// Seed of the random scenes: FIXDEM_SEED, 1 without it.
unsigned long long seed();

void enter(Scene scene);

/// SplitMix64: small, seeded by any number, the same everywhere.
class Random {
 public:
  explicit Random(std::uint64_t state) : state_(state) {}

  /// Uniform in [low, high).
  double operator()(double low, double high) {
    state_ += 0x9e3779b97f4a7c15ULL;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    z ^= z >> 31;
    return low + (high - low) * static_cast<double>(z >> 11) * 0x1p-53;
  }

 private:
  std::uint64_t state_;
};

/// Starts a solver; the kernel must accept the start.
template <class Solver>
void start(Solver& solver) {
  if constexpr (std::is_void_v<decltype(solver.start())>) {
    solver.start();
  } else {
    const auto status = solver.start();
    REQUIRE_MESSAGE(status.ok(), std::string(describe(status.fault)), ": particle ", status.particle, ", value ",
                    status.value);
  }
}

/// Runs a solver; the kernel must not stop.
template <class Solver>
void run(Solver& solver, long long steps) {
  if constexpr (std::is_void_v<decltype(solver.run(steps))>) {
    solver.run(steps);
  } else {
    const auto status = solver.run(steps);
    REQUIRE_MESSAGE(status.ok(), std::string(describe(status.fault)), ": particle ", status.particle, ", value ",
                    status.value, " at step ", status.step);
  }
}

inline double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline double length(const double a[3]) { return std::sqrt(dot(a, a)); }

/// The difference of two places along a pipe, to the nearest image when it is periodic.
template <class Case>
double axial_difference(double a, double b) {
  const double dz = a - b;
  return Case::ends == Ends::periodic ? dz - Case::pipe_length * std::round(dz / Case::pipe_length) : dz;
}

}  // namespace fixdem::tests
