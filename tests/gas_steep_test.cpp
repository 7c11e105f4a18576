// The gas in a steep pipe: Ergun's law where particles are dense, Wen & Yu's where they are thin, linear in between.
#include <cmath>

#include "gas_pipes.hpp"
#include "kernel/fixdem.hpp"
#include "listed_sizes.hpp"

namespace fixdem::tests {

struct upright_two_sizes {
  static constexpr const char* name = "two sizes in a steep pipe";
  static constexpr int species_count = 2;
  static constexpr const char* species_names[] = {"large", "small"};
  static constexpr SizeRun sizes[] = {{10, 0.010, 1000, 0}, {20, 0.005, 1000, 1}};
};
struct upright_air : short_pipe {
  static constexpr bool has_gas = true;
  static constexpr double gas_velocity = 3, gas_density = 1.2, gas_viscosity = 1.5e-5;
  static constexpr double gravity[3] = {0, 0, -9.81};
};

namespace {

struct upright : cases::plug_u24 {
  static constexpr double gravity[3] = {0, 0, -9.81};
  static constexpr int slice_count = 8;  // of 100 mm: one particle leaves a void fraction of 0.997
};
struct upright_fine : upright {
  static constexpr double gas_bed_diameter = 0.003, gas_velocity = -3;
};
struct upright_sizes : sized<upright_two_sizes, upright_air> {};

/// A cloud or bed of this void fraction in a slice of the 50 mm pipe.
Bed of_void_fraction(double eps, double velocity) {
  const double slice = 3.14159265358979323846 / 4 * 0.05 * 0.05 * 0.1;
  return {(1 - eps) * slice / (3.14159265358979323846 / 6 * 1e-6), velocity, 0.05};
}

// As printed, for 10 mm in air at U = 2.4 m/s.
double ergun(double eps, double w) {
  const double re = 0.01 * w / 1.5e-5, xi = (1 - eps) / (eps * eps * eps) * (150 * (1 - eps) / re + 1.75);
  return xi * 1.2 * w * w / 0.01;
}
double wen_yu(double eps, double w) {
  const double re = 0.01 * w / 1.5e-5, c_d = std::max(0.44, 24 / re * (1 + 0.15 * std::pow(re, 0.687)));
  return 0.75 * c_d * (1 - eps) * 1.2 * w * w * std::pow(eps, -4.65) / 0.01;
}

TEST_CASE("steep gas: Ergun up to 0.70, Wen & Yu from 0.85 on, linear in between") {
  const auto gradient = [](double eps, double velocity) {
    return kernel_flow<upright, native_lanes>(of_void_fraction(eps, velocity)).pressure_gradient;
  };
  for (const double velocity : {0.0, 1.5, 2.39}) {  // Re = 1600, 600 and 7
    CAPTURE(velocity);
    const double w = 2.4 - velocity;
    for (const double eps : {0.36, 0.5, 0.6999})
      CHECK(gradient(eps, velocity) == doctest::Approx(ergun(eps, w)).epsilon(1e-9));
    for (const double eps : {0.8501, 0.95, 0.997})
      CHECK(gradient(eps, velocity) == doctest::Approx(wen_yu(eps, w)).epsilon(1e-9));
    for (const double eps : {0.72, 0.775, 0.84}) {
      const double thin = (eps - 0.70) / 0.15, blended = (1 - thin) * ergun(eps, w) + thin * wen_yu(eps, w);
      CHECK(gradient(eps, velocity) == doctest::Approx(blended).epsilon(1e-9));
    }
  }
  // What the blend is for: Ergun's law on a lone sphere is some five times too strong.
  CHECK(ergun(0.997, 2.4) / wen_yu(0.997, 2.4) > 4);
}

TEST_CASE("steep gas: no jump where the laws meet, nor where the drag coefficient ends to fall") {
  const auto at = [](double eps, double velocity) {
    return kernel_flow<upright, 1>(of_void_fraction(eps, velocity)).pressure_gradient;
  };
  for (const double eps : {0.70, 0.85}) CHECK(at(eps + 1e-9, 0) == doctest::Approx(at(eps - 1e-9, 0)).epsilon(1e-7));
  double worst = 0, before = at(0.95, 2.4 - 1.40);
  for (double w = 1.40; w < 1.60; w += 1e-4) {  // Re = 930 to 1070
    const double now = at(0.95, 2.4 - w);
    CHECK(now >= before);
    worst = std::max(worst, (now - before) / now), before = now;
  }
  CHECK(worst < 3e-4);  // twice the relative change of w
}

template <class Case, int W>
void check_random_flows() {
  enter({Case::name, seed()});
  Random random(seed());
  for (int k = 0; k < 400; ++k) {
    const Bed bed{random(1, 260), random(-3, 3), 0.03};
    const auto found = kernel_flow<Case, W>(bed);
    CAPTURE(bed.count);
    CAPTURE(bed.velocity);
    check_same_flow(found, reference::steep_slice_flow<Case>(bed));
  }
}

TEST_CASE("steep gas: against the reference") {
  check_random_flows<upright, native_lanes>();
  check_random_flows<upright, 1>();
  check_random_flows<upright_fine, native_lanes>();
}

TEST_CASE("steep gas: an empty slice is a free pipe") {
  const auto flow = kernel_flow<upright_fine, native_lanes>({});
  check_same_flow(flow, reference::slice_flow<upright_fine>(Bed{}));
  CHECK(flow.pressure_gradient < 0);
}

TEST_CASE("steep gas: two sizes") {
  enter({upright_sizes::name, 0});
  for (const int small : {2, 20}) {  // thin and dense
    static SliceArrays<upright_sizes> gas;
    detail::clear_slices(gas);
    reference::BedSums<double> sums;
    const auto add = [&](double diameter, double velocity) {
      detail::count_in_slice(gas, 0, 0, velocity, diameter);
      sums.add(diameter / 0.010, velocity, 0);
    };
    for (int k = 0; k < small; ++k) add(0.010, 0.5), add(0.005, 0.7);
    CHECK(detail::solve_slices<upright_sizes, native_lanes>(gas, 0, native_lanes) == 0);
    const auto expected = reference::steep_slice_flow<upright_sizes>(sums.bed());
    CHECK(gas.void_fraction[0] == doctest::Approx(expected.void_fraction).epsilon(1e-13));
    CHECK(gas.pressure_gradient[0] == doctest::Approx(expected.pressure_gradient).epsilon(1e-11));
    double sum = 0;
    for (const double diameter : {0.010, 0.005}) {
      const double force = detail::force_in_bed(gas, 0) * detail::share_of_drag(gas, 0, diameter);
      CHECK(force == doctest::Approx(reference::force_in_bed(expected, diameter / 0.010)).epsilon(1e-11));
      sum += small * force;
    }
    CHECK(sum == doctest::Approx(gas.pressure_gradient[0] * 0.01 * gas.bed_area[0]).epsilon(1e-12));
  }
}

/// Light spheres of 4 mm in a wide upright pipe of resting air, so long that a slice is all but empty.
struct falling : upright {
  static constexpr const char* name = "a sphere falls in air";
  static constexpr int particle_count = 2;
  static constexpr double diameter = 0.004, density = 30, gas_bed_diameter = 0.004;
  static constexpr double pipe_diameter = 0.1, pipe_length = 2, gas_velocity = 0;
  static constexpr int slice_count = 20, gas_update_interval = 1, gas_floater_interval = 1000000;
  static constexpr double time_step = 1e-4;
};

TEST_CASE("steep gas: the terminal velocity of a single sphere") {
  enter({falling::name, 0});
  static Simulation<falling> simulation;
  simulation.place(0, {{0, 0, 0.5}, {0, 0, 0}, {0, 0, 0}});
  simulation.place(1, {{0.02, 0.01, 1.5}, {0, 0, 0}, {0, 0, 0}});
  start(simulation);
  run(simulation, 1);
  for (bool& floats : simulation.state().gas.floats) {
    CHECK(!floats);
    floats = true;  // as one just fed would: it makes no difference
  }
  run(simulation, 20000);
  const double found = -simulation.particle(0).velocity[2];
  // Where the drag of a lone sphere is its weight.
  const double weight = 3.14159265358979323846 / 6 * 64e-9 * 30 * 9.81;
  const auto terminal = [&](double factor) {
    return reference::bisection(10.0, weight, [&](double w) {
      return factor * reference::lone_sphere_drag<falling, double>({0, 0, w}).norm();
    });
  };
  CHECK(terminal(1) > 1);  // Re = 300: neither Stokes' law nor 0.44
  CHECK(found == doctest::Approx(terminal(1)).epsilon(4e-3));
  CHECK(found == doctest::Approx(terminal(std::pow(0.999, -4.65))).epsilon(1e-9));  // the void fraction ends there
  CHECK(simulation.particle(1).velocity[2] == doctest::Approx(-found).epsilon(1e-9));
}

}  // namespace
}  // namespace fixdem::tests
