// Kinds of particles: names, counts and densities that must hold, and which placed particle is of which.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "schema.hpp"
#include "size_checks.hpp"
#include "sizes.hpp"

namespace fixdem::casegen {
namespace {

std::string key_of(std::size_t species, const char* key) {
  return fmt::format("particles.species.{}.{}", species, key);
}

bool is_whole_number(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// Names are the species' own, and no other's number.
void check_names(Reading& reading, Report& report) {
  std::vector<Species>& species = reading.values.species;
  std::map<std::string, std::size_t> earlier;
  for (std::size_t k = 0; k < species.size(); ++k) {
    const std::string number = fmt::format("{}", k), key = key_of(k, "name");
    std::string& name = species[k].name;
    if (!reading.usable({key})) continue;
    if (name.empty()) name = number;
    if (is_whole_number(name) && name != number)
      report.error(reading.place(key),
                   fmt::format("{} is the number of another species; allowed: {} or a name with a letter in it",
                               reading.quote(key), number),
                   "species are numbered from 0 in the order of the file: choose a word");
    else if (const auto [other, is_new] = earlier.try_emplace(name, k); !is_new)
      report.error(reading.place(key),
                   fmt::format("{} is the name of species {}, too; allowed: a name of its own", reading.quote(key),
                               other->second),
                   "give each [[particles.species]] another name, or none");
  }
}

/// Density of each species, its own or that of all; false when one has none.
bool complete_densities(Reading& reading, Report& report) {
  CaseValues& v = reading.values;
  bool all_known = true;
  for (std::size_t k = 0; k < v.species.size(); ++k) {
    const std::string key = key_of(k, "density");
    if (!reading.usable({key})) {
      all_known = false;
    } else if (reading.has(key)) {
      continue;
    } else if (reading.has("particles.density")) {
      v.species[k].density = v.density;
      all_known = all_known && reading.usable({"particles.density"});
    } else {
      all_known = false;
      if (reading.usable({"particles.density"}))
        report.error(reading.place(key),
                     "missing key 'density' in [[particles.species]] and in [particles]; allowed: in one of them",
                     find_key("particles", "density")->advice);
    }
  }
  return all_known;
}

/// The number of a species that is given by number or name; what it is not is refused.
std::optional<std::size_t> species_of(const Reading& reading, std::size_t particle, Report& report) {
  const std::string& written = reading.values.placed[particle].species;
  const std::vector<Species>& species = reading.values.species;
  for (std::size_t k = 0; k < species.size(); ++k)
    if (written == species[k].name || written == fmt::format("{}", k)) return k;
  std::string names;
  for (const auto& one : species) names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", one.name);
  report.error(reading.place(placed_species_key(particle)),
               fmt::format("{} is no species; allowed: 0 to {}, or {}", reading.quote(placed_species_key(particle)),
                           species.size() - 1, names),
               "species are numbered from 0 in the order of the file");
  return std::nullopt;
}

/// Species of each placed particle, and as many of each as the file says; empty when something is wrong.
std::vector<std::size_t> placed_species(Reading& reading, Report& report) {
  CaseValues& v = reading.values;
  std::vector<std::size_t> result, counts(v.species.size());
  bool all_known = reading.usable({"start.particle"});
  for (std::size_t i = 0; i < v.placed.size(); ++i) {
    const std::string key = placed_species_key(i);
    if (!reading.has(key)) {
      if (reading.usable({key}))
        report.error(reading.place(key),
                     "missing key 'species' in [[start.particle]], needed with [[particles.species]]",
                     "write species = and the number, from 0 on, or the name of one [[particles.species]]");
      all_known = false;
      continue;
    }
    const auto found = reading.usable({key}) ? species_of(reading, i, report) : std::nullopt;
    all_known = all_known && found;
    if (!found) continue;
    result.push_back(*found);
    ++counts[*found];
    v.placed[i].species = fmt::format("{}", *found);
  }
  if (!all_known) return {};
  for (std::size_t k = 0; k < v.species.size(); ++k) {
    const auto placed = static_cast<std::int64_t>(counts[k]);
    if (v.species[k].count == placed || !reading.usable({key_of(k, "count")})) continue;
    report.error(reading.place(key_of(k, "count")),
                 fmt::format("{} of species \"{}\", but [[start.particle]] places {} of it; allowed: as many as are "
                             "placed",
                             reading.quote(key_of(k, "count")), v.species[k].name, placed),
                 "change the count, or the species of placed particles");
    all_known = false;
  }
  return all_known ? result : std::vector<std::size_t>{};
}

}  // namespace

void take_species(Reading& reading, Report& report) {
  CaseValues& v = reading.values;
  const std::string list = "particles.species";
  const std::size_t number = v.species.size();
  if (number == 0 && reading.usable({list}))
    report.error(reading.tables[list], "[[particles.species]] has no entries; allowed: 1 to 16 tables",
                 "write [[particles.species]], with two pairs of brackets, before each kind");
  if (number > most_species)
    report.error(reading.tables[fmt::format("{}.{}", list, most_species)],
                 fmt::format("{} [[particles.species]] tables; allowed: at most {}", number, most_species),
                 "for many sizes use [particles.sizes], a distribution of diameters");
  bool is_usable = number > 0 && number <= most_species && reading.usable({list});
  if (is_usable) {
    check_names(reading, report);
    is_usable = complete_densities(reading, report);
    std::int64_t sum = 0;
    for (std::size_t k = 0; k < number; ++k) {
      is_usable = is_usable && reading.usable({key_of(k, "count"), key_of(k, "diameter"), key_of(k, "name")});
      sum += v.species[k].count;
      if (sum > most_particles && sum - v.species[k].count <= most_particles)
        report.error(reading.place(key_of(k, "count")),
                     fmt::format("{} makes {} particles of all species; allowed: at most {}",
                                 reading.quote(key_of(k, "count")), sum, most_particles),
                     "lower the counts");
    }
    is_usable = is_usable && sum <= most_particles;
    v.count = sum;
  }
  if (!is_usable) return mark_sizes_unknown(reading);

  std::size_t largest = 0, bulkiest = 0;
  const auto volume = [&](std::size_t k) {
    return static_cast<double>(v.species[k].count) * std::pow(v.species[k].diameter, 3);
  };
  for (std::size_t k = 1; k < number; ++k) {
    if (v.species[k].diameter > v.species[largest].diameter) largest = k;
    if (volume(k) > volume(bulkiest)) bulkiest = k;
  }
  reading.largest_key = key_of(largest, "diameter");
  reading.count_key = key_of(bulkiest, "count");

  if (reading.tables.contains("start.particle")) {
    const std::vector<std::size_t> placed = placed_species(reading, report);
    if (placed.empty() && v.count > 0) return mark_sizes_unknown(reading);
    for (const std::size_t k : placed) add_run(v.sizes, 1, v.species[k].diameter, v.species[k].density, k);
  } else {
    for (std::size_t k = 0; k < number; ++k)
      add_run(v.sizes, v.species[k].count, v.species[k].diameter, v.species[k].density, k);
  }
  if (v.is_line() && !add_fed_species(reading, report)) {
    v.sizes.clear();
    mark_sizes_unknown(reading);
  }
}

}  // namespace fixdem::casegen
