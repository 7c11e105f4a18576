#include "line_slices.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>

#include "contacts_vtp.hpp"

namespace fixdem::program {
namespace {

/// Name, unit and value in a slice of each quantity, in the order of the file.
struct Quantity {
  const char *name, *unit;
  double (*value)(const LineSlices&, std::size_t);
};
constexpr Quantity quantities[] = {
    {"solids_fraction", "", [](const LineSlices& s, std::size_t k) { return s.profile.solids_fraction[k]; }},
    {"pressure", "Pa above the outlet",
     [](const LineSlices& s, std::size_t k) { return (s.node_pressure[k] + s.node_pressure[k + 1]) / 2; }},
    {"gas_velocity", "m/s", [](const LineSlices& s, std::size_t k) { return s.gas_velocity[k]; }},
    {"particle_velocity", "m/s",  // not a number where nothing is
     [](const LineSlices& s, std::size_t k) { return s.profile.axial_momentum[k] / s.profile.particles[k]; }},
    {"number", "", [](const LineSlices& s, std::size_t k) { return s.number[k]; }},
    {"wall_force", "N", [](const LineSlices& s, std::size_t k) { return s.wall_force[k]; }},
    {"wall_shear", "N", [](const LineSlices& s, std::size_t k) { return s.wall_shear[k]; }},
};

}  // namespace

int LineSlices::slice_of(double z) const {
  const double last = static_cast<double>(number.size()) - 0.5;
  return static_cast<int>(std::clamp(z / profile.slice_length, 0.0, last));
}

double LineSlices::pressure_at(double z) const {
  const auto k = static_cast<std::size_t>(slice_of(z));
  const double part = z / profile.slice_length - static_cast<double>(k);
  return node_pressure[k] + part * (node_pressure[k + 1] - node_pressure[k]);
}

LineSlices line_slices(const CaseFacts& facts, const SimulationView& view, const Snapshot& snapshot) {
  LineSlices slices;
  slices.time = snapshot.time;
  slices.profile = slice_profile(facts, snapshot, snapshot.pressure_gradients);
  const std::size_t n = slices.profile.particles.size();
  for (std::vector<double>* values : {&slices.number, &slices.wall_force, &slices.wall_shear}) values->assign(n, 0);
  for (const Particle& p : snapshot.particles)
    if (std::isfinite(p.position[2])) ++slices.number[static_cast<std::size_t>(slices.slice_of(p.position[2]))];
  slices.node_pressure.assign(n + 1, 0);
  for (std::size_t k = n; k-- > 0;)
    slices.node_pressure[k] =
        slices.node_pressure[k + 1] + slices.profile.pressure_gradient[k] * slices.profile.slice_length;
  for (std::size_t k = 0; k < n; ++k) slices.gas_velocity.push_back(view.gas_velocity(static_cast<int>(k)));
  for (const Contact& contact : snapshot.contacts) {
    if (contact.partner != pipe_wall) continue;
    const double z = snapshot.particles[static_cast<std::size_t>(contact.owner)].position[2];
    const auto k = static_cast<std::size_t>(slices.slice_of(z));
    double force[3];
    force_on_partner(contact, force);
    slices.wall_force[k] += contact.normal_force;
    slices.wall_shear[k] += force[2];
  }
  return slices;
}

std::string slices_header(const CaseFacts& facts) {
  nlohmann::ordered_json header = {{"what", "fixdem slices"},
                                   {"version", 1},
                                   {"byte_order", std::endian::native == std::endian::little ? "little" : "big"},
                                   {"slices", facts.slice_count},
                                   {"slice_length", facts.pipe_length / facts.slice_count}};
  for (const Quantity& quantity : quantities)
    header["quantities"].push_back({{"name", quantity.name}, {"unit", quantity.unit}});
  return header.dump() + "\n";
}

std::string encode_slices(const LineSlices& slices) {
  std::string record(reinterpret_cast<const char*>(&slices.time), sizeof slices.time);
  for (const Quantity& quantity : quantities)
    for (std::size_t k = 0; k < slices.number.size(); ++k) {
      const auto value = static_cast<float>(quantity.value(slices, k));
      record.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
  return record;
}

}  // namespace fixdem::program
