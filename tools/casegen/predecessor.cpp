// The chain of cases that start from one another.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <vector>

#include "checks.hpp"
#include "nearest_name.hpp"
#include "sizes.hpp"

namespace fixdem::casegen {
namespace {

namespace fs = std::filesystem;

/// Names of the cases in a folder other than this one, for suggestions.
std::vector<std::string> cases_beside(const fs::path& folder, const fs::path& own) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& file : fs::directory_iterator(folder.empty() ? "." : folder, ignored))
    if (file.path().extension() == ".toml" && !fs::equivalent(file.path(), own, ignored))
      names.push_back(file.path().stem().string());
  return names;
}

/// What stands in `from` when the nearest case of the folder that it leads to is meant.
std::string suggestion(const std::string& from, const fs::path& missing, const std::string& file) {
  const std::string nearest = nearest_name(missing.stem().string(), cases_beside(missing.parent_path(), file));
  if (nearest.empty()) return "write that case first";
  return fmt::format("did you mean \"{}\"?", (fs::path(from).parent_path() / nearest).string());
}

/// Each particle keeps its diameter and density. Of equal spheres the density may change.
void check_same_sizes(const Reading& reading, const CaseValues& before, Place place, Report& report) {
  const CaseValues& v = reading.values;
  const std::string quoted = reading.quote("start.from");
  if (!v.has_sizes() && !before.has_sizes()) {
    if (before.diameter != v.diameter)
      report.error(place,
                   fmt::format("{} has particles of diameter {}; allowed: the same as here, {}", quoted,
                               before.diameter, v.diameter),
                   "start from a case of the same [particles] diameter");
    return;
  }
  if (before.count != v.count) return;  // reported already
  SizeRun all_there, all_here;
  const std::span<const SizeRun> there = runs_of(before, all_there), here = runs_of(v, all_here);
  std::size_t i = 0, j = 0;
  for (std::int64_t first = 0, end_there = there[0].count, end_here = here[0].count; first < v.count;) {
    const auto refuse = [&](const char* what, double earlier, double now) {
      report.error(
          place,
          fmt::format("{}: particle {} has {} {} there and {} here; allowed: the same diameters and densities, "
                      "number by number",
                      quoted, first, what, earlier, now),
          "start from a case of the same [[particles.species]] in the same order, or of the same "
          "[particles.sizes] and seed");
    };
    if (there[i].diameter != here[j].diameter) return refuse("diameter", there[i].diameter, here[j].diameter);
    if (there[i].density != here[j].density) return refuse("density", there[i].density, here[j].density);
    first = std::min(end_there, end_here);
    if (first == end_there && ++i < there.size()) end_there += there[i].count;
    if (first == end_here && ++j < here.size()) end_here += here[j].count;
  }
}

/// What the first predecessor must have in common with the case itself.
void check_same_particles(const Reading& reading, const CaseValues& before, Place place, Report& report) {
  const CaseValues& v = reading.values;
  const std::string quoted = reading.quote("start.from");
  if (before.is_line()) {
    report.error(
        place,
        fmt::format("{} is a line, of which nobody knows how many particles it ends with; allowed: a case with "
                    "ends = \"periodic\" or \"closed\"",
                    quoted),
        "change what is to change during one run: bulk_velocity and rate may be tables in time");
    return;
  }
  if (reading.usable({"particles.count"}) && before.count != v.count)
    report.error(place, fmt::format("{} has {} particles; allowed: as many as here, {}", quoted, before.count, v.count),
                 "start from a case of the same count, or change [particles] count");
  if (reading.usable({"particles.diameter", "particles.density", "particles.count"}))
    check_same_sizes(reading, before, place, report);
  if (reading.usable({"pipe.diameter"}) && v.wall && before.pipe_diameter > v.pipe_diameter)
    report.error(place,
                 fmt::format("{} has a pipe of diameter {}; allowed: at most that of this pipe, {}", quoted,
                             before.pipe_diameter, v.pipe_diameter),
                 "its particles would lie outside: start from a case with the same pipe");
}

}  // namespace

std::string predecessor_path(const std::string& file, const std::string& from) {
  return (fs::path(file).parent_path() / (from.ends_with(".toml") ? from : from + ".toml")).string();
}

std::string predecessor_name(const std::string& from) {
  const std::string name = fs::path(from).filename().string();
  return name.ends_with(".toml") ? name.substr(0, name.size() - 5) : name;
}

bool is_plain_path(const std::string& from) {
  for (std::size_t i = 0; i < from.size(); ++i) {
    const char c = from[i];
    const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
                           c == '+' || c == '.' || c == '/';
    const bool begins = i == 0 || from[i - 1] == '/';
    if (!is_letter && (c != '-' || begins)) return false;
  }
  const std::string name = predecessor_name(from);
  return !name.empty() && name[0] != '.';
}

Reading load_case(const std::string& text, const std::string& label, Report& report) {
  Reading reading = read_case(text, label, report);
  if (reading.tables.empty() && report.errors() > 0) return reading;  // not TOML at all: nothing to check
  check_applicable_keys(reading, report);
  check_sizes(reading, report);
  check_conditions(reading, report);
  check_times(reading, report);
  complete(reading);
  check_line(reading, report);
  check_geometry(reading, report);
  check_placed(reading, report);
  return reading;
}

void check_predecessor(const Reading& reading, const std::string& file, Report& report) {
  if (!reading.usable({"start.from"}) || reading.values.start_from.empty()) return;
  const Place place = reading.place("start.from");
  const std::string quoted = reading.quote("start.from"), own_name = fs::path(file).stem().string();
  std::vector<std::string> chain{own_name}, paths{file};
  std::string from = reading.values.start_from;
  while (!from.empty()) {
    const std::string path = predecessor_path(paths.back(), from), name = predecessor_name(from);
    std::error_code status;
    const bool exists = fs::exists(path, status);
    chain.push_back(name);
    if (exists && std::any_of(paths.begin(), paths.end(),
                              [&](const std::string& earlier) { return fs::equivalent(earlier, path, status); })) {
      report.error(place,
                   fmt::format("{} leads round in a circle: {}; allowed: a case that starts otherwise", quoted,
                               fmt::join(chain, " -> ")),
                   "one of these must start with an arrangement or with [[start.particle]]");
      return;
    }
    if (!exists) {
      report.error(place,
                   fmt::format("{}: there is no file {}; allowed: a case in the same folder, or a path from there",
                               quoted, path),
                   suggestion(from, path, file));
      return;
    }
    if (chain.size() == 2 && name == own_name) {
      report.error(place, fmt::format("{}: the case has the same name as this one; allowed: another name", quoted),
                   "results lie in folders by the name of the case: give one of the two files another");
      return;
    }
    Report errors(path);
    const Reading before = load_case(read_file(path), path, errors);
    if (errors.errors() > 0) {
      report.error(place,
                   fmt::format("{}: {} has {} error{} of its own; allowed: a case without", quoted, path,
                               errors.errors(), errors.errors() == 1 ? "" : "s"),
                   fmt::format("the first: {}:{}", path, errors.first_error()));
      return;
    }
    if (chain.size() == 2) check_same_particles(reading, before.values, place, report);
    paths.push_back(path);
    from = before.values.start_from;
  }
}

}  // namespace fixdem::casegen
