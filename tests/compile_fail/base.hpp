// Cases written by hand that compile; each file beside this one derives from one, spoils a value, and must be
// refused by the compiler with the message in its `// expected:` line. tests/compile_fail/run.sh compiles them.
#pragma once

#include "kernel/fixdem.hpp"

namespace fixdem::compile_fail {

/// All but the particles.
struct Rest {
  static constexpr double youngs_modulus = 3e9, poisson_ratio = 0.33, restitution = 0.9, friction = 0.3;
  static constexpr double wall_youngs_modulus = 3e9, wall_poisson_ratio = 0.33;
  static constexpr auto normal = NormalLaw::hertz;
  static constexpr auto tangential = TangentialLaw::displacement;
  static constexpr auto slider = Slider::clip;
  static constexpr auto damping_mass = DampingMass::reduced;
  static constexpr auto damping = Damping::restitution;
  static constexpr double normal_stiffness = 0, tangential_stiffness = 0;
  static constexpr double pipe_diameter = 0.05, pipe_length = 0.2;
  static constexpr auto ends = Ends::periodic;
  static constexpr bool has_wall = true;
  static constexpr bool has_gas = false;
  static constexpr double gas_velocity = 0, gas_density = 0, gas_viscosity = 0, gas_bed_diameter = 0;
  static constexpr int gas_update_interval = 1, gas_floater_interval = 1;
  static constexpr auto gas_bed_height = BedHeight::continuous;
  static constexpr int slice_count = 20;
  static constexpr double gravity[3] = {0, -9.81, 0};
  static constexpr double time_step = 2e-6;
  static constexpr auto integrator = Integrator::euler;
  static constexpr auto precision = Precision::double_precision;
  static constexpr double max_overlap = 0.5;
  static constexpr int neighbour_capacity = 14;
  static constexpr bool energy_ledger = true;
};

struct Base : Rest {
  static constexpr int particle_count = 8;
  static constexpr double diameter = 0.01, density = 1000;
};

/// The same with two sizes; it has no one diameter and density.
struct Sizes : Rest {
  static constexpr int particle_count = 8;
  static constexpr double largest_diameter = 0.01, smallest_diameter = 0.005, reference_density = 1000;
  static constexpr double mean_volume = 3.14159265358979323846 / 6 * (2 * 1e-6 + 6 * 1.25e-7) / 8;
  static constexpr int species_count = 2;
  static constexpr const char* species_names[] = {"large", "small"};
  static constexpr SizeRun sizes[] = {{2, 0.01, 1000, 0}, {6, 0.005, 2000, 1}};
};

/// An open line.
template <class Particles>
struct Open : Particles {
  static constexpr auto ends = Ends::open;
  static constexpr int start_count = 4;
  static constexpr TimeValue feed_rate[] = {{0, 0.1}, {1, 0.2}};
  static constexpr double feed_start = 0.5, feed_length = 0.1, feed_velocity = 0.5;
  static constexpr unsigned long long feed_seed = 1;
  static constexpr int feed_interval = 500;
};
struct Line : Open<Base> {};
struct LineOfSizes : Open<Sizes> {
  static constexpr int first_fed_kind = 4;
};

/// A line with compressible gas.
struct AirLine : Line {
  static constexpr bool has_gas = true, gas_compressible = true, gas_storage = true;
  static constexpr double gas_velocity = 10, gas_density = 1.2, gas_viscosity = 1.5e-5, gas_bed_diameter = 0.01;
  static constexpr double gas_outlet_pressure = 1e5;
};

/// What a user of a case writes; instantiating it is what must fail.
template <class Case>
int use() {
  static Simulation<Case> simulation;
  return simulation.run(1).ok() ? 0 : 1;
}

}  // namespace fixdem::compile_fail
