// Spheres sorted into cells at least as wide as a reach, so that all within that reach are in 27 cells.
//
// Chained lists in two flat arrays; one row of cells per (x, y) along the pipe, periodic in z if the pipe is. Used when
// a start is arranged, never in a step.
#pragma once

#include <algorithm>
#include <array>
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

  /// Visits every sphere in the 27 cells around a position; a visitor that returns false ends it.
  template <class Visitor>
  void visit_near(const std::array<double, 3>& position, Visitor&& visit) const {
    const std::array<int, 3> centre = cell(position);
    // With fewer than three cells around the period, each is still visited once.
    const int low = is_periodic_ ? centre[2] - (cells_[2] > 1 ? 1 : 0) : std::max(centre[2] - 1, 0);
    const int high = is_periodic_ ? centre[2] + (cells_[2] > 2 ? 1 : 0) : std::min(centre[2] + 1, cells_[2] - 1);
    for (int z = low; z <= high; ++z)
      for (int y = std::max(centre[1] - 1, 0); y <= std::min(centre[1] + 1, cells_[1] - 1); ++y)
        for (int x = std::max(centre[0] - 1, 0); x <= std::min(centre[0] + 1, cells_[0] - 1); ++x)
          for (int i = first_[index({x, y, (z + cells_[2]) % cells_[2]})]; i >= 0;
               i = next_[static_cast<std::size_t>(i)])
            if (!visit(i)) return;
  }

 private:
  static int cells_in(double width, double reach) { return std::clamp(static_cast<int>(width / reach), 1, 1 << 20); }

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

}  // namespace fixdem::program
