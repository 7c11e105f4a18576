#include "state_file.hpp"

#include <cmath>
#include <cstring>

#include "binary_file.hpp"
#include "output_file.hpp"

namespace fixdem::program {
namespace {

constexpr std::string_view magic("FIXDEM\x1a\n", 8);
constexpr std::uint32_t first_version = 1, last_version = 4;
const std::string advice = "make it again by running its case, or take another --start-state";

std::uint32_t version_of(const StoredState& state) {
  return first_version + (state.has_rolling ? 1 : 0) + (state.diameters.empty() ? 0 : 2);
}

bool all_finite(const double (&v)[3]) { return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]); }

}  // namespace

StoredState stored_state(const CaseFacts& facts, const Snapshot& snapshot, bool complete, double duration) {
  StoredState state;
  state.case_name = facts.name;
  state.source_hash = facts.source_hash;
  state.complete = complete;
  state.histories_are_forces = facts.tangential != TangentialLaw::displacement;
  state.diameter = facts.diameter;
  state.time = snapshot.time;
  state.duration = duration;
  state.step = static_cast<std::uint64_t>(snapshot.step);
  state.particles = snapshot.particles;
  state.images.assign(snapshot.images.begin(), snapshot.images.end());
  if (facts.has_sizes())
    for (int id = 0; id < static_cast<int>(state.particles.size()); ++id) {
      state.diameters.push_back(facts.diameter_of(snapshot.kind(id)));
      state.densities.push_back(facts.density_of(snapshot.kind(id)));
    }
  state.has_rolling = facts.has_rolling;
  for (const Contact& c : snapshot.contacts)
    state.histories.push_back({c.owner,
                               c.partner,
                               {c.history[0], c.history[1], c.history[2]},
                               {c.rolling_history[0], c.rolling_history[1], c.rolling_history[2]}});
  return state;
}

std::string encode_state(const StoredState& state) {
  BinaryWriter writer;
  writer.begin(magic, version_of(state));
  writer.put(static_cast<std::uint32_t>(state.case_name.size()));
  writer.bytes(state.case_name.data(), state.case_name.size());
  writer.put(state.source_hash);
  writer.put(std::uint32_t{state.complete});
  writer.put(std::uint32_t{state.histories_are_forces});
  writer.put(std::uint64_t{state.particles.size()});
  writer.put(state.diameter);
  writer.put(state.time);
  writer.put(state.duration);
  writer.put(state.step);
  for (const Particle& p : state.particles) writer.put(p.position);
  for (const Particle& p : state.particles) writer.put(p.velocity);
  for (const Particle& p : state.particles) writer.put(p.angular_velocity);
  for (std::int32_t image : state.images) writer.put(image);
  for (const double diameter : state.diameters) writer.put(diameter);
  for (const double density : state.densities) writer.put(density);
  writer.put(std::uint64_t{state.histories.size()});
  for (const StoredHistory& h : state.histories) {
    writer.put(h.owner);
    writer.put(h.partner);
    writer.put(h.history);
    if (state.has_rolling) writer.put(h.rolling);
  }
  writer.seal();
  return writer.text();
}

StoredState decode_state(std::string_view bytes, const std::string& name) {
  BinaryReader reader(bytes, name, advice);
  const std::uint32_t found = reader.begin(magic, "state file", first_version, last_version);
  reader.check_seal(bytes);

  StoredState state;
  state.has_rolling = found % 2 == 0;
  state.case_name = std::string(reader.take(reader.get<std::uint32_t>()));
  state.source_hash = reader.get<std::uint64_t>();
  state.complete = reader.get<std::uint32_t>() != 0;
  state.histories_are_forces = reader.get<std::uint32_t>() != 0;
  const auto count = reader.get<std::uint64_t>();
  if (count > bytes.size() / 72) reader.refuse("is damaged: it announces {} particles", count);
  state.diameter = reader.get<double>();
  state.time = reader.get<double>();
  state.duration = reader.get<double>();
  state.step = reader.get<std::uint64_t>();
  state.particles.resize(count);
  for (Particle& p : state.particles) std::memcpy(p.position, reader.take(24).data(), 24);
  for (Particle& p : state.particles) std::memcpy(p.velocity, reader.take(24).data(), 24);
  for (Particle& p : state.particles) std::memcpy(p.angular_velocity, reader.take(24).data(), 24);
  for (std::uint64_t i = 0; i < count; ++i) {
    state.images.push_back(reader.get<std::int32_t>());
    const Particle& p = state.particles[i];
    if (!all_finite(p.position) || !all_finite(p.velocity) || !all_finite(p.angular_velocity))
      reader.refuse("holds a value of particle {} that is not finite", i);
  }
  if (found > 2) {
    state.diameters.resize(count), state.densities.resize(count);
    for (double& diameter : state.diameters) diameter = reader.get<double>();
    for (double& density : state.densities) density = reader.get<double>();
    for (std::uint64_t i = 0; i < count; ++i)
      if (!(state.diameters[i] > 0 && state.densities[i] > 0 && std::isfinite(state.diameters[i]) &&
            std::isfinite(state.densities[i])))
        reader.refuse("holds an impossible diameter or density of particle {}", i);
  }
  state.histories.resize(reader.count(state.has_rolling ? 56 : 32));
  for (StoredHistory& h : state.histories) {
    h.owner = reader.get<std::int32_t>();
    h.partner = reader.get<std::int32_t>();
    std::memcpy(h.history, reader.take(24).data(), 24);
    if (state.has_rolling) std::memcpy(h.rolling, reader.take(24).data(), 24);
    const auto last = static_cast<std::int64_t>(count) - 1;
    if (h.owner < 0 || h.owner > last || h.partner < -3 || h.partner > last || !all_finite(h.history) ||
        !all_finite(h.rolling))
      reader.refuse("holds an impossible contact of particles {} and {}", h.owner, h.partner);
  }
  if (!reader.empty()) reader.refuse("is longer than its contents");
  return state;
}

void write_state(const std::filesystem::path& path, const StoredState& state) {
  write_file(path, encode_state(state), Durability::durable);
}

StoredState read_state(const std::filesystem::path& path) {
  return decode_state(read_file(path, "start state"), path.string());
}

}  // namespace fixdem::program
