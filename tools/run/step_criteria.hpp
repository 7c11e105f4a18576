// The stability criterion of each integrator: up to which time step small motions about a state do not grow.
//
// About a state with the stiffness matrix K and the damping matrices C_n (normal) and C_t (tangential), all scaled by
// the masses, one step of h maps a motion z^k u onto itself when a polynomial in z vanishes; stability is lost through
// z = -1, a motion that changes sign at every step. There the polynomial is
//
//   euler      4 u = (h^2 K + 2 h (C_n + C_t)) u         forces at the new place and the new velocity
//   leapfrog   4 u = (h^2 K + 4 h C_n + 2 h C_t) u       damped normal velocity predicted from the two last ones
//   impulse    4 u = (h^2 K + 4 h C_n + 4 h C_t) u       G taken half a step on, slip extrapolated; on the safe side:
//                                                        the means along the half steps soften K, and `after` C_n
//
// Dashpots of rolling take the rate of the step, with C_t: for euler and leapfrog that is what they do, and with
// impulse 2 h would do, so that 4 h is on the safe side. So h is stable while the maximum eigenvalue of the matrix on
// the right is below 4. Without damping all are 2 / (maximum angular frequency). A new integrator is one more row.
#pragma once

#include "kernel/case.hpp"

namespace fixdem::program {

struct StepCriterion {
  Integrator integrator;
  const char* name;
  double normal_damping, tangential_damping;  ///< factors of h C_n and h C_t
  bool is_exact;                              ///< where not, the true limit is greater
};

inline constexpr StepCriterion step_criteria[] = {
    {Integrator::euler, "euler", 2, 2, true},
    {Integrator::leapfrog, "leapfrog", 4, 2, true},
    {Integrator::impulse, "impulse", 4, 4, false},
};

constexpr const StepCriterion& criterion_of(Integrator integrator) {
  for (const StepCriterion& criterion : step_criteria)
    if (criterion.integrator == integrator) return criterion;
  return step_criteria[0];
}

}  // namespace fixdem::program
