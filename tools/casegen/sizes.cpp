// Sums over runs of equal particles.
#include "sizes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fixdem::casegen {

std::span<const SizeRun> runs_of(const CaseValues& v, SizeRun& all) {
  if (v.has_sizes()) return v.sizes;
  all = {static_cast<int>(v.count), v.diameter, v.density, 0};
  return {&all, 1};
}

std::vector<double> diameters_of(const CaseValues& v) {
  std::vector<double> diameters;
  SizeRun all;
  for (const SizeRun& run : runs_of(v, all))
    diameters.insert(diameters.end(), static_cast<std::size_t>(run.count), run.diameter);
  return diameters;
}

SizeFigures figures_of(const CaseValues& v) {
  SizeRun all;
  const std::span<const SizeRun> runs = runs_of(v, all);
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
  figures.volume = std::numbers::pi / 6 * cubes;
  return figures;
}

std::int64_t neighbours_for(const SizeFigures& figures) {
  const double q = figures.largest / figures.smallest, c = std::sqrt(1 - 1 / ((1 + q) * (1 + q)));
  return std::min<std::int64_t>(160, static_cast<std::int64_t>(std::ceil(1.8 / (1 - c))) + 1);
}

}  // namespace fixdem::casegen
