// Distances along the pipe, and the pairs of the reference that can touch soon: spares it the visit of all pairs in
// every step, without changing a bit.
//
// A list of all pairs nearer than diameter + margin (the largest diameter) is complete, for contacts, until two spheres
// can have closed the margin: as long as twice the maximum travel of any sphere since is less than it. The list keeps
// the order of pairs, so forces are summed as they would be without it. Used where the reference has many small steps
// to make.
#pragma once

#include <utility>
#include <vector>

#include "kernel/case.hpp"

namespace fixdem::reference {

/// Difference of two places along the pipe, to the nearest image.
template <class Case, class Scalar>
Scalar axial_difference(Scalar to, Scalar from) {
  const Scalar dz = to - from, length = Case::pipe_length;
  if (Case::ends != Ends::periodic) return dz;
  return dz > length / 2 ? dz - length : dz < -length / 2 ? dz + length : dz;
}

template <class Scalar>
class NearPairs {
 public:
  /// From now on; margin 0: not at all.
  void look_ahead(Scalar diameter, Scalar margin) { diameter_ = diameter, margin_ = margin, left_ = -1; }
  /// Others are there now.
  void forget() { left_ = -1; }
  /// Whether the list has all pairs nearer than this.
  bool serve(Scalar reach) const { return margin_ > 0 && reach <= diameter_; }

  /// Lists anew where the list no longer holds. `square(i, j)`: squared distance.
  template <class Square>
  void renew(int count, Square square) {
    if (left_ >= 0) return;
    pairs_.clear(), left_ = margin_;
    const Scalar reach = diameter_ + margin_;
    for (int i = 0; i < count; ++i)
      for (int j = i + 1; j < count; ++j)
        if (square(i, j) < reach * reach) pairs_.push_back({i, j});
  }
  const std::vector<std::pair<int, int>>& pairs() const { return pairs_; }

  /// All spheres have moved, none further than this.
  void move(Scalar maximum_way) { left_ -= 2 * maximum_way; }

 private:
  std::vector<std::pair<int, int>> pairs_;
  Scalar diameter_ = 0, margin_ = 0, left_ = -1;
};

}  // namespace fixdem::reference
