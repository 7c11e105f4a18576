// The case with values that may be changed while a program runs, for the reference program (tests/reference).
//
// The kernel is compiled for one time step; a bisection needs many. The reference is written so that the values of a
// case may be variables: they hide the constants of the generated header. A Reference takes them when it is made.
#pragma once

#include FIXDEM_CASE_HEADER

#include "tests/reference/reference.hpp"
#include "tools/run/case_facts.hpp"

namespace fixdem::stability {

using Case = cases::FIXDEM_CASE;

struct VariableCase : Case {
  static inline int particle_count = Case::particle_count;
  static inline double diameter = Case::diameter, density = Case::density;
  static inline double youngs_modulus = Case::youngs_modulus, poisson_ratio = Case::poisson_ratio;
  static inline double wall_youngs_modulus = Case::wall_youngs_modulus, wall_poisson_ratio = Case::wall_poisson_ratio;
  static inline double restitution = Case::restitution, friction = Case::friction;
  static inline double wall_restitution = Derived<Case>::wall_restitution, wall_friction = Derived<Case>::wall_friction;
  static inline double rolling_friction = Derived<Case>::rolling_friction;
  static inline double wall_rolling_friction = Derived<Case>::wall_rolling_friction;
  static inline double time_step = Case::time_step;
  static inline double gravity[3] = {Case::gravity[0], Case::gravity[1], Case::gravity[2]};
  static inline Integrator integrator = Case::integrator;
  static inline TangentialLaw tangential = Case::tangential;
  static inline bool has_gas = Case::has_gas;

  /// Back to the constants of the header.
  static void reset() {
    particle_count = Case::particle_count;
    diameter = Case::diameter, density = Case::density;
    youngs_modulus = Case::youngs_modulus, poisson_ratio = Case::poisson_ratio;
    wall_youngs_modulus = Case::wall_youngs_modulus, wall_poisson_ratio = Case::wall_poisson_ratio;
    restitution = Case::restitution, friction = Case::friction;
    wall_restitution = Derived<Case>::wall_restitution, wall_friction = Derived<Case>::wall_friction;
    rolling_friction = Derived<Case>::rolling_friction;
    wall_rolling_friction = Derived<Case>::wall_rolling_friction;
    time_step = Case::time_step;
    for (int c = 0; c < 3; ++c) gravity[c] = Case::gravity[c];
    integrator = Case::integrator, tangential = Case::tangential, has_gas = Case::has_gas;
  }
};

using Reference = reference::Reference<VariableCase>;

/// Coefficients at the present values.
inline program::ContactCoefficients coefficients_of(bool is_pair) {
  const auto c = is_pair ? reference::pair_coefficients<VariableCase, double>()
                         : reference::wall_coefficients<VariableCase, double>();
  return {c.normal_stiffness, c.tangential_stiffness,
          c.normal_damping,   c.tangential_damping,
          c.friction,         is_pair ? VariableCase::restitution : VariableCase::wall_restitution,
          c.rolling_friction};
}

}  // namespace fixdem::stability
