// Time-step advice: contact time at the reference speed, Rayleigh time, steps per contact; what the sizes of particles
// are; and where mixed precision does not pay.
//
// With several sizes each time is the shortest: of all pairs of species and of each with the walls; of a distribution,
// where all are of one material, that of the smallest with one another and with the walls.
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

#include "sizes.hpp"
#include "tools/run/contact_time.hpp"

namespace fixdem::casegen {
namespace {

// Far beyond what any accuracy needs: a unit was mistaken, or a time step.
constexpr double most_steps_per_contact = 1000;

struct ContactTime {
  const char* kind;
  std::string between;  // which spheres, with several sizes
  double seconds;
};

/// Spheres that are all alike.
struct Kind {
  std::string name;
  double diameter, density;
  bool is_one;  // alone of its kind
  double mass() const { return std::numbers::pi / 6 * std::pow(diameter, 3) * density; }
};

std::vector<Kind> kinds_of(const CaseValues& v) {
  if (!v.has_sizes()) return {{"", v.diameter, v.density, v.most_present() == 1}};
  std::vector<Kind> kinds;
  for (const auto& species : v.species)
    kinds.push_back({species.name, species.diameter, species.density, species.count == 1 && !v.is_line()});
  if (kinds.empty()) kinds.push_back({"smallest", figures_of(v).smallest, v.density, false});
  return kinds;
}

double pair_contact_time(const CaseValues& v, const Kind& one, const Kind& other) {
  const double mass = one.mass() / (1 + one.mass() / other.mass());  // eq. (42)
  if (v.normal == "linear") return linear_contact_time(mass, v.normal_stiffness);
  const double radius = one.diameter / 2 / (1 + one.diameter / other.diameter);
  const double compliance = 2 * (1 - v.poisson_ratio * v.poisson_ratio) / v.youngs_modulus;
  return hertz_contact_time(mass, 4.0 / 3.0 * std::sqrt(radius) / compliance, v.reference_speed);  // eqs. (16), (43)
}

double wall_contact_time(const CaseValues& v, const Kind& kind) {
  if (v.normal == "linear") return linear_contact_time(kind.mass(), v.normal_stiffness);
  const double compliance = (1 - v.poisson_ratio * v.poisson_ratio) / v.youngs_modulus +
                            (1 - v.wall_poisson_ratio * v.wall_poisson_ratio) / v.wall_youngs_modulus;
  const double stiffness = 4.0 / 3.0 * std::sqrt(kind.diameter / 2) / compliance;  // eq. (17)
  return hertz_contact_time(kind.mass(), stiffness, v.reference_speed);
}

/// The shortest contact time of each kind of contact that this case can have.
std::vector<ContactTime> contact_times(const CaseValues& v) {
  if (v.normal == "hertz" && v.reference_speed <= 0) return {};
  const std::vector<Kind> kinds = kinds_of(v);
  constexpr double never = std::numeric_limits<double>::infinity();
  ContactTime pair{"pair", "", never}, wall{"wall", "", never};
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    for (std::size_t j = i; j < kinds.size(); ++j) {
      if (i == j && kinds[i].is_one) continue;
      const double seconds = pair_contact_time(v, kinds[i], kinds[j]);
      if (seconds < pair.seconds) pair = {"pair", kinds[i].name + " with " + kinds[j].name, seconds};
    }
    if (!v.has_walls()) continue;
    const double seconds = wall_contact_time(v, kinds[i]);
    if (seconds < wall.seconds) wall = {"wall", kinds[i].name, seconds};
  }
  std::vector<ContactTime> times;
  for (const ContactTime& time : {pair, wall})
    if (std::isfinite(time.seconds)) times.push_back(time);
  return times;
}

std::string steps_text(double steps) {
  return steps < 1e6 ? fmt::format("{:.1f}", steps) : fmt::format("{:.3g}", steps);
}

double rayleigh_time(const CaseValues& v, const Kind& kind) {
  const double shear_modulus = v.youngs_modulus / (2 * (1 + v.poisson_ratio));  // eq. (20)
  return std::numbers::pi * kind.diameter / 2 * std::sqrt(kind.density / shear_modulus) /
         (0.1631 * v.poisson_ratio + 0.8766);
}

/// The least that any of the spheres has.
double least_of(const CaseValues& v, double (*property)(const CaseValues&, const Kind&)) {
  double least = std::numeric_limits<double>::infinity();
  for (const Kind& kind : kinds_of(v)) least = std::min(least, property(v, kind));
  return least;
}

/// One line on particles of several sizes.
std::string describe_sizes(const CaseValues& v) {
  const SizeFigures sizes = figures_of(v);
  std::string what;
  if (v.species.empty()) what = v.size_distribution == "table" ? "sizes by table" : v.size_distribution + " sizes";
  for (const auto& species : v.species)
    what += fmt::format("{} {} of {:.4g} m", what.empty() ? fmt::format("{} species:", v.species.size()) : ",",
                        species.name, species.diameter);
  return fmt::format("{}; diameters: smallest {:.4g}, mean {:.4g}, Sauter {:.4g}, largest {:.4g} m", what,
                     sizes.smallest, sizes.mean, sizes.sauter, sizes.largest);
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
  if (v.has_sizes()) line("  {}", describe_sizes(v));
  const auto spheres = [&](const ContactTime& time) { return v.has_sizes() ? " (" + time.between + ")" : ""; };
  for (const ContactTime& time : times)
    line("  {} contact   {:.4g} s{}: time step / contact time {:.4f}, {} steps per contact", time.kind, time.seconds,
         spheres(time), v.time_step / time.seconds, steps_text(time.seconds / v.time_step));
  if (v.normal == "hertz") {
    const double rayleigh = least_of(v, rayleigh_time);
    line("  Rayleigh time  {:.4g} s: time step / Rayleigh time {:.4f}", rayleigh, v.time_step / rayleigh);
  } else {
    const double limit = least_of(
        v, [](const CaseValues& of, const Kind& kind) { return 2 * std::sqrt(kind.mass() / of.normal_stiffness); });
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
