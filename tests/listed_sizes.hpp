// What a case with several sizes is made of, written by hand: a list of particles, and all the rest.
//
// As casegen writes them such cases have no `diameter` and no `density`, so nothing compiles that takes one size for
// granted.
#pragma once

#include "kernel/case.hpp"

namespace fixdem::tests {

/// Everything but the particles: material, step and options of the shipped cases, in a short pipe.
struct short_pipe {
  static constexpr double youngs_modulus = 3e9, poisson_ratio = 0.33, restitution = 0.9, friction = 0.3;
  static constexpr double wall_youngs_modulus = 3e9, wall_poisson_ratio = 0.33;
  static constexpr NormalLaw normal = NormalLaw::hertz;
  static constexpr TangentialLaw tangential = TangentialLaw::displacement;
  static constexpr Slider slider = Slider::clip;
  static constexpr DampingMass damping_mass = DampingMass::reduced;
  static constexpr Damping damping = Damping::restitution;
  static constexpr double normal_stiffness = 0, tangential_stiffness = 0;
  static constexpr double pipe_diameter = 0.05, pipe_length = 0.06;
  static constexpr Ends ends = Ends::periodic;
  static constexpr bool has_wall = true;
  static constexpr bool has_gas = false;
  static constexpr double gas_velocity = 0, gas_density = 0, gas_viscosity = 0, gas_bed_diameter = 0;
  static constexpr int gas_update_interval = 1, gas_floater_interval = 1;
  static constexpr BedHeight gas_bed_height = BedHeight::continuous;
  static constexpr int slice_count = 6;
  static constexpr double gravity[3] = {0, -9.81, 0};
  static constexpr double time_step = 2e-6;
  static constexpr Integrator integrator = Integrator::euler;
  static constexpr Precision precision = Precision::double_precision;
  static constexpr double max_overlap = 0.5;
  static constexpr int neighbour_capacity = 33;
  static constexpr bool energy_ledger = true;
};

/// A case of the sizes in `Particles` and of all else in `Rest`; what follows from a list of sizes is reckoned here.
template <class Particles, class Rest>
struct sized : Particles, Rest {
  template <class F>
  static constexpr double over_runs(double first, F f) {
    double result = first;
    for (const SizeRun& run : Particles::sizes) result = f(result, run);
    return result;
  }
  static constexpr int particle_count =
      static_cast<int>(over_runs(0, [](double sum, const SizeRun& run) { return sum + run.count; }));
  static constexpr double largest_diameter =
      over_runs(0, [](double d, const SizeRun& run) { return run.diameter > d ? run.diameter : d; });
  static constexpr double smallest_diameter =
      over_runs(largest_diameter, [](double d, const SizeRun& run) { return run.diameter < d ? run.diameter : d; });
  static constexpr double reference_density = over_runs(0, [](double density, const SizeRun& run) {
    return run.diameter == largest_diameter && run.density > density ? run.density : density;
  });
  static constexpr double mean_volume = over_runs(0, [](double sum, const SizeRun& run) {
    return sum + run.count * 3.14159265358979323846 / 6 * run.diameter * run.diameter * run.diameter / particle_count;
  });
};

}  // namespace fixdem::tests
