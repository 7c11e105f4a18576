// What another program may change between steps: gravity, and the bulk velocity of the gas.
//
// Only in a case that says so (`is_coupled`, case.hpp); in all others both are constants, and nothing of this is there.
// Gravity is that of the frame in which the pipe rests: in a pipe that is moved, less the pipe's acceleration. The gas
// follows at its next update; the bed's height stays measured along the case's own direction (`Derived::up`, case.hpp),
// so with gas the part of gravity across the axis must keep it or vanish.
#pragma once

#include "case.hpp"

namespace fixdem {

template <class Case, bool present = is_coupled<Case>>
struct Coupling {
  double gravity[3];    ///< m/s2
  double gas_velocity;  ///< m/s
  double earlier_work;  ///< of gravity per mass of reference before it was set last, J/kg
  /// Gravity times time step as the rows of motion have it: velocity, and for rotation -0, which changes nothing.
  alignas(64) double kick[8];

  void set_gravity(const double (&g)[3]) {
    for (int c = 0; c < 3; ++c) gravity[c] = g[c];
    for (int c = 0; c < 8; ++c) kick[c] = c < 3 ? g[c] * Case::time_step : (c < 4 ? 0.0 : -0.0);
  }
  /// To what the case says.
  void reset() {
    set_gravity(Case::gravity);
    gas_velocity = Case::gas_velocity;
    earlier_work = 0;
  }
};
template <class Case>
struct Coupling<Case, false> {};

}  // namespace fixdem
