// tools/casegen: continuous distributions of diameters: the particles that stand for one against closed forms, and what
// is refused.
//
// Particle k of n must have the share (k + 1/2)/n of all below it. That is checked with the distribution, never with
// its inverse, which is what casegen computes. Diameters have ten digits.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "casegen_size_cases.hpp"

using namespace casegen_test;

namespace {

constexpr double ten_digits = 5.1e-10;

std::vector<double> diameters_of(const std::string& text) {
  std::vector<double> diameters;
  for (const Run& run : sizes_of(printed(text))) {
    CHECK(run.density == 1000);
    CHECK(run.species == 0);
    diameters.insert(diameters.end(), static_cast<std::size_t>(run.count), run.diameter);
  }
  return diameters;
}

/// Against a share of the particles below a diameter. `steepness`: of the share, in shares per relative change.
void check_quantiles(const std::string& lines, int count, double steepness,
                     const std::function<double(double)>& below) {
  std::vector<double> diameters = diameters_of(distributed(lines, count));
  CAPTURE(lines);
  REQUIRE(diameters.size() == static_cast<std::size_t>(count));
  std::sort(diameters.begin(), diameters.end());
  double worst = 0;
  for (int k = 0; k < count; ++k)
    worst = std::max(worst, std::abs(below(diameters[static_cast<std::size_t>(k)]) - (k + 0.5) / count));
  CHECK(worst < steepness * ten_digits);
}

double normal_share(double x) { return std::erfc(-x / std::sqrt(2.0)) / 2; }

const std::string uniform = "distribution = \"uniform\"\nminimum = 0.004\nmaximum = 0.006\n";
const std::string normal =
    "distribution = \"normal\"\nminimum = 0.004\nmaximum = 0.0065\nmean = 0.005\ndeviation = 0.0005\n";
const std::string lognormal =
    "distribution = \"lognormal\"\nminimum = 0.003\nmaximum = 0.007\nmedian = 0.0045\nspread = 0.25\n";
const std::string table =
    "distribution = \"table\"\ndiameters = [0.002, 0.003, 0.004, 0.006]\nbelow = [0, 0.25, 0.25, 1]\n";

}  // namespace

TEST_CASE("casegen: quantiles of a uniform distribution, exactly") {
  std::vector<double> found = diameters_of(distributed(uniform));
  REQUIRE(found.size() == 5);
  std::sort(found.begin(), found.end());
  const double expected[] = {0.0042, 0.0046, 0.005, 0.0054, 0.0058};
  for (std::size_t k = 0; k < 5; ++k) CHECK(found[k] == expected[k]);
  check_quantiles(uniform, 1000, 3, [](double d) { return (d - 0.004) / 0.002; });
}

TEST_CASE("casegen: quantiles of normal and logarithmic normal distributions, cut at their ends") {
  const double low = normal_share(-2), kept = normal_share(3) - low;
  check_quantiles(normal, 1001, 5, [&](double d) { return (normal_share((d - 0.005) / 0.0005) - low) / kept; });
  const auto scaled = [](double d) { return std::log(d / 0.0045) / 0.25; };
  const double low_log = normal_share(scaled(0.003)), kept_log = normal_share(scaled(0.007)) - low_log;
  check_quantiles(lognormal, 1001, 3, [&](double d) { return (normal_share(scaled(d)) - low_log) / kept_log; });
  // Cut at its middle: half a normal distribution, whose quantile is known to many digits.
  const auto half = [](const std::string& ends) {
    return "distribution = \"normal\"\nmean = 0.005\ndeviation = 0.0001\n" + ends;
  };
  std::vector<double> upper = diameters_of(distributed(half("minimum = 0.005\nmaximum = 0.009\n"), 2));
  std::sort(upper.begin(), upper.end());
  REQUIRE(upper.size() == 2);
  CHECK(upper[0] == doctest::Approx(0.005 + 0.0001 * 0.318639363964375).epsilon(1e-9));  // 5/8 of the whole
  CHECK(upper[1] == doctest::Approx(0.005 + 0.0001 * 1.150349380376008).epsilon(1e-9));  // 7/8
}

TEST_CASE("casegen: quantiles of a table by number and by volume") {
  check_quantiles(table + "weight = \"number\"\n", 1000, 3,
                  [](double d) { return d < 0.003 ? (d - 0.002) / 0.001 * 0.25 : 0.25 + (d - 0.004) / 0.002 * 0.75; });
  // By volume the density of number is share/width/d^3; its integral from a to d is share/width (a^-2 - d^-2)/2.
  const auto numbers = [](double share, double width, double a, double d) {
    return share / width * (1 / (a * a) - 1 / (d * d)) / 2;
  };
  const double all = numbers(0.25, 0.001, 0.002, 0.003) + numbers(0.75, 0.002, 0.004, 0.006);
  const auto below = [&](double d) {
    const double first = numbers(0.25, 0.001, 0.002, std::min(d, 0.003));
    return (d < 0.0035 ? first : first + numbers(0.75, 0.002, 0.004, d)) / all;
  };
  check_quantiles(table, 1000, 3, below);
  check_quantiles(table + "weight = \"volume\"\n", 7, 3, below);
  // The volume of many particles that lies below a sieve is what the table says.
  double volume = 0, fine = 0;
  for (const double d : diameters_of(distributed(table, 20000))) {
    volume += d * d * d;
    if (d < 0.003) fine += d * d * d;
  }
  CHECK(fine / volume == doctest::Approx(0.25).epsilon(1e-4));
}

TEST_CASE("casegen: the seed shuffles the diameters, and nothing else") {
  const std::vector<double> first = diameters_of(distributed(uniform, 100));
  std::vector<double> again = diameters_of(distributed(uniform + "seed = 1\n", 100));
  CHECK(again == first);
  CHECK_FALSE(std::is_sorted(first.begin(), first.end()));
  std::vector<double> other = diameters_of(distributed(uniform + "seed = 2\n", 100));
  CHECK(other != first);
  std::sort(other.begin(), other.end());
  std::sort(again.begin(), again.end());
  CHECK(other == again);
  // The same everywhere: the order of five.
  const std::vector<double> five = diameters_of(distributed(uniform));
  CHECK(five == std::vector<double>{0.005, 0.0054, 0.0046, 0.0058, 0.0042});
}

TEST_CASE("casegen: a distribution is in header and keys, whatever is left to defaults") {
  const std::string header = printed(distributed(table));
  for (const char* words : {"int species_count = 0;", "[particles] count = 5\\012[particles] density = 1000\\012",
                            "[particles.sizes] distribution = \\\"table\\\"\\012",
                            "[particles.sizes] diameters = [0.002, 0.003, 0.004, 0.006]",
                            "[particles.sizes] below = [0, 0.25, 0.25, 1]", "[particles.sizes] weight = \\\"volume\\\"",
                            "[particles.sizes] seed = 1\\012", "double gas_bed_diameter = 0x0p+0;"})
    CHECK_MESSAGE(contains(header, words), words);
  for (const char* words : {"species_names", "[particles] diameter", "[particles.sizes] mean", " double diameter ="})
    CHECK_MESSAGE(!contains(header, words), words);
  CHECK(
      contains(printed(distributed(lognormal)), "[particles.sizes] spread = 0.25\\012[particles.sizes] seed = 1\\012"));
  // One particle has one size.
  CHECK(members_of(distributed(uniform, 1)) ==
        members_of(replaced(replaced(good_case, "count = 2", "count = 1"), "diameter = 0.010", "diameter = 0.005")));
}

TEST_CASE("casegen refuses distributions that make no sense") {
  const auto refused = [](const std::string& lines, const std::string& piece, const std::string& by,
                          const std::string& at, const std::vector<const char*>& words) {
    check_refused(replaced(distributed(lines), piece, by), at, words);
  };
  const std::string half = "[particles.sizes] minimum = 0.006 is not below maximum = 0.006; allowed: below it";
  refused(uniform, "minimum = 0.004", "minimum = 0.006", "0.006\nmax", {half.c_str(), "equal spheres have"});
  refused(
      normal, "mean = 0.005", "mean = 0.02", "0.02",
      {"[particles.sizes] mean = 0.02 lies outside minimum to maximum; allowed: 0.004 to 0.0065", "before the cut"});
  refused(lognormal, "median = 0.0045", "median = 0.002", "0.002", {"median = 0.002 lies outside minimum to maximum"});
  refused(normal, "deviation = 0.0005", "deviation = 0.2", "0.2",
          {"[particles.sizes] deviation = 0.2: the cut at minimum and maximum leaves 0.5 % of the distribution; "
           "allowed: at "
           "least 5 %"});
  refused(lognormal, "spread = 0.25", "spread = 30", "30\n",
          {"spread = 30: the cut at minimum and maximum leaves 1.1 %"});
  refused(normal, "mean = 0.005\n", "", "[particles.sizes]",
          {"missing key 'mean' in [particles.sizes], needed with distribution = \"normal\"",
           "between minimum and maximum"});
  refused(uniform, "maximum = 0.006\n", "", "[particles.sizes]",
          {"missing key 'maximum' in [particles.sizes], needed with distribution = \"uniform\", \"normal\" or"});
  refused(uniform, "maximum", "mean = 0.005\nmaximum", "mean",
          {"[particles.sizes] mean = 0.005 is not used here; allowed: only with distribution = \"normal\""});
  refused(uniform, "maximum", "weight = \"volume\"\nmaximum", "weight", {"only with distribution = \"table\""});
  refused(uniform, "distribution = \"uniform\"\n", "", "[particles.sizes]",
          {"missing key 'distribution' in [particles.sizes]", "1 error"});
  refused(uniform, "\"uniform\"", "\"gauss\"", "\"gauss\"", {"\"uniform\", \"normal\", \"lognormal\", \"table\""});
  refused(table, "0.003, 0.004", "0.004, 0.004", "[0.002, 0.004",
          {"diameters = [0.002, 0.004, 0.004, 0.006] is not ascending"});
  refused(table, "[0, 0.25, 0.25, 1]", "[0, 0.25, 0.2, 1]", "[0, 0.25, 0.2,",
          {"is not ascending from 0 to 1; allowed: 0 first"});
  refused(table, "[0, 0.25, 0.25, 1]", "[0.1, 0.25, 0.25, 1]", "[0.1", {"is not ascending from 0 to 1"});
  refused(table, "[0, 0.25, 0.25, 1]", "[0, 0.25, 1]", "[0, 0.25, 1]",
          {"has 3 numbers and diameters has 4; allowed: as many"});
  refused(table, "[0, 0.25, 0.25, 1]", "[0, 25, 25, 100]", "[0, 25",
          {"has 25 in it, which is out of range", "each 0 to 1"});
  refused(table, "[0, 0.25, 0.25, 1]", "[1]", "[1]",
          {"below = [1] in [particles.sizes] has 1 entries", "2 to 100 numbers"});
  refused(table, "[0, 0.25, 0.25, 1]", "\"0 1\"", "\"0 1\"", {"is a text, but must be a list of numbers"});
  refused(table, "[0, 0.25, 0.25, 1]", "[0, \"a\", 1]", "[0, \"a\"", {"has a text in it, but must have numbers"});
  check_refused(
      replaced(distributed(uniform, 50), "minimum = 0.004", "minimum = 0.0001"), "0.006",
      {"[particles.sizes] maximum = 0.006: the largest diameter 0.005941 is 37.36 times the smallest, 0.000159; "
       "allowed: at most 10 times"});
  refused(uniform, "maximum = 0.006", "maximum = 0.06", "0.06", {"maximum = 0.06 is wider than the pipe"});
  check_refused(distributed(uniform, 20001), "20001", {"count = 20001 with [particles.sizes]; allowed: at most 20000"});
  check_refused(replaced(distributed(uniform), "density = 1000.0\n", ""), "[particles]",
                {"missing key 'density' in [particles]"});
  check_refused(replaced(distributed(uniform), "count = 5\n", ""), "[particles]",
                {"missing key 'count' in [particles]"});
  check_refused(replaced(distributed(uniform), "count = 5", "count = 5\ndiameter = 0.005"), "diameter",
                {"[particles] diameter = 0.005 together with [particles.sizes]; allowed: one of them",
                 "the distribution gives the diameters"});
  check_refused(replaced(distributed(uniform), "count = 5\n", large), "[particles.sizes]",
                {"[particles.sizes] together with [[particles.species]]; allowed: one of them"});
  check_refused(
      placed(distributed(uniform, 1), {"position = [0, 0, 0.1]"}), "[[start.particle]]",
      {"[[start.particle]] with [particles.sizes]; allowed: a random arrangement", "give [[particles.species]]"});
  check_refused(replaced(distributed(uniform), "[particles.sizes]", "[[particles.sizes]]"), "[[particles.sizes]]",
                {"'particles.sizes' is a list, but must be a table"});
}
