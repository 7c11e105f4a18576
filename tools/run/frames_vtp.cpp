#include "frames_vtp.hpp"

#include <cstdint>
#include <numeric>

namespace fixdem::program {
namespace {

bool densities_differ(const ParticleKinds& kinds) {
  for (int kind = 0; kind < kinds.kind_count; ++kind)
    if (kinds.density_of(kind) != kinds.density) return true;
  return false;
}

using Triple = double[3];

std::vector<double> flat(const Snapshot& snapshot, const std::vector<int>& chosen,
                         const Triple& (*of)(const Particle&)) {
  std::vector<double> values;
  values.reserve(chosen.size() * 3);
  for (const int id : chosen) {
    const Particle& p = snapshot.particles[static_cast<std::size_t>(id)];
    values.insert(values.end(), of(p), of(p) + 3);
  }
  return values;
}

}  // namespace

std::string encode_vtp(const Snapshot& snapshot, const ParticleKinds& kinds, VtpData how) {
  std::vector<int> all(snapshot.particles.size());
  std::iota(all.begin(), all.end(), 0);
  return encode_vtp(snapshot, kinds, how, all);
}

std::string encode_vtp(const Snapshot& snapshot, const ParticleKinds& kinds, VtpData how,
                       const std::vector<int>& chosen) {
  const std::size_t n = chosen.size();
  std::vector<std::int32_t> id(n), contacts(n), species(n);
  std::vector<double> radius(n), density(n);
  std::vector<std::int64_t> serial(n), connectivity(n), offsets(n);
  const std::vector<int> contact_counts = contacts_per_particle(snapshot);
  for (std::size_t i = 0; i < n; ++i) {
    const int kind = snapshot.kind(chosen[i]);
    id[i] = chosen[i], serial[i] = snapshot.serial(chosen[i]);
    radius[i] = kinds.radius_of(kind), density[i] = kinds.density_of(kind), species[i] = kinds.species_of(kind);
    contacts[i] = contact_counts[static_cast<std::size_t>(chosen[i])];
    connectivity[i] = static_cast<std::int64_t>(i);
    offsets[i] = static_cast<std::int64_t>(i) + 1;
  }
  VtpArrays data(how);
  const std::string gas = snapshot.pressure_gradients.empty()
                              ? std::string()
                              : data.field("pressure_gradient", "Float64", snapshot.pressure_gradients);
  std::string xml = "      <Points>\n";
  xml += data.array("Points", "Float64", 3,
                    flat(snapshot, chosen, [](const Particle& p) -> const Triple& { return p.position; }));
  xml += "      </Points>\n      <PointData Vectors=\"velocity\">\n";
  xml += data.array("velocity", "Float64", 3,
                    flat(snapshot, chosen, [](const Particle& p) -> const Triple& { return p.velocity; }));
  xml += data.array("angular_velocity", "Float64", 3,
                    flat(snapshot, chosen, [](const Particle& p) -> const Triple& { return p.angular_velocity; }));
  xml += data.array("radius", "Float64", 1, radius);
  xml += data.array("contacts", "Int32", 1, contacts);
  xml += data.array("id", "Int32", 1, id);
  if (snapshot.is_of_line) xml += data.array("serial", "Int64", 1, serial);
  // By all particles and not the chosen ones, so that all files of a run have the same arrays.
  if (densities_differ(kinds)) xml += data.array("density", "Float64", 1, density);
  if (kinds.has_species()) xml += data.array("species", "Int32", 1, species);
  xml += "      </PointData>\n      <Verts>\n";
  xml += data.array("connectivity", "Int64", 1, connectivity);
  xml += data.array("offsets", "Int64", 1, offsets);
  xml += "      </Verts>\n";
  return data.file(snapshot, n, n, 0, xml, gas);
}

}  // namespace fixdem::program
