// What the keys of the gas must satisfy together, and with pipe and gravity.
#include <fmt/format.h>

#include "checks.hpp"
#include "kernel/case.hpp"
#include "schema.hpp"

namespace fixdem::casegen {
namespace {

/// One particle alone makes no bed.
bool has_bed(const CaseValues& v) { return v.is_line() || v.count > 1; }

/// The gas passes over a bed that weight holds together (kernel/gas_slices.hpp).
void check_gravity(const Reading& reading, Report& report) {
  const CaseValues& v = reading.values;
  if (!reading.usable({"run.gravity", "particles.count", "pipe.ends"})) return;
  if (gas_takes_gravity(v.gravity.data(), has_bed(v))) return;
  report.error(
      reading.place("run.gravity"),
      fmt::format("{} with a [gas] table; allowed: any but zero, for one particle zero as well",
                  reading.quote("run.gravity")),
      "the gas passes over a bed that weight holds together: give gravity or [pipe] inclination, or remove [gas]");
}

/// Where the whole section counts as bed there is no height of one.
void check_height(const Reading& reading, Report& report) {
  const CaseValues& v = reading.values;
  const char* gap = "gas.full_gap";
  const fixdem::detail::BedDirection direction({v.gravity[0], v.gravity[1], v.gravity[2]});
  if (has_bed(v) && direction.is_steep && reading.usable({"run.gravity", "pipe.inclination", "particles.count"}))
    for (const char* key : {gap, "gas.bed_height"})
      if (reading.has(key) && reading.usable({key}))
        report.error(
            reading.place(key),
            fmt::format("{} in a pipe steeper than 80 degrees; allowed: only in one less steep", reading.quote(key)),
            "remove it, which would do nothing: there the gas takes the whole section");
  if (!reading.has(gap) || !reading.usable({gap, "pipe.diameter", "gas.bed_height"})) return;
  if (v.gas_bed_height == "strict")
    report.error(reading.place(gap),
                 fmt::format("{} with bed_height = \"strict\"; allowed: \"continuous\", \"hard\"", reading.quote(gap)),
                 "remove it, which would do nothing: only a slice without any gap is full then");
  if (v.gas_full_gap >= v.pipe_diameter)
    report.error(reading.place(gap),
                 fmt::format("{} leaves no free section; allowed: above 0 and below [pipe] diameter = {}",
                             reading.quote(gap), v.pipe_diameter),
                 find_key("gas", "full_gap")->advice);
}

/// What drives a compressible gas where its velocity is not given, and where it is stored.
void check_drive(const Reading& reading, Report& report) {
  const CaseValues& v = reading.values;
  const char *inlet = "gas.inlet_pressure", *flow = "gas.blower_flow", *limit = "gas.blower_pressure";
  if (!reading.usable({inlet, flow, limit})) return;
  for (const auto& [given, missing] : {std::pair{flow, limit}, std::pair{limit, flow}})
    if (reading.has(given) && !reading.has(missing))
      report.error(reading.place(given),
                   fmt::format("{} without {}; allowed: both or none", reading.quote(given), missing + 4),
                   "a blower is a line from its flow against no pressure to its pressure against no flow");
  if (reading.has(inlet) && v.has_blower())
    report.error(reading.place(inlet),
                 fmt::format("{} together with a blower; allowed: one of them", reading.quote(inlet)),
                 "the pressure at the inlet is given, or follows from what a blower delivers: remove one");
  if (reading.has(inlet) && reading.usable({"gas.outlet_pressure"}) && v.gas_inlet_pressure <= v.gas_outlet_pressure)
    report.error(reading.place(inlet),
                 fmt::format("{} is not above outlet_pressure = {}; allowed: above it", reading.quote(inlet),
                             v.gas_outlet_pressure),
                 "both are absolute: add the pressure of the atmosphere to that of a gauge");
  if (const char* supply = "gas.supply_volume"; reading.has(inlet) && reading.has(supply))
    report.error(reading.place(supply), fmt::format("{} together with inlet_pressure", reading.quote(supply)),
                 "remove it: a given pressure holds whatever the volume");
  const bool needs_storage = reading.has("gas.supply_volume") || reading.has(inlet) || v.has_blower();
  if (needs_storage && reading.has("gas.storage") && !v.gas_storage && reading.usable({"gas.storage"}))
    report.error(reading.place("gas.storage"),
                 fmt::format("{} with {}; allowed: true", reading.quote("gas.storage"),
                             reading.has(inlet) ? "inlet_pressure"
                             : v.has_blower()   ? "a blower"
                                                : "supply_volume"),
                 "remove it: it is solved with storage");
}

}  // namespace

void check_gas(const Reading& reading, Report& report) {
  const CaseValues& v = reading.values;
  if (!v.has_gas) return;
  if (!v.wall && reading.usable({"pipe.wall"}))
    report.error(reading.place("pipe.wall"), "[pipe] wall = false with a [gas] table; allowed: true",
                 "the gas model needs the pipe wall: set wall = true, or remove [gas]");
  check_gravity(reading, report);
  check_height(reading, report);
  check_drive(reading, report);
}

}  // namespace fixdem::casegen
