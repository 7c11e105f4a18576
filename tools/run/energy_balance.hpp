// The energy ledger as one number: what is missing, relative to the largest entry.
//
//   error = (kinetic + elastic + dissipated + left with particles - entered with particles
//            - made by the tangential law - gravity work - gas work
//            - kinetic at the start - elastic at the start) / scale
//   scale = the largest magnitude among those terms
// so 1e-3 means that a thousandth of the largest energy in the game is unaccounted for. 0 when all terms are 0.
#pragma once

#include <algorithm>
#include <cmath>

#include "kernel/fixdem.hpp"

namespace fixdem::program {

inline double dissipated(const Energy& energy) {
  return energy.dissipated_damping + energy.dissipated_sliding + energy.dissipated_rolling;
}

inline double balance_error(const Energy& start, const Energy& now) {
  const double missing = now.kinetic + now.elastic + dissipated(now) + now.left_with - now.entered - now.made_by_law -
                         now.gravity_work - now.gas_work - start.kinetic - start.elastic;
  const double scale =
      std::max({std::fabs(now.kinetic), std::fabs(now.elastic), std::fabs(dissipated(now)), std::fabs(now.left_with),
                std::fabs(now.entered), std::fabs(now.made_by_law), std::fabs(now.gravity_work),
                std::fabs(now.gas_work), std::fabs(start.kinetic), std::fabs(start.elastic)});
  return scale > 0 ? missing / scale : missing;
}

}  // namespace fixdem::program
