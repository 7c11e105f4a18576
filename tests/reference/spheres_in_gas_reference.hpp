// The gas and the spheres: what each slice of the pipe sums over its bed, and the force on every sphere.
//
// The height of a bed counts upwards across the axis, whichever way that is in the pipe.
#pragma once

#include <vector>

#include "direction_reference.hpp"
#include "gas_pressure_reference.hpp"
#include "reference_state.hpp"

namespace fixdem::reference {

/// On the lower half of the wall nobody floats, and nowhere where there is no bed.
template <class Case, class Scalar>
bool may_float(const SphereState<Scalar>& s) {
  const Scalar q = std::sqrt(s.x.x() * s.x.x() + s.x.y() * s.x.y());
  const bool touches = q > Scalar(Case::pipe_diameter) / 2 - s.own.radius;
  return !has_no_bed<Case>() && !(touches && s.x.dot(upwards<Case, Scalar>()) < 0);
}

template <class Case, class Scalar>
int slice_of(const SphereState<Scalar>& s) {
  const int slice = static_cast<int>(std::floor(s.x.z() / (Scalar(Case::pipe_length) / Case::slice_count)));
  return std::clamp(slice, 0, Case::slice_count - 1);
}

/// One update of the gas before a step: the flow of each slice, and with it the force on each sphere.
template <class Case, class Scalar>
std::vector<SliceFlow<Scalar>> update_gas(std::vector<SphereState<Scalar>>& spheres, GasInPipe<Case, Scalar>& gas,
                                          long long step) {
  const Scalar largest = largest_radius<Case, Scalar>();
  const Vector<Scalar> up = upwards<Case, Scalar>();
  std::vector<BedSums<Scalar>> sums(Case::slice_count);
  for (const auto& s : spheres) {
    if (!s.is_present || s.floats) continue;
    const Scalar top = s.x.dot(up) + Scalar(Case::pipe_diameter) / 2 + s.own.radius;
    sums[slice_of<Case>(s)].add(s.own.radius / largest, s.v.z(), top);
  }
  std::vector<SliceBed<Scalar>> beds;
  for (const BedSums<Scalar>& of_slice : sums) beds.push_back(of_slice.bed());
  const std::vector<SliceFlow<Scalar>> slices = gas.update(beds, step);
  for (auto& s : spheres) {
    if (!s.is_present) continue;
    const SliceFlow<Scalar>& flow = slices[slice_of<Case>(s)];
    s.gas_force = Vector<Scalar>(0, 0, force_in_bed(flow, s.own.radius / largest));
    if (s.floats)
      s.gas_force = lone_sphere_drag<Case, Scalar>(Vector<Scalar>(0, 0, flow.velocity_above) - s.v, s.kind, flow.gas);
  }
  return slices;
}

}  // namespace fixdem::reference
