#include "result_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "disk.hpp"
#include "failure.hpp"
#include "output_file.hpp"

namespace fixdem::program {
namespace {

namespace files = std::filesystem;

[[noreturn]] void fail(const char* what, const files::path& path, const std::error_code& error) {
  throw Failure(exit_input_output, fmt::format("cannot {} {}: {}", what, path.string(), error.message()));
}

/// Results in files of their own, and what other tools make of them.
constexpr const char* whole_results[] = {"log.csv",    "dump.lammpstrj", "frames.pvd",   "contacts.pvd",
                                         "slices.bin", "plugs.csv",      "final.fixdem", "summary.json",
                                         "fault.vtp",  "stopped.fixdem"};
/// Those that grow.
constexpr const char* grown_results[] = {"log.csv", "dump.lammpstrj", "slices.bin", "plugs.csv"};
constexpr const char* series[] = {"frame", "contact"};
constexpr const char* made_of_results[] = {"report.html", "movie.mp4", "movie.gif", "render.png"};

/// The number in a name like frame_000123.vtp.
std::optional<long long> number_in(std::string_view name, std::string_view begin, std::string_view end) {
  if (name.size() <= begin.size() + end.size() || !name.starts_with(begin) || !name.ends_with(end)) return std::nullopt;
  const char *first = name.data() + begin.size(), *last = name.data() + name.size() - end.size();
  long long number = 0;
  const auto [stop, error] = std::from_chars(first, last, number);
  if (error != std::errc{} || stop != last || number < 0) return std::nullopt;
  return number;
}

/// Every file of a folder whose name has such a number, with it; nothing when there is no folder.
using Numbered = std::vector<std::pair<long long, files::path>>;
Numbered numbered(const files::path& folder, std::string_view begin, std::string_view end) {
  Numbered found;
  std::error_code error;
  if (!files::exists(folder, error)) return found;
  for (const auto& entry : files::directory_iterator(folder, error))
    if (const auto number = number_in(entry.path().filename().string(), begin, end))
      found.emplace_back(*number, entry.path());
  if (error) fail("read the folder", folder, error);
  return found;
}

Numbered members(const files::path& out, const std::string& name, const char* end = ".vtp") {
  return numbered(series_folder(out, name), name + "_", end);
}
/// Stations of a line.
Numbered probes(const files::path& out) { return numbered(out, "probe_", ".csv"); }

/// Removes a folder of frames in which nothing else lies; a link to one stays for the next run.
void remove_if_empty(const files::path& folder) {
  std::error_code error;
  if (!files::is_symlink(folder, error)) files::remove(folder, error);
}

}  // namespace

files::path series_folder(const files::path& out, const std::string& name) { return out / (name + "s"); }
files::path series_list(const files::path& out, const std::string& name) { return out / (name + "s.pvd"); }
files::path member_path(const files::path& out, const std::string& name, int number) {
  return series_folder(out, name) / fmt::format("{}_{:06}.vtp", name, number);
}

files::path checkpoint_path(const files::path& out, long long step) {
  return out / fmt::format("checkpoint-{}.fixdem", step);
}

void remove_file(const files::path& path) {
  std::error_code error;
  files::remove(path, error);
  if (error) fail("replace", path, error);
}

void tidy_folder(const files::path& out, int frames, int contacts) {
  for (const char* name : {"final.fixdem", "summary.json", "fault.vtp", "stopped.fixdem"}) remove_file(out / name);
  for (const char* name : made_of_results) remove_file(out / name);
  for (const char* name : {"final.fixdem", "summary.json", "fault.vtp", "stopped.fixdem", "frames.pvd", "contacts.pvd"})
    remove_file(out / (std::string(name) + ".part"));
  for (const auto& [step, path] : numbered(out, "checkpoint-", ".fixdem.part")) remove_file(path);
  for (const auto& [name, kept] : {std::pair{"frame", frames}, std::pair{"contact", contacts}}) {
    for (const auto& [number, path] : members(out, name, ".vtp.part")) remove_file(path);
    for (const auto& [number, path] : members(out, name))
      if (number >= kept) remove_file(path);
    if (kept > 0) continue;
    remove_file(series_list(out, name));
    remove_if_empty(series_folder(out, name));  // a run that writes frames makes it again
  }
}

bool holds_results(const files::path& out) {
  std::error_code error;
  for (const char* name : whole_results)
    if (files::exists(files::symlink_status(out / name, error))) return true;
  return !checkpoints_in(out).empty() ||
         std::ranges::any_of(series, [&](const char* name) { return !members(out, name).empty(); });
}

files::path move_aside(const files::path& out) {
  std::error_code error;
  files::path from = files::canonical(out, error);
  if (error) fail("find the folder", out, error);
  files::path to;
  for (int number = 1;; ++number) {
    to = from.string() + "." + std::to_string(number);
    if (files::create_directory(to, error)) break;  // false where something has that name
    if (error && error != std::errc::file_exists) fail("make the folder", to, error);
  }
  std::vector<files::path> names;
  for (const char* name : series)
    if (!members(from, name).empty()) names.push_back(series_folder("", name));
  names.insert(names.end(), std::begin(whole_results), std::end(whole_results));
  names.insert(names.end(), std::begin(made_of_results), std::end(made_of_results));
  for (const files::path& path : checkpoints_in(from)) names.push_back(path.filename());
  for (const auto& [number, path] : probes(from)) names.push_back(path.filename());
  for (const files::path& name : names) {
    if (!files::exists(files::symlink_status(from / name, error))) continue;
    if (disk::rename((from / name).c_str(), (to / name).c_str()) != 0)
      throw Failure(exit_input_output,
                    fmt::format("cannot move {} to {}: {}", (from / name).string(), to.string(), std::strerror(errno)));
  }
  flush_folder(to);
  flush_folder(from);
  return to;
}

void prepare_folder(const files::path& out) {
  make_folder(out);
  tidy_folder(out, 0, 0);
  for (const char* name : grown_results) remove_file(out / name);
  for (const auto& [number, path] : probes(out)) remove_file(path);
  for (const files::path& path : checkpoints_in(out)) remove_file(path);
}

std::vector<files::path> checkpoints_in(const files::path& out) {
  Numbered found = numbered(out, "checkpoint-", ".fixdem");
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<files::path> paths;
  for (auto& [step, path] : found) paths.push_back(std::move(path));
  return paths;
}

}  // namespace fixdem::program
