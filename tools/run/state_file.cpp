#include "state_file.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>

#include "failure.hpp"
#include "output_file.hpp"

namespace fixdem::program {
namespace {

constexpr std::string_view magic("FIXDEM\x1a\n", 8);
constexpr std::uint32_t byte_order_mark = 0x01020304, swapped_mark = 0x04030201;
constexpr std::uint32_t version = 1;

template <class T>
void put(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Takes values off the front; running out of bytes is a refusal, never a read beyond the end.
class Reader {
 public:
  Reader(std::string_view bytes, const std::string& name) : rest_(bytes), name_(name) {}

  template <class T>
  T get() {
    T value;
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
    return value;
  }
  std::string_view take(std::uint64_t size) {
    if (size > rest_.size()) refuse("is cut short: {} more bytes are missing", size - rest_.size());
    const std::string_view front = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return front;
  }
  /// A number of items of at least `item_size` bytes each that can still follow.
  std::uint64_t count(std::uint64_t item_size) {
    const auto number = get<std::uint64_t>();
    if (number > rest_.size() / item_size) refuse("is damaged: it announces {} items", number);
    return number;
  }
  bool empty() const { return rest_.empty(); }

  template <class... Values>
  [[noreturn]] void refuse(fmt::format_string<Values...> format, Values&&... values) const {
    throw Failure(exit_bad_input, name_ + " " + fmt::format(format, std::forward<Values>(values)...) +
                                      "\n  make it again by running its case, or take another --start-state");
  }

 private:
  std::string_view rest_;
  const std::string& name_;
};

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
  for (const Contact& c : snapshot.contacts)
    state.histories.push_back({c.owner, c.partner, {c.history[0], c.history[1], c.history[2]}});
  return state;
}

std::string encode_state(const StoredState& state) {
  std::string bytes(magic);
  put(bytes, byte_order_mark);
  put(bytes, version);
  put(bytes, static_cast<std::uint32_t>(state.case_name.size()));
  bytes += state.case_name;
  put(bytes, state.source_hash);
  put(bytes, std::uint32_t{state.complete});
  put(bytes, std::uint32_t{state.histories_are_forces});
  put(bytes, std::uint64_t{state.particles.size()});
  put(bytes, state.diameter);
  put(bytes, state.time);
  put(bytes, state.duration);
  put(bytes, state.step);
  for (const Particle& p : state.particles) put(bytes, p.position);
  for (const Particle& p : state.particles) put(bytes, p.velocity);
  for (const Particle& p : state.particles) put(bytes, p.angular_velocity);
  for (std::int32_t image : state.images) put(bytes, image);
  put(bytes, std::uint64_t{state.histories.size()});
  for (const StoredHistory& h : state.histories) {
    put(bytes, h.owner);
    put(bytes, h.partner);
    put(bytes, h.history);
  }
  put(bytes, std::uint64_t{XXH64(bytes.data(), bytes.size(), 0)});
  return bytes;
}

StoredState decode_state(std::string_view bytes, const std::string& name) {
  Reader reader(bytes, name);
  if (bytes.substr(0, magic.size()) != magic) reader.refuse("is no state file of fixdem (wrong first bytes)");
  reader.take(magic.size());
  const auto mark = reader.get<std::uint32_t>();
  if (mark == swapped_mark) reader.refuse("was written on a machine of the other byte order");
  if (mark != byte_order_mark)
    reader.refuse("is damaged: byte order mark {:08x} instead of {:08x}", mark, byte_order_mark);
  const auto found_version = reader.get<std::uint32_t>();
  if (found_version != version) reader.refuse("has version {}, this program reads version {}", found_version, version);

  if (bytes.size() < 64) reader.refuse("is cut short: {} bytes in all", bytes.size());
  const std::size_t body = bytes.size() - sizeof(std::uint64_t);
  std::uint64_t stored_sum;
  std::memcpy(&stored_sum, bytes.data() + body, sizeof stored_sum);
  const std::uint64_t sum = XXH64(bytes.data(), body, 0);
  if (sum != stored_sum)
    reader.refuse("is damaged or cut short: checksum {:016x}, the file says {:016x}", sum, stored_sum);

  StoredState state;
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
  state.histories.resize(reader.count(32));
  for (StoredHistory& h : state.histories) {
    h.owner = reader.get<std::int32_t>();
    h.partner = reader.get<std::int32_t>();
    std::memcpy(h.history, reader.take(24).data(), 24);
    const auto last = static_cast<std::int64_t>(count) - 1;
    if (h.owner < 0 || h.owner > last || h.partner < -3 || h.partner > last || !all_finite(h.history))
      reader.refuse("holds an impossible contact of particles {} and {}", h.owner, h.partner);
  }
  reader.take(sizeof(std::uint64_t));
  if (!reader.empty()) reader.refuse("is longer than its contents");
  return state;
}

void write_state(const std::filesystem::path& path, const StoredState& state) {
  write_file(path, encode_state(state), Durability::durable);
}

StoredState read_state(const std::filesystem::path& path) {
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (!file.is_open() || file.bad() || std::filesystem::is_directory(path))
    throw Failure(exit_input_output, fmt::format("cannot read the start state {}: {}", path.string(),
                                                 errno != 0 ? std::strerror(errno) : "not a readable file"));
  return decode_state(bytes, path.string());
}

}  // namespace fixdem::program
