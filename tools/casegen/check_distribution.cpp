// A continuous distribution of diameters: what must hold for it, and the particles that stand for it.
#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "schema.hpp"
#include "size_checks.hpp"
#include "size_distribution.hpp"
#include "sizes.hpp"

namespace fixdem::casegen {
namespace {

constexpr double least_kept = 0.05;  // of the uncut distribution

/// Whether the distribution makes sense; each thing that does not is refused.
bool check_distribution(const Reading& reading, Report& report) {
  const CaseValues& v = reading.values;
  const int before = report.errors();
  const auto key = [](const char* name) { return std::string("particles.sizes.") + name; };
  const auto refuse = [&](const char* name, const std::string& words, const std::string& advice) {
    report.error(reading.place(key(name)), reading.quote(key(name)) + words, advice);
  };
  if (v.size_distribution == "table") {
    const std::vector<double>&d = v.size_diameters, &below = v.size_below;
    if (std::adjacent_find(d.begin(), d.end(), std::greater_equal<>()) != d.end())
      refuse("diameters", " is not ascending; allowed: each above the one before", "sort the sieves by their meshes");
    if (below.front() != 0 || below.back() != 1 || !std::is_sorted(below.begin(), below.end()))
      refuse("below", " is not ascending from 0 to 1; allowed: 0 first, 1 last, none below the one before",
             "nothing is below the first diameter, and all is below the last");
    if (d.size() != below.size())
      refuse("below", fmt::format(" has {} numbers and diameters has {}; allowed: as many", below.size(), d.size()),
             "give the share below each of the diameters");
    return report.errors() == before;
  }
  if (v.size_minimum >= v.size_maximum) {
    refuse("minimum", fmt::format(" is not below maximum = {}; allowed: below it", v.size_maximum),
           "raise maximum or lower minimum; equal spheres have [particles] diameter and no [particles.sizes]");
    return false;
  }
  if (v.size_distribution == "uniform") return true;
  const bool is_normal = v.size_distribution == "normal";
  const double middle = is_normal ? v.size_mean : v.size_median;
  if (middle < v.size_minimum || middle > v.size_maximum)
    refuse(is_normal ? "mean" : "median",
           fmt::format(" lies outside minimum to maximum; allowed: {} to {}", v.size_minimum, v.size_maximum),
           "it is that of the distribution before the cut: move minimum or maximum beyond it");
  else if (const double kept = SizeDistribution(v).kept_share(); !(kept >= least_kept))
    refuse(
        is_normal ? "deviation" : "spread",
        fmt::format(": the cut at minimum and maximum leaves {:.2g} % of the distribution; allowed: at least {:.0f} %",
                    100 * kept, 100 * least_kept),
        "lower it, or move minimum and maximum apart; distribution = \"uniform\" is nearly the same");
  return report.errors() == before;
}

}  // namespace

void take_distribution(Reading& reading, Report& report) {
  CaseValues& v = reading.values;
  if (reading.tables.contains("start.particle"))
    report.error(reading.tables["start.particle"],
                 "[[start.particle]] with [particles.sizes]; allowed: a random arrangement, or from another case",
                 "particles that are placed have sizes of their own: give [[particles.species]] and each its species");
  bool is_usable = reading.usable({"particles.density", "particles.count", "start.particle"}) &&
                   !reading.tables.contains("start.particle");
  for (const auto& rule : case_keys())
    if (rule.table == "particles.sizes") is_usable = is_usable && reading.usable({"particles.sizes." + rule.name});
  if (is_usable && v.count > most_distributed) {
    report.error(reading.place("particles.count"),
                 fmt::format("{} with [particles.sizes]; allowed: at most {}", reading.quote("particles.count"),
                             most_distributed),
                 "the diameter of each is a line of the header: lower count, or give a few [[particles.species]]");
    is_usable = false;
  }
  if (!is_usable || !check_distribution(reading, report)) return mark_sizes_unknown(reading);
  for (const double diameter : distributed_diameters(v, v.count)) add_run(v.sizes, 1, diameter, v.density, 0);
  for (const double diameter : distributed_diameters(v, v.is_line() ? kinds_of_distribution : 0))
    add_run(v.sizes, 1, diameter, v.density, 0);
  reading.largest_key = v.size_distribution == "table" ? "particles.sizes.diameters" : "particles.sizes.maximum";
}

}  // namespace fixdem::casegen
