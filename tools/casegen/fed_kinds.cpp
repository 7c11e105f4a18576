// Kinds of what a line is fed with, where there are several species.
//
// Each particle that is fed has one of these kinds, all with the same probability, so species i is there as often as
// its share by number, n_i = w_i/m_i over the sum of all: w_i is its share of the mass that is fed and m_i the mass of
// one. About a thousand kinds do; the rarest species gets a hundred, so that rounding changes its share by half a per
// cent at most.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "schema.hpp"
#include "size_checks.hpp"
#include "sizes.hpp"

namespace fixdem::casegen {
namespace {

constexpr double usual_kinds = 1000, most_kinds = 1e6, kinds_of_rarest = 100;
constexpr double nearly = 1e-6;  // shares of three digits may not add up exactly

const char* const key = "feed.mixture";

std::string count_key(std::size_t species) { return fmt::format("particles.species.{}.count", species); }

/// But for a factor common to all.
double mass_of(const Species& s) { return s.density * s.diameter * s.diameter * s.diameter; }

double sum_of(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

/// That of the particles at the start.
std::vector<double> mixture_at_start(const std::vector<Species>& species) {
  std::vector<double> masses;
  masses.reserve(species.size());
  for (const Species& s : species) masses.push_back(static_cast<double>(s.count) * mass_of(s));
  const double sum = sum_of(masses);
  for (double& mass : masses) mass /= sum;
  return masses;
}

/// Whether shares of the mass are known and make sense; otherwise it says what is wrong.
bool take_mixture(Reading& reading, Report& report) {
  CaseValues& v = reading.values;
  const int before = report.errors();
  if (!reading.usable({key})) return false;
  if (!reading.has(key)) {
    if (v.count > 0) v.feed_mixture = mixture_at_start(v.species);
    if (v.count == 0 && v.species.size() == 1) v.feed_mixture = {1};
    if (v.feed_mixture.empty() && reading.tables.contains("feed"))
      report.error(reading.tables["feed"],
                   "missing key 'mixture' in [feed], needed with several species of which none is there at the start",
                   find_key("feed", "mixture")->advice);
    return !v.feed_mixture.empty();
  }
  const double sum = sum_of(v.feed_mixture);
  if (v.feed_mixture.size() != v.species.size())
    report.error(reading.place(key),
                 fmt::format("{} has {} numbers and there are {} species; allowed: as many", reading.quote(key),
                             v.feed_mixture.size(), v.species.size()),
                 "give the share of each [[particles.species]], in the order of the file; 0 feeds none of it");
  else if (std::abs(sum - 1) > nearly)
    report.error(reading.place(key), fmt::format("{} adds up to {:.7g}; allowed: 1", reading.quote(key), sum),
                 "give shares of the mass that is fed, not kilograms or per cent");
  for (std::size_t k = 0; k < v.species.size() && report.errors() == before; ++k)
    if (v.species[k].count == 0 && v.feed_mixture[k] == 0)
      report.error(reading.place(count_key(k)),
                   fmt::format("{} of species \"{}\", and none of it in [feed] mixture; allowed: one of them above 0",
                               reading.quote(count_key(k)), v.species[k].name),
                   "remove the species, or feed some of it");
  return report.errors() == before;
}

}  // namespace

bool add_fed_species(Reading& reading, Report& report) {
  CaseValues& v = reading.values;
  if (!take_mixture(reading, report)) return false;
  std::vector<double> numbers;
  double rarest = 1;
  for (std::size_t k = 0; k < v.species.size(); ++k) numbers.push_back(v.feed_mixture[k] / mass_of(v.species[k]));
  const double sum = sum_of(numbers);
  for (double& number : numbers) {
    number /= sum;
    if (number > 0) rarest = std::min(rarest, number);
  }
  const double kinds = std::clamp(std::ceil(kinds_of_rarest / rarest), usual_kinds, most_kinds);
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const auto count = static_cast<std::int64_t>(std::max(std::round(numbers[k] * kinds), numbers[k] > 0 ? 1.0 : 0.0));
    add_run(v.sizes, count, v.species[k].diameter, v.species[k].density, k);
  }
  return true;
}

}  // namespace fixdem::casegen
