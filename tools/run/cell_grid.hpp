// Spheres sorted into cells at least as wide as a reach, so that all within that reach are in 27 cells; and grids of
// cells for spheres of several sizes.
//
// Chained lists in two flat arrays; one row of cells per (x, y) along the pipe, periodic in z if the pipe is. Used when
// a start is arranged, never in a step.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace fixdem::program {

class CellGrid {
 public:
  CellGrid(double pipe_diameter, double pipe_length, bool is_periodic, double reach)
      : half_width_(pipe_diameter / 2),
        is_periodic_(is_periodic),
        cells_{cells_in(pipe_diameter, reach), cells_in(pipe_diameter, reach), cells_in(pipe_length, reach)},
        size_{pipe_diameter / cells_[0], pipe_diameter / cells_[1], pipe_length / cells_[2]},
        first_(static_cast<std::size_t>(cells_[0]) * static_cast<std::size_t>(cells_[1]) *
                   static_cast<std::size_t>(cells_[2]),
               -1) {}

  void clear() {
    std::fill(first_.begin(), first_.end(), -1);
    next_.clear();
  }

  /// Adds the sphere with the next number.
  void add(const std::array<double, 3>& position) {
    int& first = first_[index(cell(position))];
    next_.push_back(first);
    first = static_cast<int>(next_.size()) - 1;
  }

  /// Visits every sphere in the cells within `reach` of a position, the 27 around it at least; a visitor that returns
  /// false ends it. Whether none has.
  template <class Visitor>
  bool visit_near(const std::array<double, 3>& position, double reach, Visitor&& visit) const {
    const std::array<int, 3> centre = cell(position),
                             span = {cells_within(reach, 0), cells_within(reach, 1), cells_within(reach, 2)};
    // Where there are fewer cells around the period, each is still visited once.
    const int around = std::min(2 * span[2] + 1, cells_[2]);
    const int low = is_periodic_ ? centre[2] - around / 2 : std::max(centre[2] - span[2], 0);
    const int high = is_periodic_ ? low + around - 1 : std::min(centre[2] + span[2], cells_[2] - 1);
    for (int z = low; z <= high; ++z)
      for (int y = std::max(centre[1] - span[1], 0); y <= std::min(centre[1] + span[1], cells_[1] - 1); ++y)
        for (int x = std::max(centre[0] - span[0], 0); x <= std::min(centre[0] + span[0], cells_[0] - 1); ++x)
          for (int i = first_[index({x, y, (z + cells_[2]) % cells_[2]})]; i >= 0;
               i = next_[static_cast<std::size_t>(i)])
            if (!visit(i)) return false;
    return true;
  }

 private:
  static int cells_in(double width, double reach) { return std::clamp(static_cast<int>(width / reach), 1, 1 << 20); }

  /// How many cells a reach goes beyond the cell of its middle; rounding does not make it one more.
  int cells_within(double reach, std::size_t axis) const {
    return std::max(1, static_cast<int>(std::ceil(reach / size_[axis] - 1e-9)));
  }
  std::array<int, 3> cell(const std::array<double, 3>& p) const {
    const double corner[3] = {p[0] + half_width_, p[1] + half_width_, p[2]};
    std::array<int, 3> c;
    for (std::size_t k = 0; k < 3; ++k) c[k] = std::clamp(static_cast<int>(corner[k] / size_[k]), 0, cells_[k] - 1);
    return c;
  }
  std::size_t index(const std::array<int, 3>& c) const {
    return (static_cast<std::size_t>(c[0]) * static_cast<std::size_t>(cells_[1]) + static_cast<std::size_t>(c[1])) *
               static_cast<std::size_t>(cells_[2]) +
           static_cast<std::size_t>(c[2]);
  }

  double half_width_;
  bool is_periodic_;
  std::array<int, 3> cells_;
  std::array<double, 3> size_;
  std::vector<int> first_, next_;
};

/// Spheres numbered from the largest to the smallest, in one grid for each factor of two in diameter: a small one need
/// not look at all others in a cell as wide as the largest, and a large one looks into as many small cells as it
/// covers.
class SizedGrids {
 public:
  /// `diameters` of the spheres that are going to be added; pairs are looked for up to `spacing` sums of radii.
  SizedGrids(double pipe_diameter, double pipe_length, bool is_periodic, const std::vector<double>& diameters,
             double spacing)
      : spacing_(spacing) {
    int number = 0;
    for (const double diameter : diameters) {
      if (levels_.empty() || diameter < levels_.back().diameter / 2)
        levels_.push_back({number, diameter, {pipe_diameter, pipe_length, is_periodic, spacing * diameter}});
      ++number;
    }
  }

  void clear() {
    for (Level& level : levels_) level.cells.clear();
    count_ = 0;
  }
  /// Adds the sphere with the next number.
  void add(const std::array<double, 3>& position) { levels_[level_of(count_++)].cells.add(position); }

  /// Visits the spheres near the place of sphere i that may be larger, or smaller; some of about its size with both.
  template <class Visitor>
  void visit_larger(int i, double radius, const std::array<double, 3>& position, Visitor&& visit) const {
    for (std::size_t k = 0; k <= level_of(i); ++k)
      if (!visit_level(levels_[k], radius, position, visit)) return;
  }
  template <class Visitor>
  void visit_smaller(int i, double radius, const std::array<double, 3>& position, Visitor&& visit) const {
    for (std::size_t k = level_of(i); k < levels_.size(); ++k)
      if (!visit_level(levels_[k], radius, position, visit)) return;
  }

 private:
  struct Level {
    int first;        ///< number of its largest sphere
    double diameter;  ///< of that
    CellGrid cells;
  };

  std::size_t level_of(int i) const {
    std::size_t k = 0;
    while (k + 1 < levels_.size() && levels_[k + 1].first <= i) ++k;
    return k;
  }
  template <class Visitor>
  bool visit_level(const Level& level, double radius, const std::array<double, 3>& position, Visitor&& visit) const {
    return level.cells.visit_near(position, spacing_ * (radius + level.diameter / 2),
                                  [&](int j) { return visit(level.first + j); });
  }

  double spacing_;
  std::vector<Level> levels_;
  int count_ = 0;
};

}  // namespace fixdem::program
