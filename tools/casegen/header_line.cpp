// The members of a header that only lines have, and those of gas and output that only cases have which use them. A case
// that does not has the header of the time before there were such keys.
#include <algorithm>
#include <cmath>

#include "header_members.hpp"

namespace fixdem::casegen {

void write_start_count(Members& members, const CaseValues& v) {
  if (v.is_line()) members.whole("start_count", v.count);
}

void write_feed(Members& members, const CaseValues& v) {
  if (!v.is_line()) return;
  constexpr double between_events = 1e-3;  // s
  members.heading("feed");
  members.in_time("feed_rate", v.feed_rate, "kg/s");
  members.real("feed_start", v.feed_start, "s");
  members.real("feed_length", v.feed_length, "m");
  members.real("feed_velocity", v.feed_velocity, "m/s");
  members.seed("feed_seed", v.feed_seed);
  members.whole("feed_interval",
                static_cast<std::int64_t>(std::clamp(std::round(between_events / v.time_step), 1.0, 1e9)));
}

void write_gas_beyond(Members& members, const CaseValues& v) {
  if (v.gas_velocity.size() > 1) members.in_time("gas_velocity_in_time", v.gas_velocity, "m/s");
  if (v.gas_full_gap > 0) members.real("gas_full_gap", v.gas_full_gap, "m");
  if (!v.gas_compressible) return;
  members.flag("gas_compressible", true);
  members.real("gas_outlet_pressure", v.gas_outlet_pressure, "Pa");
  members.real("gas_temperature", v.gas_temperature, "K");
  members.real("gas_constant", v.gas_constant, "J/(kg K)");
  if (!v.gas_storage) return;
  members.flag("gas_storage", true);
  members.real("gas_supply_volume", v.gas_supply_volume, "m3");
  if (v.gas_inlet_pressure > 0) members.real("gas_inlet_pressure", v.gas_inlet_pressure, "Pa, absolute");
  if (!v.has_blower()) return;
  members.real("gas_blower_flow", v.gas_blower_flow, "m3/s at the outlet's pressure, against none");
  members.real("gas_blower_pressure", v.gas_blower_pressure, "Pa above the outlet's, where it delivers nothing");
}

void write_watching(Members& members, const CaseValues& v) {
  if (v.contact_interval > 0) members.real("contact_interval", v.contact_interval, "s");
  if (v.slice_interval > 0) members.real("slice_interval", v.slice_interval, "s");
  if (v.statistics_from >= 0) members.real("statistics_from", v.statistics_from, "s");
  if (v.probes.empty()) return;
  members.whole("probe_count", static_cast<std::int64_t>(v.probes.size()));
  std::string list;
  for (const auto& [position, interval] : v.probes)
    list += fmt::format("{}{{{}, {}}}", list.empty() ? "" : ", ", exact(position), exact(interval));
  members.add("Probe", "probes[]", "{" + list + "}", "m, s");
}

}  // namespace fixdem::casegen
