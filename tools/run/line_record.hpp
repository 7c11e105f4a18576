// What a run records of a line while it goes: slices along the pipe, stations, plugs, and samples for the means of its
// end; and whether particles add up.
//
// Slices, stations and samples (every `sample_interval`, plugs with them) have each their own interval; an output that
// is due is made from one snapshot. All that a resumed run needs is in the checkpoint. N_0 + fed = present + left, in
// whole numbers, at every row of the log: if not, the program is wrong, and says so.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "line_result.hpp"
#include "line_station.hpp"
#include "schedule.hpp"

namespace fixdem::program {

/// Of one row of the log.
struct LineRow {
  LineTotals totals{};
  double asked_rate = 0, accepted_rate = 0, left_rate = 0;  ///< kg/s since the row before
  double holdup = 0;                                        ///< kg
};

class LineRecord {
 public:
  explicit LineRecord(const CaseFacts&);

  /// Names and first lines of the files that it fills.
  static std::vector<std::pair<std::string, std::string>> files(const CaseFacts&);
  using Append = std::function<void(const std::string& file, std::string_view record)>;

  long long next() const;
  bool is_due(long long step) const { return step >= next(); }
  /// What has been recorded at this step is not due again.
  void advance(long long step);
  /// Records what is due.
  void look(const SimulationView&, const Snapshot&, const Append&);
  /// A row of the log; throws Failure if particles do not add up.
  LineRow row(const SimulationView&, const Snapshot&);
  /// At the end of a run.
  void end(const Append&) const;
  LineResult result(const LineTotals& totals, double duration) const {
    return line_result(*facts_, totals, samples_, tracks_.all(), duration);
  }
  /// For checkpoints.
  template <class Archive>
  void transfer(Archive& archive) {
    for (Probed& probed : probed_) archive(probed.station);
    archive(middle_, tracks_, samples_, row_time_, asked_, accepted_, left_mass_);
  }

 private:
  struct Probed {
    Station station;
    Schedule schedule;
  };

  const CaseFacts* facts_;
  Schedule slice_schedule_, sample_schedule_;
  std::vector<Probed> probed_;
  Station middle_;
  PlugTracks tracks_;
  std::vector<LineSample> samples_;
  double row_time_ = 0, asked_ = 0, accepted_ = 0, left_mass_ = 0;  ///< at the last row of the log
};

}  // namespace fixdem::program
