#include "plug_tracks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace fixdem::program {
namespace {

constexpr double least_length = 8;  // of a plug, diameters
constexpr double layer_reach = 50;  // from a plug, diameters
constexpr double packed = 0.52;     // solids fraction of a packing
constexpr int least_seen = 3;       // samples
constexpr int most_missed = 3;      // samples
constexpr const char* fates[] = {"present", "left", "merged", "died"};

struct SliceRun {
  int first, last;
};

/// Runs of plug slices that are long enough, from z = 0 on.
std::vector<SliceRun> plug_runs(const std::vector<bool>& is_plug, int least) {
  std::vector<SliceRun> runs;
  const int n = static_cast<int>(is_plug.size());
  for (int k = 0, first = 0; k <= n; ++k) {
    if (k < n && is_plug[static_cast<std::size_t>(k)]) continue;
    if (k - first >= least) runs.push_back({first, k - 1});
    first = k + 1;
  }
  return runs;
}

double overlap(const SeenPlug& a, const SeenPlug& b) { return std::min(a.front, b.front) - std::max(a.rear, b.rear); }

/// Cells of a row; what is not known is empty.
std::string cell(double value) { return std::isfinite(value) ? fmt::format(",{:.6g}", value) : ","; }
std::string cell(int number) { return number >= 0 ? fmt::format(",{}", number) : ","; }

std::string row(const PlugTrack& t) {
  std::string line = fmt::format("{}", t.number) + cell(t.born) + cell(t.born_at) + cell(t.parent);
  line += fmt::format(",{}", fates[static_cast<int>(t.fate)]) + cell(t.into) + cell(t.last_time) + cell(t.last.front);
  line += cell(t.samples) + cell(t.path()) + cell(t.front_velocity()) + cell(t.particle_velocity.value());
  line += cell(t.length.value()) + cell(t.pressure_drop.value()) + cell(t.layer_ratio.value());
  return line + (t.counts() ? ",1\n" : ",0\n");
}

}  // namespace

Stretch followed_stretch(const CaseFacts& facts) {
  const double quarter = facts.pipe_length / 4;
  return {std::min(2 * facts.line.feed_length + 0.2, quarter), facts.pipe_length - std::min(0.2, quarter)};
}

std::vector<SeenPlug> seen_plugs(const CaseFacts& facts, const SliceProfile& profile) {
  const std::vector<double> smooth = smoothed(profile);
  const double dz = profile.slice_length;
  const auto slices = [dz](double length) { return static_cast<int>(std::ceil(length / dz - 1e-9)); };
  const std::vector<SliceRun> runs =
      plug_runs(plug_slices(profile, smooth), std::max(slices(least_length * facts.diameter), 1));
  const Stretch followed = followed_stretch(facts);
  const int reach = slices(layer_reach * facts.diameter);
  const int begin = static_cast<int>(followed.begin / dz), end = static_cast<int>(followed.end / dz);
  std::vector<SeenPlug> seen;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const auto [first, last] = runs[r];
    const PlugSample measured = measure_plug(profile, smooth, first, last, 0);
    double drop = 0;
    for (int k = first; k <= last; ++k) drop += profile.pressure_gradient[static_cast<std::size_t>(k)] * dz;
    Mean layer;
    const auto add = [&](int from, int to) {
      for (int k = std::max(from, begin); k < std::min(to, end); ++k)
        layer.add(profile.solids_fraction[static_cast<std::size_t>(k)] / packed);
    };
    const int before = r > 0 ? runs[r - 1].last + 1 + layer_margin : 0;
    const int behind = r + 1 < runs.size() ? runs[r + 1].first - layer_margin : end;
    add(std::max(before, first - reach), first - layer_margin);
    add(last + 1 + layer_margin, std::min(behind, last + 1 + reach));
    seen.push_back({measured.rear, measured.front, measured.particle_velocity, drop, layer.value()});
  }
  return seen;
}

void PlugTrack::see(const SeenPlug& now, double time, const Stretch& followed) {
  last = now, last_time = time, missed = 0, ++seen;
  if (!followed.holds(now.front)) return;
  if (samples++ == 0) first_time = time, first_front = now.front;
  last_front = now.front;
  const double t = time - first_time, z = now.front - first_front;
  time_sum += t, front_sum += z, time_square += t * t, time_front += t * z;
  particle_velocity.add(now.particle_velocity);
  length.add(now.front - now.rear);
  pressure_drop.add(now.pressure_drop);
  layer_ratio.add(now.layer_ratio);
}

double PlugTrack::front_velocity() const {
  return (samples * time_front - time_sum * front_sum) / (samples * time_square - time_sum * time_sum);
}

std::string PlugTracks::header() {
  return "plug,born [s],born at [m],split off from,fate,merged into,last seen [s],last seen at [m],samples,path [m],"
         "front velocity [m/s],particle velocity [m/s],length [m],pressure drop [Pa],layer ratio,counts\n";
}

std::string PlugTracks::look(const SliceProfile& profile, double time) {
  const std::vector<SeenPlug> seen = seen_plugs(*facts_, profile);
  // What each track overlaps most, and which track has each of those.
  std::vector<int> goes_on_as(present_.size(), -1), is_of(seen.size(), -1), touched_by(seen.size(), -1);
  std::vector<double> length(seen.size(), 0), touch(seen.size(), 0);
  for (std::size_t t = 0; t < present_.size(); ++t) {
    SeenPlug there = present_[t].last;
    const double way = there.particle_velocity * (time - present_[t].last_time);
    if (std::isfinite(way)) there.rear += way, there.front += way;
    double most = 0;
    for (std::size_t k = 0; k < seen.size(); ++k) {
      const double common = overlap(there, seen[k]);
      if (common > most) most = common, goes_on_as[t] = static_cast<int>(k);
      if (common > touch[k]) touch[k] = common, touched_by[k] = present_[t].number;
    }
    if (goes_on_as[t] < 0) continue;
    const auto k = static_cast<std::size_t>(goes_on_as[t]);
    if (most > length[k]) length[k] = most, is_of[k] = static_cast<int>(t);
  }
  std::string rows;
  std::vector<PlugTrack> next;
  for (std::size_t t = 0; t < present_.size(); ++t) {
    PlugTrack& track = present_[t];
    const bool is_seen = goes_on_as[t] >= 0;
    const auto k = static_cast<std::size_t>(std::max(goes_on_as[t], 0));
    if (is_seen && is_of[k] != static_cast<int>(t)) {
      rows += end(t, PlugFate::merged, present_[static_cast<std::size_t>(is_of[k])].number);
      continue;
    }
    if (is_seen)
      track.see(seen[k], time, followed_);
    else if (++track.missed >= most_missed) {
      rows += end(t, track.last.front > followed_.end ? PlugFate::left : PlugFate::died);
      continue;
    }
    next.push_back(track);
  }
  for (std::size_t k = 0; k < seen.size(); ++k) {
    if (is_of[k] >= 0) continue;
    PlugTrack track;
    track.number = born_++, track.born = time, track.born_at = seen[k].front, track.parent = touched_by[k];
    track.see(seen[k], time, followed_);
    next.push_back(track);
  }
  present_ = std::move(next);
  return rows;
}

std::string PlugTracks::end(std::size_t t, PlugFate fate, int into) {
  if (present_[t].seen < least_seen) return "";
  ended_.push_back(present_[t]);
  ended_.back().fate = fate, ended_.back().into = into;
  return row(ended_.back());
}

std::string PlugTracks::rows_of_present() const {
  std::string rows;
  for (const PlugTrack& track : present_)
    if (track.seen >= least_seen) rows += row(track);
  return rows;
}

std::vector<PlugTrack> PlugTracks::all() const {
  std::vector<PlugTrack> list = ended_;
  list.insert(list.end(), present_.begin(), present_.end());
  return list;
}

}  // namespace fixdem::program
