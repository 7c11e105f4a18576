// Compressible gas that the pipe and a supply volume store: mass, filling, and updates with changing beds against the
// reference.
#include <cmath>

#include "gas_pipes.hpp"

namespace fixdem::tests {
namespace {

template <class Line>
struct with_supply : storing<Line> {
  static constexpr double gas_supply_volume = 0.02;
};

/// Beds that are all new now and then; the kernel at both widths against the reference.
template <class Case, int W>
void check_updates(const char* what, int updates) {
  CAPTURE(what);
  enter({Case::name, seed()});
  AirInPipe<Case, W> line;
  reference::GasInPipe<Case, double> program;
  Random random(seed());
  std::vector<Bed> beds(Case::slice_count);
  for (int update = 0; update < updates; ++update) {
    CAPTURE(update);
    for (int s = 0; s < Case::slice_count; ++s) {
      if (update % 3 == 0 && random(0, 1) < 0.3) beds[s] = random_bed<Case>(random);
      line.put(s, beds[s]);
    }
    const long long step = update * Case::gas_update_interval;
    const double U = reference::velocity_at<Case>(static_cast<double>(step) * Case::time_step);
    REQUIRE(line.update(U) < maximum_residual);
    const auto flows = program.update(beds, step);
    for (int s = 0; s < Case::slice_count; ++s) {
      const auto& gas = line.gas();
      CHECK(line.flow(s) == doctest::Approx(program.flow(s)).epsilon(1e-8));
      CHECK(std::abs(pressure_at_node(gas, s) - (program.pressure(s) - 1e5)) < 1e-9 * line.inlet() + 1e-7);
      CHECK(gas.pressure_gradient[s] == doctest::Approx(flows[s].pressure_gradient).epsilon(1e-7));
      CHECK(gas.velocity_above[s] == doctest::Approx(flows[s].velocity_above).epsilon(1e-7));
      CHECK(stream_at<Case, 1>(gas, s).viscosity == doctest::Approx(flows[s].gas.viscosity).epsilon(1e-10));
    }
    CHECK(line.gas().pressures.supply == doctest::Approx(program.supply()).epsilon(1e-8));
  }
}

template <class Line>
struct rising : Line {  // and falling again, within the updates of the test
  static constexpr TimeValue gas_velocity_in_time[] = {{0.001, 2.4}, {0.004, 5}, {0.006, 1}};
};
struct upright_line : air_line<5, 20> {
  static constexpr double gravity[3] = {0, 0, -9.81};
};
using five_metres = air_line<5, 20>;

TEST_CASE("compressible gas against the reference") {
  check_updates<five_metres, native_lanes>("velocity", 20);
  check_updates<five_metres, 1>("velocity, one lane", 20);
  check_updates<rising<five_metres>, native_lanes>("velocity in time", 25);
  check_updates<with_inlet_pressure<five_metres>, native_lanes>("inlet pressure", 20);
  check_updates<with_blower<five_metres>, native_lanes>("blower", 20);
  check_updates<upright_line, native_lanes>("upright", 20);
  check_updates<air_line<40, 20>, native_lanes>("40 m", 20);
}

TEST_CASE("compressible gas with storage against the reference") {
  check_updates<storing<five_metres>, native_lanes>("velocity", 25);
  check_updates<storing<five_metres>, 1>("velocity, one lane", 25);
  check_updates<rising<storing<five_metres>>, native_lanes>("velocity in time", 25);
  check_updates<with_supply<five_metres>, native_lanes>("supply", 25);
  check_updates<with_inlet_pressure<storing<five_metres>>, native_lanes>("inlet pressure", 25);
  check_updates<with_blower<with_supply<five_metres>>, native_lanes>("blower and supply", 25);
  check_updates<storing<upright_line>, native_lanes>("upright", 25);
}

/// Gas in pipe and supply as pressure times length, with the void fractions that the slices have now.
template <class Case>
double stored(const SliceArrays<Case>& gas, const std::vector<double>& pressures) {
  double sum = supply_volume<Case> / section_of<Case> * pressures[0];
  for (int s = 0; s < Case::slice_count; ++s)
    sum += Derived<Case>::slice_length / 2 * detail::share_of_gas(gas, s) * (pressures[s] + pressures[s + 1]);
  return sum;
}

template <class Case>
void check_mass(const char* what) {
  CAPTURE(what);
  enter({Case::name, seed()});
  AirInPipe<Case> line;
  Random random(seed());
  line.settle(1);
  const auto pressures = [&] {
    std::vector<double> p;
    for (int k = 0; k <= Case::slice_count; ++k) p.push_back(pressure_at_node(line.gas(), k));
    return p;
  };
  double moved = 0;
  for (int update = 0; update < 50; ++update) {
    if (update % 10 == 0)
      for (int s = 0; s < Case::slice_count; ++s) line.put(s, random_bed<Case>(random));
    const auto before = pressures();
    line.settle(1, update < 25 ? 2.4 : 4);
    const double gained = stored(line.gas(), pressures()) - stored(line.gas(), before);
    const double passed =
        (line.gas().pressures.supply - line.flow(Case::slice_count - 1)) * Case::gas_update_interval * Case::time_step;
    CHECK(std::abs(gained - passed) < 1e-12 * line.gas().pressures.supply * 0.0003 + 1e-9);
    moved = std::max(moved, std::abs(gained));
  }
  CHECK(moved > 0.1);  // Pa m, of some 70 that pass in an update
}

TEST_CASE("storage: what flows in and not out is stored, at every update") {
  check_mass<storing<air_line<5, 100>>>("pipe");
  check_mass<with_supply<air_line<5, 100>>>("pipe and supply");
  check_mass<with_blower<with_supply<air_line<5, 100>>>>("blower");
  check_mass<with_inlet_pressure<storing<air_line<5, 100>>>>("inlet pressure");
}

/// A gas so viscous that the loss of a short plug is proportional to the flow; before it a supply.
struct filling : storing<air_line<1, 10>> {
  static constexpr double gas_viscosity = 2e-2, gas_supply_volume = 0.002;
};

TEST_CASE("storage: a supply fills as a capacity behind a resistance does") {
  AirInPipe<filling> line;
  line.put(9, bed_of_slice<filling>(19, 0, 0.05));
  const double U = 0.001;
  line.settle(1, 0);
  CHECK(line.inlet() == doctest::Approx(0).scale(1e-9));
  AirInPipe<filling> steady;
  steady.put(9, bed_of_slice<filling>(19, 0, 0.05));
  steady.settle(1, U);
  const double end = steady.inlet(), resistance = end / (1e5 * U);
  const double before_plug = 0.9 + 0.05 * detail::share_of_gas(steady.gas(), 9);  // and half the plug
  const double capacity = filling::gas_supply_volume / section_of<filling> + before_plug;
  const double dt = filling::gas_update_interval * filling::time_step, share = dt / (capacity * resistance);
  const int updates = static_cast<int>(1 / share);  // one time constant
  line.settle(updates, U);
  // Backward Euler on one capacity, to the share of the loss that is not linear and of what the pipe holds.
  CHECK(1 - line.inlet() / end == doctest::Approx(std::pow(1 + share, -updates)).epsilon(3e-3));
  CHECK(1 - line.inlet() / end == doctest::Approx(std::exp(-updates * share)).epsilon(3e-3 + share / 2));
  line.settle(30 * updates, U);
  CHECK(line.inlet() == doctest::Approx(end).epsilon(1e-8));
}

TEST_CASE("storage: after a change of velocity the steady state of the new one") {
  using Case = storing<air_line<5, 50>>;
  AirInPipe<Case> line, steady;
  for (int s = 0; s < 50; ++s) {
    const Bed bed = s % 10 < 4 ? bed_of_slice<Case>(19, 0.5, 0.05) : bed_of_slice<Case>(5, 0, 0.02);
    line.put(s, bed), steady.put(s, bed);
  }
  line.settle(1, 2.4), steady.settle(1, 3.5);
  const double start = line.inlet(), end = steady.inlet(), bulk = 3.5 * 1e5;
  line.settle(1, 3.5);
  CHECK(line.flow(49) < 0.8 * bulk);  // the pipe fills first: some 0.1 s, not at once
  CHECK((line.inlet() - start) / (end - start) < 0.1);
  line.settle(333, 3.5);  // 0.1 s
  CHECK((line.inlet() - start) / (end - start) > 0.5);
  line.settle(20000, 3.5);
  CHECK(line.inlet() == doctest::Approx(end).epsilon(1e-8));
  for (int s = 0; s < 50; ++s) CHECK(line.flow(s) == doctest::Approx(bulk).epsilon(1e-8));
}

}  // namespace
}  // namespace fixdem::tests
