#include "contact_kinds.hpp"

#include <cmath>

namespace fixdem::program {
namespace {

double reduced(double a, double b) { return a * b / (a + b); }

/// `radius` and `mass` over those that the coefficients are of.
ContactCoefficients scaled(ContactCoefficients c, NormalLaw law, double radius, double mass) {
  const double stiffness = law == NormalLaw::linear ? 1 : std::sqrt(radius), damping = std::sqrt(stiffness * mass);
  c.stiffness *= stiffness, c.tangential_stiffness *= stiffness;
  c.damping *= damping, c.tangential_damping *= damping;
  return c;
}

}  // namespace

double reduced_mass(const ParticleKind& a, const ParticleKind& b) { return reduced(a.mass(), b.mass()); }

ContactCoefficients pair_coefficients(const CaseFacts& facts, const ParticleKind& a, const ParticleKind& b) {
  if (!facts.has_sizes()) return facts.pair_contact;
  return scaled(facts.pair_contact, facts.normal, reduced(a.diameter, b.diameter) / 2 / facts.pair_radius,
                reduced_mass(a, b) / facts.pair_mass);
}

ContactCoefficients wall_coefficients(const CaseFacts& facts, const ParticleKind& a) {
  if (!facts.has_sizes()) return facts.wall_contact;
  return scaled(facts.wall_contact, facts.normal, a.diameter / facts.diameter, a.mass() / facts.mass);
}

ContactCoefficients contact_coefficients(const CaseFacts& facts, int owner, int partner) {
  if (!facts.has_sizes()) return partner >= 0 ? facts.pair_contact : facts.wall_contact;
  const ParticleKind& kind = facts.kinds[owner];
  return partner >= 0 ? pair_coefficients(facts, kind, facts.kinds[partner]) : wall_coefficients(facts, kind);
}

double rolling_lever(const ParticleKinds& particles, int particle, int partner) {
  if (partner < 0) return 1;
  if (!particles.has_sizes()) return 0.5;
  const double own = particles.diameter_of(particle), other = particles.diameter_of(partner);
  return other / (own + other);
}

}  // namespace fixdem::program
