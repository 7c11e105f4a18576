// Means of what has been sampled, and how much it scatters. Values that are not finite are left out; what nothing is
// known of is not a number.
#pragma once

#include <cmath>
#include <limits>
#include <vector>

namespace fixdem::program {

/// Sum and weight of what is averaged; no value without items.
struct Mean {
  double sum = 0, weight = 0;
  void add(double value, double w = 1) {
    if (std::isfinite(value)) sum += value, weight += w;
  }
  double value() const { return weight > 0 ? sum / weight : std::numeric_limits<double>::quiet_NaN(); }
  template <class Archive>
  void transfer(Archive& archive) {
    archive(sum, weight);
  }
};

/// Mean, and standard deviation of single values about it; that of fewer than two values is not known.
struct Figure {
  double mean, deviation;
};
inline Figure figure_of(const std::vector<double>& values) {
  Mean mean, square;
  for (const double value : values) mean.add(value);
  for (const double value : values) square.add((value - mean.value()) * (value - mean.value()));
  if (square.weight > 0) square.weight -= 1;
  return {mean.value(), std::sqrt(square.value())};
}

}  // namespace fixdem::program
