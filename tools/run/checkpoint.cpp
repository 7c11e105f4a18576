#include "checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "binary_file.hpp"
#include "running_hash.hpp"
#include "schedule.hpp"

namespace fixdem::program {
namespace {

constexpr std::string_view magic("FIXDEMCP", 8);
constexpr std::uint32_t version = 3;
const std::string advice = "begin anew with --fresh";

template <class Archive>
void transfer(Archive& archive, Checkpoint& c) {
  std::uint64_t pairs = archive.count(c.identity.size(), 16);
  c.identity.resize(pairs);
  for (auto& [name, value] : c.identity) archive(name, value);
  archive(c.duration, c.case_duration, c.seed, c.frames, c.start, c.step, c.time, c.outputs, c.simulation, c.program);
}

/// Every key of the case with its value, as casegen has written them: one a line.
void append_keys(const CaseFacts& facts, Identity& list) {
  static const std::set<std::string_view> free = {"title", "[run] duration", "[run] reference_speed",
                                                  "[output] checkpoint_interval", "[output] statistics_from"};
  std::string_view rest = facts.keys;
  if (rest.empty()) list.emplace_back("case file (XXH64)", fmt::format("{:016x}", facts.source_hash));
  while (!rest.empty()) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(rest.size(), line.size() + 1));
    const std::size_t middle = line.find(" = ");
    if (middle == std::string_view::npos || free.contains(line.substr(0, middle))) continue;
    list.emplace_back(line.substr(0, middle), line.substr(middle + 3));
  }
}

/// Of every particle, or of every kind of a line, as they are and not as they were asked for.
std::string hash_of_sizes(const CaseFacts& facts) {
  RunningHash hash;
  for (int kind = 0; kind < facts.kind_count; ++kind) {
    const double values[2] = {facts.diameter_of(kind), facts.density_of(kind)};
    const int species = facts.species_of(kind);
    hash.add(values, sizeof values);
    hash.add(&species, sizeof species);
  }
  return fmt::format("{:016x}", hash.value());
}

const std::string* find(const Identity& identity, const std::string& name) {
  const auto at =
      std::find_if(identity.begin(), identity.end(), [&](const auto& entry) { return entry.first == name; });
  return at == identity.end() ? nullptr : &at->second;
}

}  // namespace

Identity brief_identity(const CaseFacts& facts) {
  return {{"case", facts.name},
          {"case file (XXH64)", fmt::format("{:016x}", facts.source_hash)},
          {"precision", precision_name(facts.precision)},
          {"kernel (checksum of its source)", facts.kernel}};
}

Identity identity(const CaseFacts& facts, SimulationView& view) {
  Identity list = {{"case", facts.name},
                   {"precision", precision_name(facts.precision)},
                   {"kernel (checksum of its source)", facts.kernel},
                   {"program", program_version}};
  append_keys(facts, list);
  if (facts.has_sizes()) list.emplace_back("diameters, densities and species (XXH64)", hash_of_sizes(facts));
  for (const CapacityUse& use : view.capacities()) list.emplace_back("room for " + use.name, std::to_string(use.limit));
  list.emplace_back("bytes of the simulation", std::to_string(view.memory().size()));
  return list;
}

std::string differences(const Identity& there, const Identity& here) {
  std::string text;
  for (const auto& [name, value] : here)
    if (const std::string* other = find(there, name); other == nullptr || *other != value)
      text += fmt::format("\n  {}: {} there, {} here", name, other != nullptr ? *other : "nothing", value);
  for (const auto& [name, value] : there)
    if (find(here, name) == nullptr) text += fmt::format("\n  {}: {} there, nothing here", name, value);
  return text;
}

std::string encode_checkpoint(Checkpoint& checkpoint) {
  BinaryWriter writer;
  writer.begin(magic, version);
  transfer(writer, checkpoint);
  writer.seal();
  return std::move(writer.text());
}

Checkpoint decode_checkpoint(std::string_view bytes, const std::string& name) {
  BinaryReader reader(bytes, name, advice);
  reader.begin(magic, "checkpoint", version, version);
  reader.check_seal(bytes);
  Checkpoint checkpoint;
  transfer(reader, checkpoint);
  if (!reader.empty()) reader.refuse("is longer than its contents");
  return checkpoint;
}

Checkpoint read_checkpoint(const std::filesystem::path& path, const Identity& here) {
  Checkpoint checkpoint = decode_checkpoint(read_file(path, "checkpoint"), path.string());
  if (const std::string what = differences(checkpoint.identity, here); !what.empty())
    throw Failure(exit_bad_input, fmt::format("{} is of another program than this one:{}\n  {}, or build the program "
                                              "again that wrote it",
                                              path.string(), what, advice));
  return checkpoint;
}

}  // namespace fixdem::program
