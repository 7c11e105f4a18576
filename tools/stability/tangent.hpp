// The exact critical time step of a state: the maximum eigenvalue of its tangent stiffness and damping.
//
// Every contact is a normal and a tangential spring with a damper each at its present overlap; a particle moves by x
// and turns by theta, and the slip of a contact is the tangential part of x_i - x_j + (r_i theta_i + r_j theta_j) x n.
// Where rolling is resisted, a third spring and damper act on the rolling displacement, R* (theta_i - theta_j) x n, at
// a wall r theta x n: on the same turning as the slip. Coordinates are scaled by the roots of mass and moment of
// inertia, so the matrices are symmetric, in 1/s2 and 1/s. Sliding contacts count as sticking, and the turning of the
// normal under load (of the order of overlap / d) is left out.
//
// The critical step h of a criterion (tools/run/step_criteria.hpp) makes the maximum eigenvalue of
// h^2 K + h (a C_n + b C_t) equal to 4. With its eigenvector u the quadratic equation u^T (...) u = 4 gives the next h,
// from above and quadratically. Eigenvectors by power iteration: after k products the eigenvalue is short by a fraction
// of 1 / (5 k) at most, however near the next one lies, so 3000 leave less than 1e-4; a Lanczos library would be
// faster, but takes longer to compile than everything else here.
#pragma once

#include <vector>

#include "tools/run/stability_watch.hpp"

namespace fixdem::stability {

/// One contact with its springs; partner below zero: a wall.
struct Spring {
  int owner, partner;
  double normal[3];
  program::TangentSpring at;
};

/// Mass over that of the network, and radius (m), of a particle that is not like all others.
struct OwnSize {
  double mass_share, radius;
};

/// The springs of so many particles of that mass (kg), or of their own.
struct SpringNetwork {
  int particle_count;
  double mass;
  std::vector<Spring> springs;
  std::vector<OwnSize> sizes = {};  ///< of each particle; empty where all are equal

  double mass_share(int particle) const {
    return sizes.empty() ? 1 : sizes[static_cast<std::size_t>(particle)].mass_share;
  }
  /// R* / r of a particle against its partner.
  double rolling_lever(int particle, int partner) const;
};

SpringNetwork network_of(const program::CaseFacts&, const std::vector<Contact>&);
/// One of its springs with the particles it holds, and nothing else.
SpringNetwork alone(const SpringNetwork&, const Spring&);

/// s; infinite without contacts.
double critical_step(const SpringNetwork&, const program::StepCriterion&);

/// Which springs to take: all, or normal ones only (no rotation), which is one of the rules of thumb.
enum class Springs { all, normal };
/// Without any damping: 2 / maximum angular frequency.
double undamped_critical_step(const SpringNetwork&, Springs);

}  // namespace fixdem::stability
