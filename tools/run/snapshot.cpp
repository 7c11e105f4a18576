#include "snapshot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <tuple>
#include <utility>

#include "running_hash.hpp"

namespace fixdem::program {
namespace {

/// The same contact as seen from its partner: force and slip turn round, and with them normal and history. Rolling does
/// not: the difference of the angular velocities turns round, and so does the normal it is multiplied with.
void swap_owner(Contact& contact) {
  std::swap(contact.owner, contact.partner);
  for (int k = 0; k < 3; ++k) {
    contact.normal[k] = -contact.normal[k];
    contact.tangential_force[k] = -contact.tangential_force[k];
    contact.history[k] = -contact.history[k];
  }
}

}  // namespace

Snapshot take_snapshot(const SimulationView& view, int particle_count, int gas_slices) {
  Snapshot snapshot;
  snapshot.time = view.time();
  snapshot.step = view.step();
  snapshot.is_of_line = view.is_line();
  snapshot.particles.reserve(static_cast<std::size_t>(particle_count));
  snapshot.images.reserve(static_cast<std::size_t>(particle_count));
  std::vector<int> number_of(snapshot.is_of_line ? static_cast<std::size_t>(particle_count) : 0, -1);
  for (int id = 0; id < particle_count; ++id) {
    if (snapshot.is_of_line) {
      if (!view.is_present(id)) continue;
      number_of[static_cast<std::size_t>(id)] = static_cast<int>(snapshot.particles.size());
      snapshot.serials.push_back(view.serial(id));
      snapshot.kinds.push_back(view.kind(id));
    }
    snapshot.particles.push_back(view.particle(id));
    snapshot.images.push_back(view.image(id));
  }
  snapshot.contacts = view.contacts();
  if (snapshot.is_of_line)
    for (Contact& contact : snapshot.contacts)
      for (int* id : {&contact.owner, &contact.partner})
        if (*id >= 0) *id = number_of[static_cast<std::size_t>(*id)];
  for (int slice = 0; slice < gas_slices; ++slice) snapshot.pressure_gradients.push_back(view.pressure_gradient(slice));
  for (Contact& contact : snapshot.contacts)
    if (contact.partner >= 0 && contact.partner < contact.owner) swap_owner(contact);
  std::sort(snapshot.contacts.begin(), snapshot.contacts.end(), [](const Contact& a, const Contact& b) {
    return std::tie(a.owner, a.partner) < std::tie(b.owner, b.partner);
  });
  return snapshot;
}

int Snapshot::find(long long serial) const {
  if (!is_of_line) return static_cast<int>(serial);
  const auto at = std::ranges::find(serials, serial);
  return at == serials.end() ? -1 : static_cast<int>(at - serials.begin());
}

std::vector<int> contacts_per_particle(const Snapshot& snapshot) {
  std::vector<int> count(snapshot.particles.size(), 0);
  for (const Contact& contact : snapshot.contacts) {
    ++count[static_cast<std::size_t>(contact.owner)];
    if (contact.partner >= 0) ++count[static_cast<std::size_t>(contact.partner)];
  }
  return count;
}

std::string state_hash(const Snapshot& snapshot) {
  RunningHash hash;
  for (const Particle& p : snapshot.particles) hash.add(p.position, sizeof p.position);
  for (const Particle& p : snapshot.particles) hash.add(p.velocity, sizeof p.velocity);
  for (const Particle& p : snapshot.particles) hash.add(p.angular_velocity, sizeof p.angular_velocity);
  for (const Contact& contact : snapshot.contacts) {
    const std::int32_t ids[2] = {contact.owner, contact.partner};
    hash.add(ids, sizeof ids);
    hash.add(contact.history, sizeof contact.history);
  }
  const bool has_rolled = std::ranges::any_of(snapshot.contacts, [](const Contact& contact) {
    return std::ranges::any_of(contact.rolling_history, [](double component) { return component != 0; });
  });
  if (has_rolled)
    for (const Contact& contact : snapshot.contacts) hash.add(contact.rolling_history, sizeof contact.rolling_history);
  return fmt::format("{:016x}", hash.value());
}

}  // namespace fixdem::program
