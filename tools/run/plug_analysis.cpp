#include "plug_analysis.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mean.hpp"

namespace fixdem::program {
namespace {

constexpr int velocity_margin = 2;  // slices at each end of the plug that do not count for its particles
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

struct Run {
  int first = 0, count = 0;
};

/// Longest run of marked slices; on a ring it may go past the end. The first of equals.
Run longest_run(const std::vector<bool>& marked, bool is_ring) {
  const int n = static_cast<int>(marked.size());
  Run best, current;
  if (n == 0) return best;
  for (int k = 0; k < (is_ring ? 2 * n : n); ++k) {
    if (!marked[static_cast<std::size_t>(k % n)]) {
      current.count = 0;
      continue;
    }
    if (current.count++ == 0) current.first = k;
    if (current.count > best.count && current.first < n) best = current;
  }
  best.count = std::min(best.count, n);
  return best;
}

}  // namespace

SliceProfile empty_profile(const CaseFacts& facts, const std::vector<double>& pressure_gradients) {
  const auto n = static_cast<std::size_t>(facts.slice_count);
  SliceProfile profile;
  profile.slice_length = facts.pipe_length / facts.slice_count;
  profile.is_periodic = facts.is_periodic;
  profile.direction = facts.gas_velocity < 0 ? -1 : 1;
  profile.axial_momentum.assign(n, 0);
  profile.particles.assign(n, 0);
  profile.pressure_gradient = pressure_gradients;
  profile.pressure_gradient.resize(n, 0);
  return profile;
}

void count_particle(SliceProfile& profile, double z, double axial_velocity, double volume_share) {
  if (!std::isfinite(z)) return;  // only in the last frame of a run that blew up
  const double last = static_cast<double>(profile.particles.size()) - 0.5;
  const auto k = static_cast<std::size_t>(std::clamp(z / profile.slice_length, 0.0, last));
  profile.particles[k] += volume_share;
  profile.axial_momentum[k] += volume_share * axial_velocity;
}

void set_solids_fractions(SliceProfile& profile, const CaseFacts& facts) {
  const double area = 3.14159265358979324 / 4 * facts.pipe_diameter * facts.pipe_diameter;
  for (const double count : profile.particles)
    profile.solids_fraction.push_back(count * facts.solid_volume() / (area * profile.slice_length));
}

SliceProfile slice_profile(const CaseFacts& facts, const Snapshot& snapshot,
                           const std::vector<double>& pressure_gradients) {
  SliceProfile profile = empty_profile(facts, pressure_gradients);
  for (std::size_t id = 0; id < snapshot.particles.size(); ++id) {
    const Particle& p = snapshot.particles[id];
    count_particle(profile, p.position[2], p.velocity[2], facts.volume_share_of(snapshot.kind(static_cast<int>(id))));
  }
  set_solids_fractions(profile, facts);
  return profile;
}

std::vector<double> smoothed(const SliceProfile& profile) {
  const int n = static_cast<int>(profile.solids_fraction.size());
  std::vector<double> out;
  for (int k = 0; k < n; ++k) {
    Mean mean;
    for (int j = k - 1; j <= k + 1; ++j)
      if (profile.is_periodic || (j >= 0 && j < n))
        mean.add(profile.solids_fraction[static_cast<std::size_t>((j + n) % n)]);
    out.push_back(mean.value());
  }
  return out;
}

std::vector<bool> plug_slices(const SliceProfile& profile, const std::vector<double>& smooth) {
  const int n = static_cast<int>(smooth.size());
  const auto slice = [n](int k) { return static_cast<std::size_t>((k + n) % n); };
  std::vector<bool> above(smooth.size()), marked;
  for (std::size_t k = 0; k < smooth.size(); ++k) above[k] = smooth[k] > plug_threshold;
  marked = above;
  for (int k = 0; k < n; ++k)
    if (profile.is_periodic || (k > 0 && k < n - 1))
      if (above[slice(k - 1)] && above[slice(k + 1)]) marked[slice(k)] = true;
  return marked;
}

PlugSample measure_plug(const SliceProfile& profile, const std::vector<double>& smooth, int first, int last,
                        double time) {
  const int n = static_cast<int>(smooth.size());
  const auto slice = [n](int k) { return static_cast<std::size_t>(((k % n) + n) % n); };
  // From the centre of the last slice above the threshold towards the first one below it, or to a closed end.
  const auto edge = [&](int inside, int outside) {
    if (!profile.is_periodic && (outside < 0 || outside >= n)) return outside < 0 ? 0.0 : n * profile.slice_length;
    const double a = smooth[slice(inside)], b = smooth[slice(outside)];
    return (inside + 0.5 + (outside - inside) * (a - plug_threshold) / (a - b)) * profile.slice_length;
  };
  const double low = edge(first, first - 1), high = edge(last, last + 1);
  const double pipe_length = n * profile.slice_length;
  const auto wrap = [&](double z) { return profile.is_periodic ? z - std::floor(z / pipe_length) * pipe_length : z; };
  PlugSample sample{};
  sample.found = true, sample.time = time;
  sample.front = wrap(profile.direction > 0 ? high : low);
  sample.rear = wrap(profile.direction > 0 ? low : high);
  sample.length = high - low;
  Mean velocity, gradient;
  for (int k = first + velocity_margin; k <= last - velocity_margin; ++k) {
    velocity.add(profile.axial_momentum[slice(k)], profile.particles[slice(k)]);
    gradient.add(profile.pressure_gradient[slice(k)]);
  }
  sample.particle_velocity = velocity.value();
  sample.pressure_gradient = gradient.value();
  sample.layer_area_ratio = nan;
  return sample;
}

double layer_ratio_eq41(double particle_velocity, double gravity, double pipe_diameter) {
  return gravity > 0 ? 1 / (1 + 1.84 * particle_velocity / std::sqrt(gravity * pipe_diameter)) : nan;
}

PlugSample find_plug(const SliceProfile& profile, double time) {
  double pressure_drop = 0;
  for (double gradient : profile.pressure_gradient) pressure_drop += gradient * profile.slice_length;
  const int n = static_cast<int>(profile.solids_fraction.size());
  const std::vector<double> smooth = smoothed(profile);
  const Run run = longest_run(plug_slices(profile, smooth), profile.is_periodic);
  if (run.count == 0 || run.count == n) return {false, time, nan, nan, nan, nan, nan, nan, pressure_drop};
  const int last = run.first + run.count - 1;
  PlugSample sample = measure_plug(profile, smooth, run.first, last, time);
  sample.pressure_drop = pressure_drop;

  Mean inside, outside;
  const auto add = [&](Mean& mean, int begin, int end) {
    for (int k = begin; k < end; ++k) mean.add(profile.solids_fraction[static_cast<std::size_t>(k % n)]);
  };
  add(inside, run.first, last + 1);
  // Round the ring from one edge to the other; in a closed pipe each side on its own.
  if (!profile.is_periodic) add(outside, 0, run.first - layer_margin);
  add(outside, last + 1 + layer_margin, profile.is_periodic ? run.first + n - layer_margin : n);
  sample.layer_area_ratio = outside.value() / inside.value();
  return sample;
}

PlugResult PlugRecord::result(double duration, double gravity, double pipe_diameter) const {
  PlugResult result{};
  result.front_velocity = nan;
  Mean velocity, length, ratio, gradient, drop;
  std::vector<double> times, fronts;
  double unwrapped = nan;
  for (const PlugSample& sample : samples_) {
    if (sample.found)  // the image of the front nearest to the one before
      unwrapped = std::isfinite(unwrapped)
                      ? sample.front + pipe_length_ * std::round((unwrapped - sample.front) / pipe_length_)
                      : sample.front;
    // A millionth of slack: sample times are whole numbers of steps.
    if (sample.time < 0.5 * duration * (1 - 1e-6)) continue;
    ++result.samples;
    drop.add(sample.pressure_drop);
    if (!sample.found) continue;
    ++result.samples_with_plug;
    times.push_back(sample.time);
    fronts.push_back(unwrapped);
    velocity.add(sample.particle_velocity);
    length.add(sample.length);
    ratio.add(sample.layer_area_ratio);
    gradient.add(sample.pressure_gradient);
  }
  result.pressure_drop = drop.value();
  const bool enough = result.samples_with_plug >= 3 && 2 * result.samples_with_plug >= result.samples;
  if (!enough) velocity = length = ratio = gradient = Mean{};
  result.particle_velocity = velocity.value();
  result.length = length.value();
  result.layer_area_ratio = ratio.value();
  result.pressure_gradient = gradient.value();
  result.layer_area_ratio_eq41 = layer_ratio_eq41(result.particle_velocity, gravity, pipe_diameter);
  if (!enough) return result;

  Mean time, front;
  for (std::size_t k = 0; k < times.size(); ++k) time.add(times[k]), front.add(fronts[k]);
  double numerator = 0, denominator = 0;
  for (std::size_t k = 0; k < times.size(); ++k) {
    numerator += (times[k] - time.value()) * (fronts[k] - front.value());
    denominator += (times[k] - time.value()) * (times[k] - time.value());
  }
  if (denominator > 0) result.front_velocity = numerator / denominator;
  return result;
}

}  // namespace fixdem::program
