// Sizes of the particles: which of the ways to give them a case takes, and what holds for all of them. Lengths in
// metres.
//
// What remains of a case of one size, one species among them, is `count`, `diameter` and `density`: the case of equal
// spheres.
#include <fmt/format.h>

#include "schema.hpp"
#include "size_checks.hpp"
#include "sizes.hpp"

namespace fixdem::casegen {
namespace {

/// A case of one size becomes that of equal spheres.
void make_equal(CaseValues& v) {
  if (v.species.size() > 1 || v.sizes.size() != 1) return;
  v.diameter = v.sizes[0].diameter;
  v.density = v.sizes[0].density;
  v.sizes.clear();
  v.species.clear();
  v.feed_mixture.clear();
  v.has_species = v.has_distribution = false;
  for (auto& particle : v.placed) particle.species.clear();
}

/// None of a kind only where they are fed.
void check_counts(Reading& reading, Report& report) {
  const CaseValues& v = reading.values;
  if (v.is_line() || !reading.usable({"pipe.ends"})) return;
  const auto check = [&](const std::string& key, std::int64_t count) {
    if (count > 0 || !reading.has(key) || !reading.usable({key})) return;
    report.error(
        reading.place(key),
        fmt::format("{}; allowed: 1 to {}, and 0 with [pipe] ends = \"open\"", reading.quote(key), most_particles),
        "an open pipe is fed; any other holds what is there at the start");
    reading.unusable.insert(key);
  };
  check("particles.count", v.count);
  for (std::size_t k = 0; k < v.species.size(); ++k)
    check(fmt::format("particles.species.{}.count", k), v.species[k].count);
}

/// Species of placed particles where there are no species.
void refuse_species_of_placed(const Reading& reading, Report& report) {
  for (std::size_t i = 0; i < reading.values.placed.size(); ++i)
    if (const std::string key = placed_species_key(i); reading.has(key))
      report.error(reading.place(key),
                   fmt::format("{} without [[particles.species]]; allowed: only with them", reading.quote(key)),
                   "remove it, which would do nothing, or give [[particles.species]]");
}

/// Of many runs one of each particle: the kernel then finds a particle's by its number (kernel/sizes.hpp). Species that
/// are fed stay runs, whose counts are probabilities and may be large.
void make_single(CaseValues& v) {
  std::vector<SizeRun>& runs = v.sizes;
  if (runs.size() <= most_species || (v.is_line() && v.has_species)) return;
  std::vector<SizeRun> single;
  for (SizeRun run : runs) {
    const auto count = static_cast<std::size_t>(run.count);
    run.count = 1;
    single.insert(single.end(), count, run);
  }
  runs = std::move(single);
}

/// Lists of near pairs and reaches of cells have their limits.
void check_ratio(Reading& reading, Report& report) {
  CaseValues& v = reading.values;
  if (!v.has_sizes()) return;
  const SizeFigures figures = figures_of(v);
  if (figures.largest <= largest_ratio * figures.smallest) return;
  report.error(
      reading.place(reading.largest_key),
      fmt::format("{}: the largest diameter {} is {:.4g} times the smallest, {}; allowed: at most {:.0f} times",
                  reading.quote(reading.largest_key), figures.largest, figures.largest / figures.smallest,
                  figures.smallest, largest_ratio),
      "lists of near pairs are made for that: raise the smallest, or run the fine part apart");
  v.sizes.clear();
  mark_sizes_unknown(reading);
}

void check_neighbours(const Reading& reading, Report& report) {
  constexpr std::int64_t most_of_equal = 30;
  const CaseValues& v = reading.values;
  const char* key = "capacity.neighbours";
  if (!v.has_sizes() && reading.usable({"particles.diameter", key}) && v.neighbour_capacity > most_of_equal)
    report.error(reading.place(key),
                 fmt::format("{} with equal spheres; allowed: 2 to {}", reading.quote(key), most_of_equal),
                 find_key("capacity", "neighbours")->advice);
}

}  // namespace

void mark_sizes_unknown(Reading& reading) {
  for (const char* key : {"particles.count", "particles.diameter", "particles.density"}) reading.unusable.insert(key);
}

std::string placed_species_key(std::size_t particle) { return fmt::format("start.particle.{}.species", particle); }

void add_run(std::vector<SizeRun>& runs, std::int64_t count, double diameter, double density, std::size_t species) {
  const auto number = static_cast<int>(species);
  if (count == 0) return;
  if (!runs.empty() && runs.back().diameter == diameter && runs.back().density == density &&
      runs.back().species == number)
    runs.back().count += static_cast<int>(count);
  else
    runs.push_back({static_cast<int>(count), diameter, density, number});
}

void check_sizes(Reading& reading, Report& report) {
  CaseValues& v = reading.values;
  check_counts(reading, report);
  if (!v.has_species) refuse_species_of_placed(reading, report);
  if (v.has_species && v.has_distribution) {
    report.error(reading.tables["particles.sizes"],
                 "[particles.sizes] together with [[particles.species]]; allowed: one of them",
                 "a few kinds are species, a continuous distribution of one material is sizes: remove the other");
    mark_sizes_unknown(reading);
  } else if (v.has_species) {
    take_species(reading, report);
  } else if (v.has_distribution) {
    take_distribution(reading, report);
  }
  check_ratio(reading, report);
  make_equal(v);
  make_single(v);
  check_neighbours(reading, report);
}

}  // namespace fixdem::casegen
