// Keys that say something only with a certain choice of another key: of the normal law, of the start, of what gives
// the particles' sizes; of the gas.
#include <fmt/format.h>

#include "checks.hpp"
#include "schema.hpp"

namespace fixdem::casegen {
namespace {

/// The choice is not known when the key that makes it was missing or refused.
bool choice_is_known(When when, const Reading& reading) {
  switch (when) {
    case When::always:
      return false;
    case When::hertz:
    case When::linear:
      return reading.usable({"contact.normal"});
    case When::random:
    case When::from:
      return reading.usable({"start.arrangement", "start.from"}) && reading.tables.contains("start");
    case When::no_species:
    case When::one_size:
    case When::species_default:
      return true;
    case When::size_ends:
    case When::size_normal:
    case When::size_lognormal:
    case When::size_table:
      return reading.usable({"particles.sizes.distribution"}) && reading.tables.contains("particles.sizes");
    case When::line:
      return reading.usable({"pipe.ends"});
    case When::velocity_given:
      return reading.usable({"gas.inlet_pressure", "gas.blower_flow", "gas.blower_pressure"}) &&
             (reading.values.gas_compressible || applies(when, reading.values));  // otherwise they are refused
    case When::incompressible:
    case When::compressible:
      return reading.usable({"gas.compressible"});
  }
  return false;
}

/// What stands in place of a key that is given beside it, and why; empty where a key only lacks the choice it needs.
struct Instead {
  std::string other, advice;
};

Instead instead_of(When when, const CaseValues& v) {
  switch (when) {
    case When::no_species:
      return {"[[particles.species]]", "remove it: it is the sum of the species' counts"};
    case When::one_size:
      if (v.has_species) return {"[[particles.species]]", "remove it: each species has its own"};
      return {"[particles.sizes]", "remove it: the distribution gives the diameters"};
    case When::velocity_given:
      return {v.has_blower() ? "a blower" : "inlet_pressure", "remove it: the gas flows as it is driven"};
    case When::incompressible:
      return {"compressible = true", "remove it: it follows from outlet_pressure, temperature and gas_constant"};
    default:
      return {};
  }
}

void refuse(const Key& key, const std::string& name, const Reading& reading, Report& report) {
  const std::string quoted = reading.quote(name);
  const auto [other, advice] = instead_of(key.when, reading.values);
  if (!other.empty())
    report.error(reading.given.at(name).key, fmt::format("{} together with {}; allowed: one of them", quoted, other),
                 advice);
  else
    report.error(reading.given.at(name).key,
                 fmt::format("{} is not used here; allowed: only with {}", quoted, describe(key.when)),
                 fmt::format("remove '{}', which would do nothing, or choose {}", key.name, describe(key.when)));
}

void refuse_missing(const Key& key, const std::string& name, const Reading& reading, Report& report) {
  const std::string choice = describe(key.when);
  report.error(reading.place(name),
               fmt::format("missing key '{}' in {}{}{}: {}", key.name, table_title(key.table),
                           choice.empty() ? "" : ", needed with ", choice, key.meaning),
               key.advice);
}

}  // namespace

void check_applicable_keys(Reading& reading, Report& report) {
  for (const auto& key : case_keys()) {
    if (!choice_is_known(key.when, reading)) continue;
    const std::string name = key.table + "." + key.name;
    const bool wanted = applies(key.when, reading.values);
    const bool needed = wanted && key.required && !(key.when == When::species_default && reading.values.has_species);
    if (reading.has(name) && !wanted) {
      refuse(key, name, reading, report);
      reading.unusable.insert(name);
    } else if (!reading.has(name) && needed && !reading.unusable.contains(name)) {
      if (key.table != "contact" && !reading.tables.contains(key.table)) continue;  // the table itself is missing
      refuse_missing(key, name, reading, report);
      reading.unusable.insert(name);
    }
  }
}

}  // namespace fixdem::casegen
