// Springs and dampers of a single contact, from the sizes of the two that touch.
//
// A case says its coefficients once (CaseFacts): of two equal particles, or with several sizes of a contact whose
// reduced radius R* and mass M are those of the sphere of reference. Hertz' stiffnesses go with R*^(1/2), those of the
// linear law are constant, and dampers go with the root of M times the stiffness.
//   1/R* = 1/r_i + 1/r_j, 1/M = 1/m_i + 1/m_j; at a wall r_i and m_i
#pragma once

#include "case_facts.hpp"

namespace fixdem::program {

/// Coefficients of the contact of two particles, or with partner < 0 of one with a wall; by the numbers of their kinds.
ContactCoefficients contact_coefficients(const CaseFacts&, int owner, int partner);
/// The same of particles of these kinds.
ContactCoefficients pair_coefficients(const CaseFacts&, const ParticleKind&, const ParticleKind&);
ContactCoefficients wall_coefficients(const CaseFacts&, const ParticleKind&);

/// M, kg.
double reduced_mass(const ParticleKind&, const ParticleKind&);

/// R* / r of a particle that touches the partner: the lever of the rolling displacement; by kinds, too.
double rolling_lever(const ParticleKinds&, int particle, int partner);

}  // namespace fixdem::program
