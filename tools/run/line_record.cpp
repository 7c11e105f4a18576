#include "line_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "failure.hpp"

namespace fixdem::program {
namespace {

std::string probe_file(std::size_t number) { return fmt::format("probe_{}.csv", number); }

void check_balance(const LineTotals& t, const Snapshot& snapshot) {
  const auto seen = static_cast<long long>(snapshot.particles.size());
  if (t.at_start + t.fed == t.present + t.left && t.present == seen) return;
  throw Failure(exit_unstable,
                fmt::format("at {:.6g} s particles do not add up: {} at the start and {} fed, but {} present (of which "
                            "{} can be seen) and {} left\n  this is a fault of fixdem, not of the case: please report "
                            "it together with the case file",
                            snapshot.time, t.at_start, t.fed, t.present, seen, t.left));
}

}  // namespace

LineRecord::LineRecord(const CaseFacts& facts)
    : facts_(&facts),
      slice_schedule_(facts.line.slice_interval, facts.time_step),
      sample_schedule_(facts.sample_interval, facts.time_step),
      middle_(facts.pipe_length / 2),
      tracks_(facts) {
  for (int k = 0; k < facts.line.probe_count; ++k) {
    const Probe& probe = facts.line.probes[k];
    probed_.push_back({Station(probe.position), Schedule(probe.interval, facts.time_step)});
  }
}

void LineRecord::advance(long long step) {
  slice_schedule_.advance(step), sample_schedule_.advance(step);
  for (Probed& probed : probed_) probed.schedule.advance(step);
}

std::vector<std::pair<std::string, std::string>> LineRecord::files(const CaseFacts& facts) {
  std::vector<std::pair<std::string, std::string>> list;
  if (!facts.line.is_open) return list;
  list.emplace_back("plugs.csv", PlugTracks::header());
  if (facts.line.slice_interval > 0) list.emplace_back("slices.bin", slices_header(facts));
  for (int k = 0; k < facts.line.probe_count; ++k)
    list.emplace_back(probe_file(static_cast<std::size_t>(k)), Station::header());
  return list;
}

long long LineRecord::next() const {
  long long next = std::min(slice_schedule_.next(), sample_schedule_.next());
  for (const Probed& probed : probed_) next = std::min(next, probed.schedule.next());
  return next;
}

void LineRecord::look(const SimulationView& view, const Snapshot& snapshot, const Append& append) {
  const long long step = snapshot.step;
  const LineSlices slices = line_slices(*facts_, view, snapshot);
  const LineTotals totals = view.line();
  if (slice_schedule_.is_due(step)) append("slices.bin", encode_slices(slices));
  for (std::size_t k = 0; k < probed_.size(); ++k) {
    if (!probed_[k].schedule.is_due(step)) continue;
    probed_[k].station.look(slices);
    append(probe_file(k), probed_[k].station.row(*facts_, snapshot, slices, totals));
  }
  if (sample_schedule_.is_due(step)) {
    middle_.look(slices);
    if (const std::string rows = tracks_.look(slices.profile, snapshot.time); !rows.empty()) append("plugs.csv", rows);
    samples_.push_back({snapshot.time, slices.inlet_pressure(), mass_from(*facts_, snapshot, -INFINITY), totals.asked,
                        totals.accepted, totals.left_mass, totals.blocked_time, middle_.passages().count()});
  }
  advance(step);
}

LineRow LineRecord::row(const SimulationView& view, const Snapshot& snapshot) {
  LineRow row;
  row.totals = view.line();
  check_balance(row.totals, snapshot);
  const double time = snapshot.time - row_time_;  // no rate at the start
  row.asked_rate = (row.totals.asked - asked_) / time, row.accepted_rate = (row.totals.accepted - accepted_) / time;
  row.left_rate = (row.totals.left_mass - left_mass_) / time;
  row.holdup = mass_from(*facts_, snapshot, -INFINITY);
  row_time_ = snapshot.time, asked_ = row.totals.asked, accepted_ = row.totals.accepted;
  left_mass_ = row.totals.left_mass;
  return row;
}

void LineRecord::end(const Append& append) const {
  if (const std::string rows = tracks_.rows_of_present(); !rows.empty()) append("plugs.csv", rows);
}

}  // namespace fixdem::program
