#include "contacts_vtp.hpp"

#include <cmath>
#include <cstdint>

#include "contact_kinds.hpp"
#include "contact_motion.hpp"
#include "stability_watch.hpp"

namespace fixdem::program {
namespace {

constexpr double at_limit = 1 - 1e-6;  // of the limit of friction; histories may be floats

double dot(const double* a, const double* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

}  // namespace

void force_on_partner(const Contact& c, double (&force)[3]) {
  for (int k = 0; k < 3; ++k) force[k] = c.normal_force * c.normal[k] - c.tangential_force[k];
}

ContactLoss contact_loss(const CaseFacts& facts, const Snapshot& snapshot, const Contact& c) {
  const bool is_pair = c.partner >= 0;
  const int kind = snapshot.kind(c.owner), partner_kind = is_pair ? snapshot.kind(c.partner) : c.partner;
  const double radius = facts.radius_of(kind);
  const ContactMotion motion =
      contact_motion(snapshot.particles[static_cast<std::size_t>(c.owner)], radius,
                     is_pair ? &snapshot.particles[static_cast<std::size_t>(c.partner)] : nullptr,
                     is_pair ? facts.radius_of(partner_kind) : radius, c.normal);
  const ContactCoefficients coefficients = contact_coefficients(facts, kind, partner_kind);
  const TangentSpring spring = tangent_spring(facts.normal, coefficients, c.overlap);
  const double elastic = spring.stiffness * c.overlap / (facts.normal == NormalLaw::linear ? 1 : 1.5);
  const double limit =
      coefficients.friction * (facts.friction_limit == FrictionLimit::elastic ? elastic : c.normal_force);
  const double tangential = std::sqrt(dot(c.tangential_force, c.tangential_force));
  const double approach = dot(motion.velocity, c.normal);
  ContactLoss loss{coefficients.friction > 0 && tangential >= at_limit * limit, spring.damping * approach * approach};
  loss.power += loss.is_sliding ? -dot(c.tangential_force, motion.slip)
                                : spring.tangential_damping * dot(motion.slip, motion.slip);
  return loss;
}

std::string encode_contacts(const Snapshot& snapshot, const CaseFacts& facts, VtpData how) {
  std::vector<double> points, normal, tangential, force, dissipation;
  std::vector<std::int64_t> owner, partner, connectivity, offsets;
  std::vector<std::int32_t> sliding;
  for (const Contact& c : snapshot.contacts) {
    const double* centre = snapshot.particles[static_cast<std::size_t>(c.owner)].position;
    double length = facts.radius_of(snapshot.kind(c.owner)) - c.overlap;
    if (c.partner >= 0) length += facts.radius_of(snapshot.kind(c.partner));
    points.insert(points.end(), centre, centre + 3);
    for (int k = 0; k < 3; ++k) points.push_back(centre[k] + length * c.normal[k]);
    for (int end = 0; end < 2; ++end) connectivity.push_back(static_cast<std::int64_t>(connectivity.size()));
    offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
    owner.push_back(snapshot.serial(c.owner));
    partner.push_back(c.partner >= 0 ? snapshot.serial(c.partner) : c.partner);
    normal.push_back(c.normal_force);
    tangential.push_back(std::sqrt(dot(c.tangential_force, c.tangential_force)));
    double on_partner[3];
    force_on_partner(c, on_partner);
    force.insert(force.end(), on_partner, on_partner + 3);
    const ContactLoss loss = contact_loss(facts, snapshot, c);
    sliding.push_back(loss.is_sliding ? 1 : 0);
    dissipation.push_back(loss.power);
  }
  VtpArrays data(how);
  std::string xml = "      <Points>\n";
  xml += data.array("Points", "Float64", 3, points);
  xml += "      </Points>\n      <CellData Scalars=\"normal_force\" Vectors=\"force\">\n";
  xml += data.array("owner", "Int64", 1, owner);
  xml += data.array("partner", "Int64", 1, partner);
  xml += data.array("normal_force", "Float64", 1, normal);
  xml += data.array("tangential_force", "Float64", 1, tangential);
  xml += data.array("force", "Float64", 3, force);
  xml += data.array("sliding", "Int32", 1, sliding);
  xml += data.array("dissipation", "Float64", 1, dissipation);
  xml += "      </CellData>\n      <Lines>\n";
  xml += data.array("connectivity", "Int64", 1, connectivity);
  xml += data.array("offsets", "Int64", 1, offsets);
  xml += "      </Lines>\n";
  return data.file(snapshot, 2 * owner.size(), 0, owner.size(), xml);
}

}  // namespace fixdem::program
