// The gas of the kernel (kernel/gas_slices.hpp) for particles that are spread over the ranks of an MPI program.
//
// Each rank counts its own particles slice by slice; the sums of all ranks are everywhere afterwards. A rank then
// solves the slices in which its own particles are, and no others, so that a long pipe costs each rank only its part.
// Sums of velocities depend on how particles are spread, to rounding; numbers and heights do not. SI units.
#pragma once

#include <mpi.h>

#include <algorithm>
#include <array>
#include <vector>

#include "kernel/gas_slices.hpp"

namespace fixdem::beside {

template <class Case>
class SlicesOverRanks {
  static constexpr int W = native_lanes;
  static_assert(SliceArrays<Case>::padded % W == 0, "slices are worked off W at a time");

 public:
  explicit SlicesOverRanks(MPI_Comm ranks) : ranks_(ranks) {}

  void clear() {
    detail::clear_slices(slices_);
    std::fill(is_own_.begin(), is_own_.end(), false);
  }
  /// Counts a particle of this rank; one that floats is in a slice, but not of the bed. Returns the number of the
  /// slice.
  int add(const double* x, const double* v, bool floats) {
    const int s = slice_at<Case>(x[2]);
    is_own_[static_cast<std::size_t>(s / W)] = true;
    if (!floats) detail::count_in_slice(slices_, s, height_of<Case>(x), v[2]);
    return s;
  }
  /// Sums over all ranks.
  void sum() {
    constexpr int n = SliceArrays<Case>::padded;
    MPI_Allreduce(MPI_IN_PLACE, slices_.particles, n, MPI_DOUBLE, MPI_SUM, ranks_);
    MPI_Allreduce(MPI_IN_PLACE, slices_.axial_velocity_sum, n, MPI_DOUBLE, MPI_SUM, ranks_);
    MPI_Allreduce(MPI_IN_PLACE, slices_.height, n, MPI_DOUBLE, MPI_MAX, ranks_);
  }
  /// The flow in the slices of this rank's particles, or in all. Returns the maximum residual (maximum_residual is
  /// what the kernel allows); not a number if any is none.
  double solve(bool all) {
    double maximum = 0;
    for (std::size_t group = 0; group < is_own_.size(); ++group) {
      if (!all && !is_own_[group]) continue;
      const double residual =
          detail::solve_slices<Case, W>(slices_, static_cast<int>(group) * W, static_cast<int>(group + 1) * W);
      maximum = maximum >= residual || maximum != maximum ? maximum : residual;  // one that is no number stays
    }
    return maximum;
  }
  /// Force of the gas on a particle of this rank in slice s, N.
  void force_on(int s, const double* v, bool floats, double* force) const {
    force[0] = force[1] = 0;
    if (floats)
      detail::drag_on_floater<Case>(slices_.velocity_above[s], v, force);
    else
      force[2] = detail::force_in_bed(slices_, s);
  }
  /// Pa/m in every slice; after solve(true).
  std::vector<double> pressure_gradients() const {
    return {slices_.pressure_gradient, slices_.pressure_gradient + Case::slice_count};
  }
  const SliceArrays<Case>& slices() const { return slices_; }

 private:
  MPI_Comm ranks_;
  SliceArrays<Case> slices_{};
  std::vector<bool> is_own_ = std::vector<bool>(SliceArrays<Case>::padded / W);
};

}  // namespace fixdem::beside
