// Keys that say something only with a certain choice of another key: of the normal law, of the start, of what gives
// the particles' sizes.
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
  }
  return false;
}

void refuse(const Key& key, const std::string& name, const Reading& reading, Report& report) {
  const CaseValues& v = reading.values;
  const std::string quoted = reading.quote(name);
  if (key.when == When::no_species || key.when == When::one_size)
    report.error(reading.given.at(name).key,
                 fmt::format("{} together with {}; allowed: one of them", quoted,
                             v.has_species ? "[[particles.species]]" : "[particles.sizes]"),
                 key.when == When::no_species ? "remove it: it is the sum of the species' counts"
                 : v.has_species              ? "remove it: each species has its own"
                                              : "remove it: the distribution gives the diameters");
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
