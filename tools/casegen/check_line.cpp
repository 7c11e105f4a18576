// What an open pipe needs that is fed: a feed table, a wall, room for particles, a feed section. Stations along a pipe.
#include <fmt/format.h>

#include <algorithm>

#include "checks.hpp"
#include "schema.hpp"
#include "sizes.hpp"

namespace fixdem::casegen {
namespace {

/// As many as are there at the start, and not more than can ever be there; every one takes memory.
void check_capacity(Reading& reading, Report& report) {
  const CaseValues& v = reading.values;
  const std::string key = "particles.capacity";
  if (!reading.usable({key, "particles.count", "particles.diameter", "pipe.diameter", "pipe.length"})) return;
  const bool is_given = reading.has(key);
  const double most = most_in_pipe(v, figures_of(v).mean_volume);
  if (!is_given && v.capacity > most_particles) {
    report.error(reading.place("pipe.length"),
                 fmt::format("{}: the pipe can hold {:.4g} particles; allowed: {}", reading.quote("pipe.length"), most,
                             most_particles),
                 "give [particles] capacity, the most that are in it at once, or lower [pipe] length");
    reading.unusable.insert(key);
  } else if (v.capacity < v.count) {
    report.error(reading.place(key),
                 fmt::format("{} is below the number of particles at the start; allowed: at least {}",
                             reading.quote(key), v.count),
                 find_key("particles", "capacity")->advice);
    reading.unusable.insert(key);
  } else if (is_given && static_cast<double>(v.capacity) > std::max(most, static_cast<double>(v.count))) {
    report.warning(reading.place(key),
                   fmt::format("{} is more than the pipe can hold, about {:.0f} particles", reading.quote(key), most),
                   "leave it out: room that is never used costs memory");
  }
}

void check_feed(const Reading& reading, Report& report) {
  const CaseValues& v = reading.values;
  const char *length = "feed.length", *mixture = "feed.mixture";
  if (reading.has(mixture) && reading.usable({mixture}) && !reading.tables.contains("particles.species"))
    report.error(reading.place(mixture),
                 fmt::format("{} without [[particles.species]]; allowed: only with them", reading.quote(mixture)),
                 "remove it: there is one kind of particles to be fed");
  if (!reading.has(length) || !reading.usable({length, "particles.diameter", "pipe.length"})) return;
  const double shortest = 2 * figures_of(v).largest;
  if (v.feed_length < shortest || v.feed_length > v.pipe_length)
    report.error(reading.place(length),
                 fmt::format("{}; allowed: from two {}particle diameters = {:.6g} to the length of the pipe = {:.6g}",
                             reading.quote(length), v.has_sizes() ? "of the largest " : "", shortest, v.pipe_length),
                 find_key("feed", "length")->advice);
}

void check_probes(const Reading& reading, Report& report) {
  const CaseValues& v = reading.values;
  if (!reading.usable({"pipe.ends", "pipe.length", "probe"}) || v.probes.empty()) return;
  if (!v.is_line()) {
    report.error(reading.tables.at("probe"),
                 fmt::format("[[probe]] with [pipe] ends = \"{}\"; allowed: only with \"open\"", v.ends),
                 "remove it, which would do nothing: stations are for lines");
    return;
  }
  for (std::size_t k = 0; k < v.probes.size(); ++k) {
    const std::string key = fmt::format("probe.{}.position", k);
    if (reading.usable({key}) && v.probes[k].position > v.pipe_length)
      report.error(
          reading.place(key),
          fmt::format("{} is outside the pipe; allowed: 0 to [pipe] length = {}", reading.quote(key), v.pipe_length),
          "in metres from the inlet at z = 0");
  }
  if (v.probes.size() > longest_list)
    report.error(reading.tables.at(fmt::format("probe.{}", longest_list)),
                 fmt::format("{} [[probe]] tables; allowed: at most {}", v.probes.size(), longest_list),
                 "[output] slice_interval records every slice of the pipe");
}

}  // namespace

void check_feed_table(const Reading& reading, Report& report) {
  const CaseValues& v = reading.values;
  if (!reading.usable({"pipe.ends"}) || !reading.tables.contains("pipe")) return;
  const auto feed = reading.tables.find("feed");
  if (v.is_line() && feed == reading.tables.end())
    report.error(reading.place("pipe.ends"), "[pipe] ends = \"open\" without a [feed] table; allowed: with one",
                 "add [feed] with rate, in kg/s, or choose \"closed\" or \"periodic\"");
  if (!v.is_line() && feed != reading.tables.end())
    report.error(feed->second, fmt::format("[feed] with [pipe] ends = \"{}\"; allowed: only with \"open\"", v.ends),
                 "remove the table, which would do nothing, or open the pipe");
  if (v.is_line() && !v.wall && reading.usable({"pipe.wall"}) && !v.has_gas)
    report.error(reading.place("pipe.wall"), "[pipe] wall = false with ends = \"open\"; allowed: true",
                 "what is fed falls onto the pipe's wall: set wall = true");
}

void check_line(Reading& reading, Report& report) {
  if (reading.values.is_line()) check_capacity(reading, report);
  if (reading.values.is_line()) check_feed(reading, report);
  check_probes(reading, report);
}

}  // namespace fixdem::casegen
