// Keys that need or exclude one another.
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "checks.hpp"
#include "schema.hpp"
#include "size_distribution.hpp"

namespace fixdem::casegen {
namespace {

void check_start(Reading& reading, Report& report) {
  if (!reading.tables.contains("start")) return;
  std::vector<std::string> found;
  for (const char* key : {"start.arrangement", "start.from"})
    if (reading.has(key)) found.push_back(reading.quote(key));
  if (reading.tables.contains("start.particle")) found.push_back("[[start.particle]]");
  const std::string advice = "keep one of arrangement = \"random\", from = \"another case\" and [[start.particle]]";
  if (found.empty() && reading.usable({"start.particle"}))
    report.error(reading.tables["start"],
                 "[start] does not say where the particles come from; allowed: exactly one way", advice);
  if (found.size() > 1)
    report.error(reading.tables["start"],
                 fmt::format("[start] has {} together with {}; allowed: exactly one way", found[0], found[1]), advice);

  const std::string& from = reading.values.start_from;
  if (!from.empty() && !is_plain_path(from)) {
    report.error(reading.place("start.from"),
                 fmt::format("{} is no name or path of a case; allowed: letters, digits, _ - + . and / (no part begins "
                             "with -, the last one not with a point)",
                             reading.quote("start.from")),
                 find_key("start", "from")->advice);
    reading.unusable.insert("start.from");
  }

  const auto count = static_cast<std::int64_t>(reading.values.placed.size());
  const bool counts = reading.tables.contains("start.particle") && !reading.tables.contains("particles.species") &&
                      reading.usable({"particles.count", "start.particle"});
  if (counts && count != reading.values.count)
    report.error(reading.place("particles.count"),
                 fmt::format("{}, but [[start.particle]] places {}; allowed: as many as are placed",
                             reading.quote("particles.count"), count),
                 fmt::format("set count = {}, or place {} particles", count, reading.values.count));
}

/// Gravity is given as it is, or by the inclination of the pipe.
void take_inclination(Reading& reading, Report& report) {
  CaseValues& v = reading.values;
  const char *inclination = "pipe.inclination", *gravity = "run.gravity";
  if (!reading.has(inclination) || !reading.usable({inclination})) return;
  if (reading.has(gravity)) {
    report.error(reading.given.at(gravity).key,
                 fmt::format("{} together with [pipe] inclination; allowed: one of them", reading.quote(gravity)),
                 "remove it: inclination sets gravity, 9.81 m/s2 downwards");
    reading.unusable.insert(gravity);
  } else if (v.inclination != 0) {
    const double g = -v.gravity[1], angle = v.inclination * std::numbers::pi / 180;
    const bool is_upright = std::abs(v.inclination) == 90;
    v.gravity = {0, is_upright ? 0 : to_ten_digits(-g * std::cos(angle)), to_ten_digits(-g * std::sin(angle))};
  }
}

/// What is said of walls where there are none, and of friction where there is none.
void check_walls_and_friction(const Reading& reading, Report& report) {
  const CaseValues& v = reading.values;
  if (!v.has_walls() && reading.usable({"pipe.wall", "pipe.ends"}))
    for (const char* key : {"material.wall_friction", "material.wall_restitution", "material.wall_rolling_friction"})
      if (reading.has(key))
        report.error(
            reading.place(key),
            fmt::format("{} with [pipe] wall = false and ends = \"periodic\"; allowed: only where there are walls",
                        reading.quote(key)),
            "remove it, which would do nothing");
  if (v.damping == "critical" && reading.has("material.wall_restitution") && reading.usable({"contact.damping"}))
    report.error(reading.place("material.wall_restitution"),
                 fmt::format("{} with damping = \"critical\"; allowed: only with \"restitution\"",
                             reading.quote("material.wall_restitution")),
                 "remove it, which would do nothing: critical damping asks for no restitution");
  if (v.friction_limit == "total" || !reading.has("contact.friction_limit")) return;
  if (!v.has_rotation() && reading.usable({"material.friction", "material.wall_friction"}))
    report.error(
        reading.place("contact.friction_limit"),
        fmt::format("{} with friction = 0; allowed: only with friction", reading.quote("contact.friction_limit")),
        "remove it, which would do nothing, or raise [material] friction");
  if (v.slider == "paper" && reading.usable({"contact.slider"}))
    report.error(reading.place("contact.friction_limit"),
                 fmt::format("{} with slider = \"paper\"; allowed: \"total\"", reading.quote("contact.friction_limit")),
                 "eqs. (10)-(12) to the letter use the whole force: choose slider = \"clip\" or \"exact\"");
}

/// Rolling resistance needs friction, of particles or of walls, and is of use only below it.
void check_rolling(const Reading& reading, Report& report) {
  const CaseValues& v = reading.values;
  const auto check = [&](const char* key, double rolling, const char* friction_key, double friction) {
    const std::string name = std::string("material.") + key, needed = std::string("material.") + friction_key;
    if (!reading.usable({name, needed, "material.friction"}) || !(rolling > 0)) return;
    const std::string pair = fmt::format("{} = {} with {} = {}", key, rolling, friction_key, friction);
    if (friction == 0 && reading.has(name))
      report.error(reading.place(name), fmt::format("[material] {}; allowed: 0", pair),
                   fmt::format("without friction nothing turns: set {} above 0 or remove it", friction_key));
    else if (friction > 0 && !(rolling < friction))
      report.warning(reading.place(reading.has(name) ? name : needed),
                     fmt::format("[material] {} = {} is not below {} = {}: particles will slide rather than roll", key,
                                 rolling, friction_key, friction),
                     fmt::format("lower {}, or raise {}, if they are to roll", key, friction_key));
  };
  check("rolling_friction", v.rolling_friction, "friction", v.friction);
  const bool has_own = reading.has("material.wall_friction") || reading.has("material.wall_rolling_friction");
  if (!v.has_walls() || !has_own || !reading.usable({"pipe.wall", "pipe.ends", "material.rolling_friction"})) return;
  CaseValues of_wall = v;
  if (!reading.has("material.wall_friction")) of_wall.wall_friction = v.default_wall_friction();
  if (!reading.has("material.wall_rolling_friction"))
    of_wall.wall_rolling_friction = of_wall.default_wall_rolling_friction();
  check("wall_rolling_friction", of_wall.wall_rolling_friction, "wall_friction", of_wall.wall_friction);
}

void check_law(const Reading& reading, Report& report) {
  const CaseValues& v = reading.values;
  if (v.damping == "critical" && v.normal == "hertz" && reading.usable({"contact.normal"}))
    report.error(reading.place("contact.damping"),
                 "[contact] damping = \"critical\" with normal = \"hertz\"; allowed: \"restitution\"",
                 "use damping = \"restitution\", or normal = \"linear\" with given stiffnesses");
  if (v.damping_mass == "particle" && v.has_sizes())
    report.error(
        reading.place("contact.damping_mass"),
        fmt::format("{} with particles of several sizes; allowed: \"reduced\"", reading.quote("contact.damping_mass")),
        "the two masses of a contact differ, and only the reduced mass gives the restitution: remove it");
  if (v.integrator == "impulse" && v.slider == "paper" && reading.usable({"contact.slider"}))
    report.error(
        reading.place("contact.slider"),
        "[contact] slider = \"paper\" with integrator = \"impulse\"; allowed: \"exact\", \"clip\"",
        "use slider = \"exact\"; with \"paper\" impacts do not converge, and another integrator gains nothing");
}

}  // namespace

void check_conditions(Reading& reading, Report& report) {
  check_start(reading, report);
  check_walls_and_friction(reading, report);
  check_rolling(reading, report);
  check_law(reading, report);
  take_inclination(reading, report);
  check_gas(reading, report);
  check_feed_table(reading, report);
}

}  // namespace fixdem::casegen
