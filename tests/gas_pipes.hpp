// Pipes whose slices are filled by hand, with beds instead of particles, for the kernel and for the reference.
//
// The air of the compressible ones has 1.2 kg/m3 and 1.5e-5 m2/s at the outlet, at 1 bar; updates are 0.3 ms apart.
#pragma once

#include <memory>

#include "cases/plug_u24.hpp"
#include "kernel/gas_slices.hpp"
#include "reference/gas_pressure_reference.hpp"
#include "support.hpp"

namespace fixdem::tests {

using Bed = reference::SliceBed<double>;

/// Puts a bed of equal particles into a slice of the kernel.
template <class Case>
void fill(SliceArrays<Case>& gas, int slice, const Bed& bed) {
  gas.particles[slice] = bed.count;
  gas.axial_velocity_sum[slice] = bed.count * bed.velocity;
  gas.height[slice] = bed.count > 0 ? bed.top : 0;
}

/// One slice of the kernel with the given bed.
template <class Case, int W>
reference::SliceFlow<double> kernel_flow(const Bed& bed) {
  static GasSlices<Case> gas;
  for (int s = 0; s < gas.padded; ++s) fill(gas, s, bed);
  const double residual = detail::solve_slices<Case, W>(gas, 0, W);
  CHECK(residual < 1e-12);
  reference::SliceFlow<double> flow;
  flow.pressure_gradient = gas.pressure_gradient[0];
  flow.bed_area = gas.bed_area[0];
  flow.void_fraction = gas.void_fraction[0];
  flow.velocity_above = gas.velocity_above[0];
  flow.velocity_in_bed = gas.velocity_in_bed[0];
  return flow;
}

/// Against what the reference finds in a slice.
inline void check_same_flow(const reference::SliceFlow<double>& found, const reference::SliceFlow<double>& expected) {
  CHECK(found.bed_area == doctest::Approx(expected.bed_area).epsilon(1e-11).scale(1e-4));
  CHECK(found.void_fraction == doctest::Approx(expected.void_fraction).epsilon(1e-11));
  // The gradient of a bed that moves almost with the gas is a difference: absolute floor 1e-9 Pa/m.
  CHECK(std::abs(found.pressure_gradient - expected.pressure_gradient) <=
        1e-10 * std::abs(expected.pressure_gradient) + 1e-9);
  CHECK(found.velocity_above == doctest::Approx(expected.velocity_above).epsilon(1e-10));
  if (expected.bed_area > 0) CHECK(found.velocity_in_bed == doctest::Approx(expected.velocity_in_bed).epsilon(1e-10));
}

/// A closed pipe with air that is compressed; `milli`: bulk velocity at 1 bar in mm/s.
template <int metres, int slices, int milli = 2400>
struct air_line : cases::plug_u24 {
  static constexpr const char* name = "a line with compressible air";
  static constexpr Ends ends = Ends::closed;
  static constexpr double pipe_length = metres, gas_velocity = milli / 1000.0;
  static constexpr int slice_count = slices, gas_update_interval = 5;
  static constexpr double time_step = 6e-5;
  static constexpr bool gas_compressible = true;
  static constexpr double gas_outlet_pressure = 1e5, gas_temperature = 293.15;
  static constexpr double gas_constant = gas_outlet_pressure / (gas_density * gas_temperature);
};
template <class Line>
struct storing : Line {
  static constexpr bool gas_storage = true;
};
/// A given inlet pressure, and a blower; tests set them.
template <class Line>
struct with_inlet_pressure : Line {
  static inline double gas_inlet_pressure = 1.05e5;
};
template <class Line>
struct with_blower : Line {
  static inline double gas_blower_flow = 8e-3, gas_blower_pressure = 2e4;
};

/// A line of the kernel.
template <class Case, int W = native_lanes>
class AirInPipe {
 public:
  void put(int slice, const Bed& bed) { fill(*gas_, slice, bed); }
  void put_everywhere(const Bed& bed) {
    for (int s = 0; s < Case::slice_count; ++s) put(s, bed);
  }
  /// The residual; the first update finds the steady state.
  double update(double bulk_velocity = Case::gas_velocity) {
    const double residual = detail::solve_pressures<Case, W>(*gas_, bulk_velocity, updates_ == 0);
    ++updates_;
    return residual;
  }
  void settle(int updates, double bulk_velocity = Case::gas_velocity) {
    double worst = 0;
    for (int k = 0; k < updates; ++k) {
      const double residual = update(bulk_velocity);
      worst = worst >= residual || worst != worst ? worst : residual;  // a NaN is kept
    }
    REQUIRE(worst < maximum_residual);
  }
  const SliceArrays<Case>& gas() const { return *gas_; }
  double inlet() const { return pressure_at_node(gas(), 0); }           ///< Pa above the outlet
  double flow(int slice) const { return gas_->pressures.flow[slice]; }  ///< p U, Pa m/s

 private:
  std::unique_ptr<SliceArrays<Case>> gas_ = std::make_unique<SliceArrays<Case>>();
  int updates_ = 0;
};

/// Beds that fill a share of the pipe's slices, each as long as a slice: `number` per 10 mm.
template <class Case>
Bed bed_of_slice(double number, double velocity, double top) {
  return {number * Derived<Case>::slice_length / 0.01, velocity, top};
}
template <class Case>
Bed random_bed(Random& random) {
  const double kind = random(0, 1);
  if (kind < 0.3) return {};
  if (kind < 0.6) return bed_of_slice<Case>(random(17, 20), random(0, 1), Case::pipe_diameter);
  return bed_of_slice<Case>(random(1, 12), random(-0.2, 0.5), random(0.012, 0.04));
}

}  // namespace fixdem::tests
