// Time-step advice: contact time at the reference speed, Rayleigh time, steps per contact; and where mixed precision
// does not pay.
//
// The Rayleigh time pi r sqrt(rho/G) / (0.1631 nu + 0.8766) is that of a surface wave over half the sphere. Linear law:
// the limit 2 sqrt(m/k) of eq. (39). Contact times: tools/run/contact_time.hpp. SI units.
#include "advice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <vector>

#include "tools/run/contact_time.hpp"

namespace fixdem::casegen {
namespace {

// Far beyond what any accuracy needs: a unit was mistaken, or a time step.
constexpr double most_steps_per_contact = 1000;

struct ContactTime {
  const char* between;
  double seconds;
};

double mass_of(const CaseValues& v) { return std::numbers::pi / 6 * std::pow(v.diameter, 3) * v.density; }

/// Contact times of the kinds of contact that this case can have.
std::vector<ContactTime> contact_times(const CaseValues& v) {
  const double mass = mass_of(v), radius = v.diameter / 2;
  const bool pairs = v.count > 1, walls = v.wall || v.ends == "closed";
  std::vector<ContactTime> times;
  if (v.normal == "linear") {
    if (pairs) times.push_back({"pair", linear_contact_time(mass / 2, v.normal_stiffness)});
    if (walls) times.push_back({"wall", linear_contact_time(mass, v.normal_stiffness)});
    return times;
  }
  if (v.reference_speed <= 0) return times;
  const double compliance = (1 - v.poisson_ratio * v.poisson_ratio) / v.youngs_modulus;
  const double wall_compliance = (1 - v.wall_poisson_ratio * v.wall_poisson_ratio) / v.wall_youngs_modulus;
  const double pair_stiffness = std::sqrt(2 * radius) / (3 * compliance);                        // eq. (16)
  const double wall_stiffness = 4.0 / 3.0 * std::sqrt(radius) / (compliance + wall_compliance);  // eq. (17)
  if (pairs) times.push_back({"pair", hertz_contact_time(mass / 2, pair_stiffness, v.reference_speed)});
  if (walls) times.push_back({"wall", hertz_contact_time(mass, wall_stiffness, v.reference_speed)});
  return times;
}

std::string steps_text(double steps) {
  return steps < 1e6 ? fmt::format("{:.1f}", steps) : fmt::format("{:.3g}", steps);
}

double rayleigh_time(const CaseValues& v) {
  const double shear_modulus = v.youngs_modulus / (2 * (1 + v.poisson_ratio));  // eq. (20)
  return std::numbers::pi * v.diameter / 2 * std::sqrt(v.density / shear_modulus) / (0.1631 * v.poisson_ratio + 0.8766);
}

}  // namespace

std::string advise_time_step(const Reading& reading, const std::string& name, Report& report) {
  const CaseValues& v = reading.values;
  std::string text;
  const auto line = [&]<class... Values>(fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(std::back_inserter(text), format, std::forward<Values>(values)...);
    text += '\n';
  };
  const auto times = contact_times(v);
  line("{}: time step {:.4g} s, reference speed {:.4g} m/s", name, v.time_step, v.reference_speed);
  for (const auto& [between, seconds] : times)
    line("  {} contact   {:.4g} s: time step / contact time {:.4f}, {} steps per contact", between, seconds,
         v.time_step / seconds, steps_text(seconds / v.time_step));
  if (v.normal == "hertz") {
    const double rayleigh = rayleigh_time(v);
    line("  Rayleigh time  {:.4g} s: time step / Rayleigh time {:.4f}", rayleigh, v.time_step / rayleigh);
  } else {
    const double limit = 2 * std::sqrt(mass_of(v) / v.normal_stiffness);
    line("  eq. (39) limit {:.4g} s: time step / limit {:.4f}", limit, v.time_step / limit);
  }
  if (times.empty() && v.normal == "hertz" && v.reference_speed <= 0) {
    line("  nothing moves at the start: set [run] reference_speed for the contact time");
    return text;
  }
  double shortest = std::numeric_limits<double>::infinity();
  for (const auto& time : times) shortest = std::min(shortest, time.seconds);
  if (shortest < fewest_steps_per_contact * v.time_step)
    report.warning(
        reading.place("run.time_step"),
        fmt::format(
            "{} gives only {:.1f} steps per contact at {:.4g} m/s; at least {:.0f} are needed for a true rebound",
            reading.quote("run.time_step"), shortest / v.time_step, v.reference_speed, fewest_steps_per_contact),
        fmt::format("try time_step = {:.1e}, or a softer material", shortest / fewest_steps_per_contact));
  if (std::isfinite(shortest) && shortest > most_steps_per_contact * v.time_step)
    report.warning(reading.place("run.time_step"),
                   fmt::format("{} gives {:.3g} steps per contact at {:.4g} m/s; {:.0f} to some hundreds resolve it",
                               reading.quote("run.time_step"), shortest / v.time_step, v.reference_speed,
                               fewest_steps_per_contact),
                   fmt::format("look at the units of the stiffness, diameter and density; or try time_step = {:.1e}",
                               shortest / (2 * fewest_steps_per_contact)));
  return text;
}

void advise_precision(const Reading& reading, Report& report) {
  const CaseValues& v = reading.values;
  if (v.precision == "mixed" && v.has_gas)
    report.warning(
        reading.place("run.precision"),
        fmt::format("{} with a [gas] table: where few of the near pairs touch, as in a plug, it is no faster",
                    reading.quote("run.precision")),
        "use precision = \"double\"; mixed is for beds (bench/README.md has step/plug in both precisions)");
}

}  // namespace fixdem::casegen
