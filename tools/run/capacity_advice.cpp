#include "capacity_advice.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace fixdem::program {
namespace {

const CapacityUse* find(const std::vector<CapacityUse>& uses, const char* name) {
  const auto at = std::find_if(uses.begin(), uses.end(), [&](const CapacityUse& use) { return use.name == name; });
  return at == uses.end() ? nullptr : &*at;
}

/// `neighbours` with which this run would have had one place to spare everywhere. It is the size of all arrays of near
/// pairs, which have room in proportion to it.
long long enough_neighbours(const CapacityUse& neighbours, const CapacityUse& pairs, long long most) {
  const long long with_slack = pairs.high_water + pairs.high_water / 10;
  const long long for_pairs = (with_slack * neighbours.limit + pairs.limit - 1) / pairs.limit;
  return std::clamp(std::max(neighbours.high_water + 1LL, for_pairs), 2LL, most);
}

}  // namespace

std::string describe_capacities(const std::vector<CapacityUse>& uses, long long most_neighbours) {
  const CapacityUse *neighbours = find(uses, "neighbours"), *pairs = find(uses, "chunk_pairs"),
                    *across = find(uses, "wrap_pairs"), *reach = find(uses, "in_reach"), *memory = find(uses, "memory");
  if (!neighbours || !pairs || !across || !reach || !memory) return "";
  std::string text = fmt::format(
      "capacity: {} of {} neighbours, {} of {} pairs in a chunk{}, {} of {} particles within reach; {:.1f} KiB in "
      "all\n",
      neighbours->high_water, neighbours->limit, pairs->high_water, pairs->limit,
      across->limit > 0 ? fmt::format(", {} of {} across the ends", across->high_water, across->limit) : "",
      reach->high_water, reach->limit, static_cast<double>(memory->high_water) / 1024);
  long long enough = enough_neighbours(*neighbours, *pairs, most_neighbours);
  if (across->limit > 0) enough = std::max(enough, enough_neighbours(*neighbours, *across, most_neighbours));
  if (enough < neighbours->limit)
    text += fmt::format("  [capacity] neighbours = {} would be enough for this run and save memory\n", enough);
  else if (enough > neighbours->limit)
    text += fmt::format("  nearly full: [capacity] neighbours = {} leaves room to spare\n", enough);
  return text;
}

}  // namespace fixdem::program
