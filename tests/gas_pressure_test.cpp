// Compressible gas without storage: the closed form of the empty pipe, an independent solution of a filled one,
// pressure and blower instead of a velocity, limits, and how long a line may be before all this matters.
#include <algorithm>
#include <cmath>

#include "gas_pipes.hpp"

namespace fixdem::tests {
namespace {

/// Pressure at the inlet above the outlet in an empty pipe of 50 mm: p_0^2 - p_L^2 = lambda (rho U)^2 R T L/D.
double closed_form(double length, double U) {
  const double lambda = 0.3164 * std::pow(std::abs(U) * 0.05 / 1.5e-5, -0.25), p = 1e5;
  return std::sqrt(p * p + lambda * 1.2 * U * std::abs(U) * p * length / 0.05) - p;
}

template <class Case>
void check_empty_pipe(double expected) {
  AirInPipe<Case> line;
  line.settle(1);
  CHECK(line.inlet() == doctest::Approx(expected).epsilon(1e-10));
  line.settle(3);
  CHECK(line.inlet() == doctest::Approx(expected).epsilon(1e-10));
}

TEST_CASE("compressible gas: the empty pipe in closed form, whatever the slices") {
  // rho U and with it lambda are the same everywhere, so G p_m is, and so is (p_k - p_(k+1)) (p_k + p_(k+1))/(2 dz):
  // the mean pressure of a slice makes its difference of squares exact, and no error of dz is left.
  CHECK(closed_form(50, 30) == doctest::Approx(9186.02).epsilon(1e-6));
  check_empty_pipe<air_line<50, 7, 30000>>(closed_form(50, 30));
  check_empty_pipe<air_line<50, 500, 30000>>(closed_form(50, 30));
  check_empty_pipe<air_line<500, 40, 30000>>(closed_form(500, 30));  // p_0 is 1.7 times p_L
  check_empty_pipe<air_line<50, 40, -30000>>(closed_form(50, -30));  // sucked
}

/// Pressure at the inlet of a pipe with the same bed all along, by Runge and Kutta's method from the outlet.
template <class Case>
double by_integration(const Bed& bed, int steps) {
  const double h = Case::pipe_length / steps;
  double p = 1e5;
  const auto rise = [&](double at) {
    const double share = at / 1e5;
    return reference::any_slice_flow<Case>(
               bed, {Case::gas_velocity / share, Case::gas_density * share, Case::gas_viscosity / share})
        .pressure_gradient;
  };
  for (int k = 0; k < steps; ++k) {
    const double a = rise(p), b = rise(p + h / 2 * a), c = rise(p + h / 2 * b), d = rise(p + h * c);
    p += h / 6 * (a + 2 * b + 2 * c + d);
  }
  return p - 1e5;
}

template <int slices>
double inlet_of_bed(double number, double velocity, double top, double& exact) {
  using Case = air_line<20, slices>;
  AirInPipe<Case> line;
  const Bed bed = bed_of_slice<Case>(number, velocity, top);
  line.put_everywhere(bed);
  line.settle(1);
  exact = by_integration<Case>(bed, 2000);
  return line.inlet();
}

TEST_CASE("compressible gas: a filled pipe against an integration, converging with the square of the slice") {
  struct {
    double number, velocity, top;
  } const beds[] = {{19, 0.3, 0.05}, {13, 0.1, 0.036}};
  for (const auto& bed : beds) {
    double exact;
    const double coarse = inlet_of_bed<10>(bed.number, bed.velocity, bed.top, exact) - exact;
    const double middle = inlet_of_bed<20>(bed.number, bed.velocity, bed.top, exact) - exact;
    const double fine = inlet_of_bed<40>(bed.number, bed.velocity, bed.top, exact) - exact;
    CAPTURE(exact);
    CHECK(std::abs(fine) < 1e-3 * exact);
    CHECK(std::abs(middle) > 1e-9 * exact);  // not of rounding
    CHECK(coarse / middle == doctest::Approx(4).epsilon(0.1));
    CHECK(middle / fine == doctest::Approx(4).epsilon(0.05));
  }
}

struct stiff : air_line<5, 50> {
  static constexpr double gas_outlet_pressure = 1e12;
};

TEST_CASE("compressible gas: at a high pressure it is not compressed") {
  AirInPipe<stiff> line;
  Random random(seed());
  std::vector<Bed> beds;
  for (int s = 0; s < 50; ++s) line.put(s, beds.emplace_back(random_bed<stiff>(random)));
  line.settle(1);
  for (int s = 0; s < 50; ++s)
    CHECK(line.gas().pressure_gradient[s] ==
          doctest::Approx(reference::slice_flow<stiff>(beds[s]).pressure_gradient).epsilon(1e-6));
}

/// Plugs of four slices and gaps of six with a layer between them, about 1 kPa/m together.
template <class Case>
void put_plugs(AirInPipe<Case>& line) {
  for (int s = 0; s < Case::slice_count; ++s)
    line.put(s, s % 10 < 4 ? bed_of_slice<Case>(19, 0.65, 0.05) : bed_of_slice<Case>(5, 0, 0.02));
}

/// What compression does to the first plug: velocities and pressure gradients there, of those at the outlet.
struct Compressed {
  double loss, velocity, gradient;
};
template <int metres>
Compressed compressed() {
  using Case = air_line<metres, metres * 100>;
  AirInPipe<Case> line;
  put_plugs(line);
  line.settle(1);
  const auto& gas = line.gas();
  const double constant = reference::slice_flow<Case>(bed_of_slice<Case>(19, 0.65, 0.05)).pressure_gradient;
  return {line.inlet() / metres, bulk_velocity_in(gas, 2) / bulk_velocity_in(gas, Case::slice_count - 6),
          gas.pressure_gradient[2] / constant};
}

TEST_CASE("compressible gas: a constant velocity is good enough for 5 m, and not for 50 m") {
  const Compressed five = compressed<5>(), fifty = compressed<50>();
  CHECK(five.loss == doctest::Approx(1000).epsilon(0.2));
  CHECK(five.velocity == doctest::Approx(0.95).epsilon(0.01));
  CHECK(fifty.velocity == doctest::Approx(0.7).epsilon(0.1));
  // The drive of a plug. Its speed scatters by a tenth from plug to plug.
  CHECK(std::abs(five.gradient - 1) < 0.1);
  CHECK(std::abs(fifty.gradient - 1) > 0.2);
}

/// The steady state of a line that a velocity drives, and of the same driven otherwise.
template <class Line, template <class> class Driven>
void check_same_state(const char* what) {
  CAPTURE(what);
  using Case = Driven<Line>;
  AirInPipe<Line> line;
  AirInPipe<Case> other;
  Random random(seed());
  for (int s = 0; s < Line::slice_count; ++s) {
    const Bed bed = random_bed<Line>(random);
    line.put(s, bed), other.put(s, bed);
  }
  line.settle(1);
  const double section = section_of<Line>, U = Line::gas_velocity;
  if constexpr (requires { Case::gas_inlet_pressure; }) {
    Case::gas_inlet_pressure = Case::gas_outlet_pressure + line.inlet();
  } else {
    Case::gas_blower_flow = 1.5 * U * section;
    Case::gas_blower_pressure = 3 * line.inlet();  // two thirds of the flow at a third of the pressure
  }
  other.settle(1);
  for (int k = 0; k < 2; ++k) {
    for (int s = 0; s < Line::slice_count; ++s) {
      CHECK(other.flow(s) == doctest::Approx(line.flow(s)).epsilon(1e-8));
      CHECK(other.gas().pressure_gradient[s] == doctest::Approx(line.gas().pressure_gradient[s]).epsilon(1e-7));
    }
    CHECK(other.inlet() == doctest::Approx(line.inlet()).epsilon(1e-8));
    CHECK(gas_supply(other.gas()) == doctest::Approx(1.2 * U * section).epsilon(1e-8));
    other.settle(20);  // and it stays, with storage and without
  }
}

template <class Line>
using pressed_and_storing = storing<with_inlet_pressure<Line>>;
template <class Line>
using blown_and_storing = storing<with_blower<Line>>;

TEST_CASE("compressible gas: pressure and blower drive the same state as the velocity") {
  enter({air_line<5, 24>::name, seed()});
  check_same_state<air_line<5, 24>, with_inlet_pressure>("inlet pressure");
  check_same_state<air_line<5, 24>, with_blower>("blower");
  check_same_state<air_line<5, 24>, pressed_and_storing>("inlet pressure, storage");
  check_same_state<air_line<5, 24>, blown_and_storing>("blower, storage");
  check_same_state<air_line<40, 24>, with_inlet_pressure>("inlet pressure, 40 m");
  check_same_state<air_line<40, 24>, with_blower>("blower, 40 m");
}

/// The slope that Newton's method takes is that of the pressure gradient over the velocity.
template <class Case>
void check_slopes() {
  enter({Case::name, seed()});
  const auto gas = std::make_unique<SliceArrays<Case>>();
  Random random(seed());
  for (int s = 0; s < gas->padded; ++s) {
    fill(*gas, s, random_bed<Case>(random));
    gas->pressures.mean[s] = random(0.9e5, 2e5);
    gas->pressures.flow[s] = random(-5e5, 5e5);
  }
  const auto at = [&](double factor, double* gradients) {
    for (double& flow : gas->pressures.flow) flow *= factor;
    CHECK(detail::solve_slices<Case, native_lanes>(*gas, 0, gas->padded) < 1e-12);
    std::copy_n(gas->pressure_gradient, gas->count, gradients);
    for (double& flow : gas->pressures.flow) flow /= factor;
  };
  double above[Case::slice_count], below[Case::slice_count], here[Case::slice_count];
  at(1 + 1e-6, above), at(1 - 1e-6, below), at(1, here);
  for (int s = 0; s < gas->count; ++s) {
    const double U = gas->pressures.flow[s] / gas->pressures.mean[s];
    CHECK(gas->pressures.slope[s] == doctest::Approx((above[s] - below[s]) / (2e-6 * U)).epsilon(1e-6));
  }
}
struct upright : air_line<5, 400> {
  static constexpr double gravity[3] = {0, 0, -9.81};
};

TEST_CASE("compressible gas: slopes of the pressure gradient") {
  check_slopes<air_line<5, 400>>();
  check_slopes<upright>();
}

TEST_CASE("compressible gas: no vacuum carries this flow") {
  AirInPipe<air_line<50, 40, -80000>> line;
  CHECK(closed_form(50, -60) < 0);
  CHECK(!std::isfinite(closed_form(50, -80)));
  double residual = 0;
  for (int k = 0; k < 100 && residual < maximum_residual; ++k) residual = line.update();
  CHECK(!(residual < maximum_residual));
}

TEST_CASE("compressible gas: density and viscosity of a slice, and drag on a floater by them") {
  using Case = air_line<50, 10, 30000>;
  AirInPipe<Case> line;
  line.settle(1);
  const auto& gas = line.gas();
  const double share = 1 + (pressure_at_node(gas, 0) + pressure_at_node(gas, 1)) / 2e5;
  CHECK(share > 1.08);
  CHECK(gas_density_in(gas, 0) == doctest::Approx(1.2 * share).epsilon(1e-11));
  CHECK(bulk_velocity_in(gas, 0) == doctest::Approx(30 / share).epsilon(1e-11));
  const reference::Gas<double> expected{30 / share, 1.2 * share, 1.5e-5 / share};
  for (const double speed : {0.1, 20.0}) {  // with the viscosity, and with the density alone
    const double velocity[3] = {0.6 * speed, 0, expected.velocity - 0.8 * speed};
    double found[3];
    detail::drag_on_floater<Case>(gas.velocity_above[0], velocity, found, Case::diameter, stream_at<Case, 1>(gas, 0));
    const auto drag =
        reference::lone_sphere_drag<Case, double>({-velocity[0], 0, expected.velocity - velocity[2]}, 0, expected);
    for (int c = 0; c < 3; ++c) CHECK(std::abs(found[c] - drag[c]) < 1e-10 * drag.norm());
  }
}

}  // namespace
}  // namespace fixdem::tests
