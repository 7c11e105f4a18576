// Loading of case files, and the chain of cases that start from one another.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>
#include <vector>

#include "checks.hpp"
#include "nearest_name.hpp"

namespace fixdem::casegen {
namespace {

namespace fs = std::filesystem;

/// Names of all cases in a folder, for suggestions.
std::vector<std::string> cases_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& file : fs::directory_iterator(folder.empty() ? "." : folder, ignored))
    if (file.path().extension() == ".toml") names.push_back(file.path().stem().string());
  return names;
}

/// What the first predecessor must have in common with the case itself.
void check_same_particles(const Reading& reading, const CaseValues& before, Place place, Report& report) {
  const CaseValues& v = reading.values;
  const std::string quoted = reading.quote("start.from");
  if (reading.usable({"particles.count"}) && before.count != v.count)
    report.error(place, fmt::format("{} has {} particles; allowed: as many as here, {}", quoted, before.count, v.count),
                 "start from a case of the same count, or change [particles] count");
  if (reading.usable({"particles.diameter"}) && before.diameter != v.diameter)
    report.error(place,
                 fmt::format("{} has particles of diameter {}; allowed: the same as here, {}", quoted, before.diameter,
                             v.diameter),
                 "start from a case of the same [particles] diameter");
  if (reading.usable({"pipe.diameter"}) && v.wall && before.pipe_diameter > v.pipe_diameter)
    report.error(place,
                 fmt::format("{} has a pipe of diameter {}; allowed: at most that of this pipe, {}", quoted,
                             before.pipe_diameter, v.pipe_diameter),
                 "its particles would lie outside: start from a case with the same pipe");
}

}  // namespace

std::string read_file(const std::string& path) {
  std::error_code status;
  if (fs::is_directory(path, status)) throw std::system_error(EISDIR, std::generic_category(), path);
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw std::system_error(errno != 0 ? errno : EIO, std::generic_category(), path);
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (stream.bad()) throw std::system_error(EIO, std::generic_category(), path);
  return text;
}

std::string predecessor_path(const std::string& file, const std::string& from) {
  return (fs::path(file).parent_path() / (from + ".toml")).string();
}

Reading load_case(const std::string& text, const std::string& label, Report& report) {
  Reading reading = read_case(text, label, report);
  if (reading.tables.empty() && report.errors() > 0) return reading;  // not TOML at all: nothing to check
  check_conditions(reading, report);
  complete(reading);
  check_geometry(reading, report);
  return reading;
}

void check_predecessor(const Reading& reading, const std::string& file, Report& report) {
  if (!reading.usable({"start.from"})) return;
  const Place place = reading.place("start.from");
  std::vector<std::string> chain{fs::path(file).stem().string()};
  for (std::string from = reading.values.start_from; !from.empty();) {
    const std::string path = predecessor_path(file, from);
    const bool seen = std::find(chain.begin(), chain.end(), from) != chain.end();
    chain.push_back(from);
    if (seen) {
      report.error(place,
                   fmt::format("{} leads round in a circle: {}; allowed: a case that starts otherwise",
                               reading.quote("start.from"), fmt::format("{}", fmt::join(chain, " -> "))),
                   "one of these must start with an arrangement or with [[start.particle]]");
      return;
    }
    if (!fs::exists(path)) {
      const std::string nearest = nearest_name(from, cases_in(fs::path(file).parent_path()));
      report.error(
          place,
          fmt::format("{}: there is no file {}; allowed: a case in the same folder", reading.quote("start.from"), path),
          nearest.empty() ? "write that case first" : fmt::format("did you mean \"{}\"?", nearest));
      return;
    }
    Report errors(path);
    const Reading before = load_case(read_file(path), path, errors);
    if (errors.errors() > 0) {
      report.error(place,
                   fmt::format("{}: {} has {} error{} of its own; allowed: a case without", reading.quote("start.from"),
                               path, errors.errors(), errors.errors() == 1 ? "" : "s"),
                   fmt::format("the first: {}:{}", path, errors.first_error()));
      return;
    }
    if (chain.size() == 2) check_same_particles(reading, before.values, place, report);
    from = before.values.start_from;
  }
}

}  // namespace fixdem::casegen
