// What a run says of a line: the summary's `line`, how much its figures scatter, and a verdict in words.
//
// Rates, holdup and pressure are means over the samples from `statistics_from` on (by default half of the run); the
// plugs are those that count (plug_tracks.hpp) and whose front came into the followed stretch from then on, each once;
// their frequency is that of passages at the middle of the pipe (line_station.hpp). Scatter: standard deviation. A line
// is blocked when particles that are due to be fed wait for room, more of them than a second brings. SI units.
#pragma once

#include <string>
#include <vector>

#include "plug_tracks.hpp"
#include "simulation_view.hpp"

namespace fixdem::program {

/// One sample of the whole line.
struct LineSample {
  double time, inlet_pressure, holdup;  ///< s; Pa above the outlet; kg
  double asked, accepted, left_mass;    ///< kg so far
  double blocked_time;                  ///< s so far
  int passages;                         ///< at the middle so far
  template <class Archive>
  void transfer(Archive& archive) {
    archive(time, inlet_pressure, holdup, asked, accepted, left_mass, blocked_time, passages);
  }
};

struct LineResult {
  LineTotals totals{};
  double asked_rate, accepted_rate, left_rate;  ///< kg/s
  Figure holdup, inlet_pressure;
  int plugs = 0;
  Figure plug_velocity, plug_particle_velocity, plug_length, layer_ratio;
  double layer_ratio_eq41, plug_frequency;
  bool is_blocked = false;  ///< at the end
};

LineResult line_result(const CaseFacts&, const LineTotals&, const std::vector<LineSample>&,
                       const std::vector<PlugTrack>&, double duration);

/// "blocked", "flows in plugs", "flows without plugs", "fills", "empty".
const char* verdict(const LineResult&);
/// For a person, a few lines.
std::string describe_line(const LineResult&);

}  // namespace fixdem::program
