// The plugs of a line, followed one by one from sample to sample: when and where each was born, how it moved, what
// became of it; and plugs.csv, which has a row for each that has ended.
//
// A sample: the solids fraction over three slices is above 0.40 along eight particle diameters at least (of the
// largest), a gap of one slice closed. Edges, and the particles inside: as plug_analysis.hpp defines them; pressure
// drop: over the plug's slices. The layer is what lies around it, four slices next to any plug left out, up to the next
// plug, to the end of the followed stretch, or to fifty diameters; its ratio is the solids fraction there over 0.52,
// that of a packing.
//
// From sample to sample: a plug goes on as what overlaps it most, once it has been moved on as fast as its particles.
// Where two end up in one, the one that overlaps it less has merged into the other; where one becomes two, the lesser
// is born by splitting off. One that is not seen for three samples has died, or left where it was at the outlet. What
// has been seen in fewer than three samples is forgotten.
//
// Front velocity, particle velocity, length, pressure drop and layer are those of the samples in which the front was in
// the stretch where plugs are followed: from 2 feed lengths + 0.2 m (at most a quarter of the pipe) to 0.2 m (at most a
// quarter) before the outlet. Front velocity: slope of the least-squares line. A plug counts for means when it has
// twelve such samples and its front went 0.25 m between them. SI units.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "mean.hpp"
#include "plug_analysis.hpp"

namespace fixdem::program {

/// A part of the pipe.
struct Stretch {
  double begin, end;  ///< m
  bool holds(double z) const { return z >= begin && z <= end; }
};
Stretch followed_stretch(const CaseFacts&);

/// A plug in one sample.
struct SeenPlug {
  double rear = 0, front = 0;    ///< m
  double particle_velocity = 0;  ///< m/s
  double pressure_drop = 0;      ///< Pa
  double layer_ratio = 0;        ///< -
  template <class Archive>
  void transfer(Archive& archive) {
    archive(rear, front, particle_velocity, pressure_drop, layer_ratio);
  }
};
std::vector<SeenPlug> seen_plugs(const CaseFacts&, const SliceProfile&);

enum class PlugFate : int { present, left, merged, died };

struct PlugTrack {
  int number = 0;
  double born = 0, born_at = 0;  ///< s; front then, m
  int parent = -1;               ///< the plug that it has split off from
  PlugFate fate = PlugFate::present;
  int into = -1;         ///< the plug that it has merged into
  double last_time = 0;  ///< it was seen, s
  SeenPlug last;
  int seen = 0, missed = 0;  ///< samples; and since the last of them

  // In the followed stretch.
  int samples = 0;
  double first_time = 0, first_front = 0, last_front = 0;
  double time_sum = 0, front_sum = 0, time_square = 0, time_front = 0;  ///< since the first of them
  Mean particle_velocity, length, pressure_drop, layer_ratio;

  void see(const SeenPlug&, double time, const Stretch& followed);
  double path() const { return last_front - first_front; }
  double front_velocity() const;
  bool counts() const { return samples >= 12 && path() >= 0.25; }
  template <class Archive>
  void transfer(Archive& archive) {
    auto became = static_cast<int>(fate);
    archive(number, born, born_at, parent, became, into, last_time, last, seen, missed, samples, first_time,
            first_front, last_front, time_sum, front_sum, time_square, time_front, particle_velocity, length,
            pressure_drop, layer_ratio);
    fate = static_cast<PlugFate>(std::clamp(became, 0, 3));
  }
};

class PlugTracks {
 public:
  explicit PlugTracks(const CaseFacts& facts) : facts_(&facts), followed_(followed_stretch(facts)) {}

  /// The next sample. Returns the rows of the plugs that ended with it.
  std::string look(const SliceProfile&, double time);
  /// Rows of those that are there still, for the end of a run; those that are not forgotten.
  std::string rows_of_present() const;
  /// All so far: those that have ended, then those that are there.
  std::vector<PlugTrack> all() const;
  static std::string header();
  template <class Archive>
  void transfer(Archive& archive) {
    archive(ended_, present_, born_);
  }

 private:
  std::string end(std::size_t track, PlugFate, int into = -1);

  const CaseFacts* facts_;
  Stretch followed_;
  std::vector<PlugTrack> ended_, present_;
  int born_ = 0;
};

}  // namespace fixdem::program
