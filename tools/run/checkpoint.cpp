#include "checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "binary_file.hpp"

namespace fixdem::program {
namespace {

constexpr std::string_view magic("FIXDEMCP", 8);
constexpr std::uint32_t version = 1;
const std::string advice = "run without --resume to begin anew";

template <class Archive>
void transfer(Archive& archive, Checkpoint& c) {
  std::uint64_t pairs = archive.count(c.identity.size(), 16);
  c.identity.resize(pairs);
  for (auto& [name, value] : c.identity) archive(name, value);
  archive(c.duration, c.seed, c.frames, c.step, c.time, c.outputs, c.simulation, c.program);
}

const std::string* find(const Identity& identity, const std::string& name) {
  const auto at =
      std::find_if(identity.begin(), identity.end(), [&](const auto& entry) { return entry.first == name; });
  return at == identity.end() ? nullptr : &at->second;
}

}  // namespace

Identity identity(const CaseFacts& facts, SimulationView& view) {
  Identity list = {{"case", facts.name},
                   {"case file (XXH64)", fmt::format("{:016x}", facts.source_hash)},
                   {"precision", precision_name(facts.precision)},
                   {"kernel (checksum of its source)", facts.kernel},
                   {"program", program_version}};
  for (const CapacityUse& use : view.capacities()) list.emplace_back("room for " + use.name, std::to_string(use.limit));
  list.emplace_back("bytes of the simulation", std::to_string(view.memory().size()));
  return list;
}

std::string differences(const Identity& there, const Identity& here) {
  std::string text;
  const auto add = [&text](const std::string& name, const std::string* a, const std::string* b) {
    const std::string none = "nothing";
    text += fmt::format("\n  {}: {} there, {} here", name, a != nullptr ? *a : none, b != nullptr ? *b : none);
  };
  for (const auto& [name, value] : here)
    if (const std::string* other = find(there, name); other == nullptr || *other != value) add(name, other, &value);
  for (const auto& [name, value] : there)
    if (find(here, name) == nullptr) add(name, &value, nullptr);
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
  reader.begin(magic, "checkpoint", version);
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
