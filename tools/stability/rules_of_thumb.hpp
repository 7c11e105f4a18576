// The usual rules for a time step, to be compared with the true limit.
//
// Those that need a contact take the deepest of the state. SI units.
//   Rayleigh time          pi r sqrt(rho/G) / (0.1631 nu + 0.8766), and a fifth of it
//   Hertz contact time     of an impact at the maximum speed, and a twentieth of it
//   Cundall and Strack     2 sqrt(m / k_n), k_n = (3/2) K overlap^(1/2)
//   eq. (39) of the paper  2 sqrt(m / k), the one-dimensional oscillator; k = K overlap^(1/2), force over overlap
//   stiffest contact       two particles and all springs of the deepest contact between them
#pragma once

#include <string>
#include <vector>

#include "tangent.hpp"

namespace fixdem::stability {

struct Rule {
  std::string name;
  double seconds;
};

std::vector<Rule> rules_of_thumb(const program::CaseFacts&, double youngs_modulus, double poisson_ratio,
                                 const std::vector<Contact>&, double speed);

}  // namespace fixdem::stability
