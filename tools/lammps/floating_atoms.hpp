// Which of the atoms that a rank owns float: those without another centre within 1.1 d that do not touch the lower half
// of the pipe's wall (kernel/floaters.hpp).
//
// LAMMPS gives every rank its own atoms and, behind them, ghosts: copies of those of its neighbours and across the
// periodic ends, at their present places. All within 1.1 d must be among them (`comm_modify cutoff`,
// scene_files.py). Atoms are sorted along the pipe and compared with those whose z is within reach.
#pragma once

#include <algorithm>
#include <vector>

#include "kernel/floaters.hpp"

namespace fixdem::beside {

template <class Case>
class FloatingAtoms {
 public:
  /// x: places of `owned` atoms, then of ghosts, `all` together. floats(i, whether) is called for every owned atom.
  template <class Result>
  void find(const double* const* x, int owned, int all, Result&& floats) {
    order_.clear();
    for (int i = 0; i < all; ++i) order_.push_back({x[i][2], i});
    std::sort(order_.begin(), order_.end());
    for (std::size_t k = 0; k < order_.size(); ++k) {
      const int i = order_[k].second;
      if (i < owned) floats(i, !is_on_bottom<Case>(x[i][0], x[i][1]) && !has_company(x, k));
    }
  }

 private:
  static constexpr double reach = near_reach * Case::diameter;

  /// Whether some centre within reach comes before or after place k in the order.
  bool has_company(const double* const* x, std::size_t k) const {
    const double* a = x[order_[k].second];
    const auto is_near = [&](int j) {
      const double dx = x[j][0] - a[0], dy = x[j][1] - a[1], dz = x[j][2] - a[2];
      return dx * dx + dy * dy + dz * dz < reach * reach;
    };
    for (std::size_t j = k + 1; j < order_.size() && order_[j].first - a[2] < reach; ++j)
      if (is_near(order_[j].second)) return true;
    for (std::size_t j = k; j-- > 0 && a[2] - order_[j].first < reach;)
      if (is_near(order_[j].second)) return true;
    return false;
  }

  std::vector<std::pair<double, int>> order_;  ///< z and number of every atom
};

}  // namespace fixdem::beside
