// Time step, duration and intervals of output against one another.
//
// Steps are counted in whole numbers that a double holds exactly, up to 9e15, as for the program's own `--duration`.
#include <fmt/format.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "checks.hpp"
#include "schema.hpp"

namespace fixdem::casegen {
namespace {

constexpr double most_steps = 9e15;

}  // namespace

void check_times(const Reading& reading, Report& report) {
  const CaseValues& v = reading.values;
  if (!reading.usable({"run.time_step", "run.duration"})) return;
  const Rule<CaseValues>& step_rule = *find_key("run", "time_step");
  if (v.duration < v.time_step && !step_rule.is_plausible(v)) {  // 5 for 5e-6: all else is a consequence
    report.error(reading.place("run.time_step"),
                 fmt::format("{} is longer than the run; allowed: at most duration = {}",
                             reading.quote("run.time_step"), v.duration),
                 step_rule.advice);
    return;
  }
  if (v.duration < v.time_step)
    report.error(reading.place("run.duration"),
                 fmt::format("{} is shorter than one step; allowed: at least time_step = {}",
                             reading.quote("run.duration"), v.time_step),
                 "raise duration or lower time_step");
  std::vector<std::pair<std::string, double>> times = {{"run.duration", v.duration},
                                                       {"output.log_interval", v.log_interval},
                                                       {"output.frame_interval", v.frame_interval},
                                                       {"output.sample_interval", v.sample_interval},
                                                       {"output.checkpoint_interval", v.checkpoint_interval},
                                                       {"output.slice_interval", v.slice_interval},
                                                       {"output.contact_interval", v.contact_interval}};
  for (std::size_t k = 0; k < v.probes.size(); ++k)
    times.emplace_back(fmt::format("probe.{}.interval", k), v.probes[k].interval);
  for (const auto& [name, time] : times) {
    if (!reading.has(name) || !reading.usable({name}) || !(time > 0) || std::isinf(time)) continue;
    const bool is_interval = name != times.front().first;
    if (is_interval && time < v.time_step)
      report.error(reading.place(name),
                   fmt::format("{} is shorter than one step; allowed: at least time_step = {}", reading.quote(name),
                               v.time_step),
                   "raise the interval or lower time_step");
    if (time / v.time_step >= most_steps)
      report.error(reading.place(name),
                   fmt::format("{} has more steps than can be counted; allowed: at most {:.0e} steps = {:.3g} s",
                               reading.quote(name), most_steps, most_steps * v.time_step),
                   is_interval ? "an interval beyond the duration gives nothing in between: lower it to the duration"
                               : "lower duration or raise time_step");
  }
  const char* from = "output.statistics_from";
  if (reading.has(from) && reading.usable({from}) && v.statistics_from >= v.duration)
    report.error(reading.place(from),
                 fmt::format("{} is not before the end; allowed: below duration = {}", reading.quote(from), v.duration),
                 find_key("output", "statistics_from")->advice);
}

}  // namespace fixdem::casegen
