// Sums over runs of equal particles.
#include "sizes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace fixdem::casegen {
namespace {

/// Runs of the numbers from `first` on, up to `end`.
std::vector<SizeRun> part_of(std::span<const SizeRun> runs, std::int64_t first, std::int64_t end) {
  std::vector<SizeRun> part;
  std::int64_t begin = 0;
  for (SizeRun run : runs) {
    const std::int64_t from = std::max(begin, first), to = std::min(begin + run.count, end);
    begin += run.count;
    run.count = static_cast<int>(to - from);
    if (to > from) part.push_back(run);
  }
  return part;
}

}  // namespace

std::span<const SizeRun> runs_of(const CaseValues& v, SizeRun& all) {
  if (v.has_sizes()) return v.sizes;
  all = {static_cast<int>(std::max<std::int64_t>(v.count, 1)), v.diameter, v.density, 0};
  return {&all, 1};
}

std::vector<SizeRun> runs_at_start(const CaseValues& v) {
  SizeRun all;
  return part_of(runs_of(v, all), 0, v.count);
}

std::vector<double> diameters_of(const CaseValues& v) {
  std::vector<double> diameters;
  for (const SizeRun& run : runs_at_start(v))
    diameters.insert(diameters.end(), static_cast<std::size_t>(run.count), run.diameter);
  return diameters;
}

SizeFigures figures_of(std::span<const SizeRun> runs) {
  SizeFigures figures;
  figures.smallest = figures.largest = runs.front().diameter;
  double count = 0, lengths = 0, squares = 0, cubes = 0;
  for (const auto& [number, d, density, species] : runs) {
    if (d > figures.largest) figures.reference_density = 0;
    figures.smallest = std::min(figures.smallest, d);
    figures.largest = std::max(figures.largest, d);
    if (d == figures.largest) figures.reference_density = std::max(figures.reference_density, density);
    count += number;
    lengths += number * d;
    squares += number * (d * d);
    cubes += number * (d * d * d);
  }
  figures.mean = lengths / count;
  figures.sauter = cubes / squares;
  figures.mean_volume = std::numbers::pi / 6 * cubes / count;
  return figures;
}

SizeFigures figures_of(const CaseValues& v) {
  SizeRun one;
  const std::span<const SizeRun> runs = runs_of(v, one);
  SizeFigures all = figures_of(runs);
  if (!v.is_line() || !v.has_sizes()) return all;
  const SizeFigures fed = figures_of(part_of(runs, v.count, std::numeric_limits<std::int64_t>::max()));
  all.mean = fed.mean, all.sauter = fed.sauter, all.mean_volume = fed.mean_volume;
  if (v.count > 0) all.mean_volume = std::min(all.mean_volume, figures_of(runs_at_start(v)).mean_volume);
  return all;
}

double volume_at_start(const CaseValues& v) {
  return v.count > 0 ? figures_of(runs_at_start(v)).mean_volume * static_cast<double>(v.count) : 0;
}

double most_in_pipe(const CaseValues& v, double mean_volume) {
  const double number = 0.64 * std::numbers::pi / 4 * v.pipe_diameter * v.pipe_diameter * v.pipe_length / mean_volume;
  return std::ceil(number * (1 - 1e-12));  // no whole number and one by rounding
}

std::int64_t neighbours_for(const SizeFigures& figures) {
  const double q = figures.largest / figures.smallest, c = std::sqrt(1 - 1 / ((1 + q) * (1 + q)));
  return std::min<std::int64_t>(160, static_cast<std::int64_t>(std::ceil(1.8 / (1 - c))) + 1);
}

}  // namespace fixdem::casegen
