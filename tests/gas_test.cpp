// The gas by itself: the two functions without a mathematics library, the flow split of a slice, its limits, drag, and
// which particles float. Whole scenes with gas are in agreement_gas_test.cpp.
#include <cmath>
#include <limits>

#include "gas_pipes.hpp"
#include "kernel/fixdem.hpp"

namespace fixdem::tests {
namespace {

using plug = cases::plug_u24;

struct hard_plug : plug {
  static constexpr BedHeight gas_bed_height = BedHeight::hard;
};
struct strict_plug : plug {
  static constexpr BedHeight gas_bed_height = BedHeight::strict;
};
struct wide_gap : plug {
  static constexpr double gas_full_gap = 0.014;
};
struct narrow_gap : plug {
  static constexpr double gas_full_gap = 0.003;
};
struct narrow_hard_gap : hard_plug {
  static constexpr double gas_full_gap = 0.003;
};
struct fine_bed : plug {
  static constexpr double gas_bed_diameter = 0.003;
};
struct reversed : plug {
  static constexpr double gas_velocity = -1.7;
};
struct backward : plug {
  static constexpr double gas_velocity = -2.4;
};
struct still : plug {
  static constexpr double gas_velocity = 0;
};

TEST_CASE("gas: arc cosine to 1e-12") {
  double worst = 0;
  const auto check = [&](double x) {
    const double exact = std::acos(x), found = arc_cosine(x);
    worst = std::max(worst, exact == 0 ? found : std::abs(found - exact) / exact);
  };
  for (int k = -100000; k <= 100000; ++k) check(k / 100000.0);
  for (double gap = 1; gap > 1e-17; gap /= 1.1) check(1 - gap), check(-1 + gap);
  CHECK(worst < 1e-12);
  CHECK(arc_cosine(1.0) == 0);
  CHECK(arc_cosine(-1.0) == doctest::Approx(3.14159265358979323846).epsilon(1e-15));
}

TEST_CASE("gas: arc cosine is the same in every lane") {
  using V = Lanes<native_lanes>;
  alignas(64) double x[8], found[8];
  Random random(seed());
  for (int k = 0; k < 1000; ++k) {
    for (double& value : x) value = random(-1, 1);
    store(found, arc_cosine(load<V>(x)));
    for (int lane = 0; lane < native_lanes; ++lane) CHECK(found[lane] == arc_cosine(x[lane]));
  }
}

TEST_CASE("gas: the power 0.687 to 1e-12") {
  double worst = 0;
  for (double x = 1e-30; x < 1e30; x *= 1.0013) {
    const double exact = std::pow(x, 0.687);
    worst = std::max(worst, std::abs(power<687, 1000>(x) - exact) / exact);
  }
  CHECK(worst < 1e-12);
  CHECK(power<687, 1000>(0.0) < 1e-20);  // a Reynolds number of zero adds nothing
  CHECK(power<687, 1000>(0.0) >= 0);
}

template <class Case, int W>
void check_flow(const Bed& bed) {
  CAPTURE(bed.count);
  CAPTURE(bed.velocity);
  CAPTURE(bed.top);
  check_same_flow(kernel_flow<Case, W>(bed), reference::slice_flow<Case>(bed));
}

template <class Case>
void check_random_flows() {
  enter({Case::name, seed()});
  Random random(seed());
  for (int k = 0; k < 400; ++k) {
    Bed bed;
    bed.count = static_cast<int>(random(1, 30));
    bed.velocity = random(-3, 3);
    bed.top = random(Case::diameter, 1.01 * Case::pipe_diameter);
    check_flow<Case, native_lanes>(bed);
    check_flow<Case, 1>(bed);
  }
}

TEST_CASE("gas: the flow split against bisection") {
  check_random_flows<plug>();
  check_random_flows<hard_plug>();
  check_random_flows<strict_plug>();
  check_random_flows<wide_gap>();
  check_random_flows<narrow_gap>();
  check_random_flows<narrow_hard_gap>();
  check_random_flows<fine_bed>();
  check_random_flows<reversed>();
  check_random_flows<still>();
}

TEST_CASE("gas: an empty slice is a free pipe") {
  const auto flow = kernel_flow<plug, native_lanes>({0, 0, 0});
  const double Re = 2.4 * 0.05 / 1.5e-5, lambda = 0.3164 * std::pow(Re, -0.25);
  CHECK(flow.velocity_above == doctest::Approx(2.4).epsilon(1e-12));
  CHECK(flow.pressure_gradient == doctest::Approx(lambda / 0.05 * 1.2 * 2.4 * 2.4 / 2).epsilon(1e-12));
  CHECK(flow.bed_area == 0);
}

TEST_CASE("gas: a full slice takes the whole flow") {
  for (double top :
       {0.05, 0.0499999, 0.041}) {  // less than a diameter of free height is full, continuously from two on
    const auto flow = kernel_flow<plug, native_lanes>({19, 0.5, top});
    const double area = 3.14159265358979323846 / 4 * 0.05 * 0.05, volume = 3.14159265358979323846 / 6 * 1e-6;
    const double eps = 1 - 19 * volume / (area * 0.01), c = (1 - eps) / (eps * eps * eps), w = 2.4 - 0.5;
    const double Re = 0.01 * w / 1.5e-5, xi = c * (150 * (1 - eps) / Re + 1.75);  // eqs. (33)-(35) as printed
    CAPTURE(top);
    CHECK(flow.pressure_gradient == doctest::Approx(xi * 1.2 * w * w / 0.01).epsilon(1e-12));
    CHECK(flow.velocity_in_bed == doctest::Approx(2.4).epsilon(1e-12));
    CHECK(flow.bed_area == doctest::Approx(area).epsilon(1e-12));
  }
}

TEST_CASE("gas: the three bed heights differ where they should") {
  const auto area = [](auto flow) { return flow.bed_area / (3.14159265358979323846 / 4 * 0.05 * 0.05); };
  const Bed almost_full{15, 0.5, 0.042}, high{12, 0.5, 0.036}, half{8, 0.5, 0.025};
  CHECK(area(kernel_flow<plug, 1>(almost_full)) == doctest::Approx(1));
  CHECK(area(kernel_flow<hard_plug, 1>(almost_full)) == doctest::Approx(1));
  CHECK(area(kernel_flow<strict_plug, 1>(almost_full)) < 0.92);
  CHECK(area(kernel_flow<plug, 1>(high)) > area(kernel_flow<hard_plug, 1>(high)) + 0.05);
  CHECK(area(kernel_flow<hard_plug, 1>(high)) == doctest::Approx(area(kernel_flow<strict_plug, 1>(high))));
  for (const double found : {area(kernel_flow<plug, 1>(half)), area(kernel_flow<hard_plug, 1>(half)),
                             area(kernel_flow<strict_plug, 1>(half))}) {
    CHECK(found == doctest::Approx(0.5));
  }
}

TEST_CASE("gas: the free height below which a slice is full can be set") {
  const auto is_full = [](auto flow) { return flow.velocity_above == flow.velocity_in_bed; };
  const auto filled_to = [](double free_height) { return Bed{15, 0.5, 0.05 - free_height}; };
  CHECK(is_full(kernel_flow<plug, 1>(filled_to(0.0099))));
  CHECK(!is_full(kernel_flow<plug, 1>(filled_to(0.0101))));
  CHECK(is_full(kernel_flow<wide_gap, 1>(filled_to(0.0139))));
  CHECK(!is_full(kernel_flow<wide_gap, 1>(filled_to(0.0141))));
  CHECK(is_full(kernel_flow<narrow_gap, 1>(filled_to(0.0029))));
  CHECK(!is_full(kernel_flow<narrow_gap, 1>(filled_to(0.0031))));
  CHECK(is_full(kernel_flow<narrow_hard_gap, 1>(filled_to(0.0029))));
  CHECK(!is_full(kernel_flow<narrow_hard_gap, 1>(filled_to(0.0031))));
}

TEST_CASE("gas: no flow past a bed that moves with the gas, backward push on a faster one") {
  CHECK(std::abs(kernel_flow<still, native_lanes>({10, 0, 0.03}).pressure_gradient) == 0);
  CHECK(kernel_flow<still, native_lanes>({19, 0.5, 0.05}).pressure_gradient < 0);
  CHECK(kernel_flow<plug, native_lanes>({19, 3.0, 0.05}).pressure_gradient < 0);
  CHECK(kernel_flow<plug, native_lanes>({19, 2.4, 0.05}).pressure_gradient == doctest::Approx(0));
  const double forward = kernel_flow<plug, native_lanes>({10, 0, 0.03}).pressure_gradient;
  CHECK(forward > 0);
  CHECK(kernel_flow<backward, native_lanes>({10, 0, 0.03}).pressure_gradient == -forward);
}

TEST_CASE("gas: drag on a lone sphere") {
  enter({plug::name, 0});
  double worst = 0;
  for (double speed = 1e-8; speed < 50; speed *= 1.03) {
    const double velocity[3] = {0.6 * speed, -0.48 * speed, 2.4 - 0.64 * speed};
    double found[3];
    detail::drag_on_floater<plug>(2.4, velocity, found);
    const auto expected = reference::lone_sphere_drag<plug, double>({-velocity[0], -velocity[1], 2.4 - velocity[2]});
    for (int c = 0; c < 3; ++c) worst = std::max(worst, std::abs(found[c] - expected[c]) / expected.norm());
  }
  CHECK(worst < 1e-12);
}

/// Particles in known places; which of them float is known.
struct watched : plug {
  static constexpr int particle_count = 7;
  static constexpr int gas_update_interval = 1, gas_floater_interval = 1;
};

TEST_CASE("gas: which particles float") {
  enter({watched::name, 0});
  static Simulation<watched> simulation;
  const double d = watched::diameter, reach = watched::pipe_diameter / 2 - d / 2, touch = 1e-6,
               L = watched::pipe_length;
  const auto place_but_4 = [&] {
    simulation.place(0, {{0, 0, 0.10}, {}, {}});                 // alone: floats
    simulation.place(1, {{0, -(reach + touch), 0.20}, {}, {}});  // on the bottom: bed
    simulation.place(2, {{0, reach + touch, 0.30}, {}, {}});     // touches the upper half: floats
    simulation.place(3, {{0, 0, 0.40}, {}, {}});                 // 1.09 d apart, no contact: bed
    simulation.place(5, {{0, 0.001, 0.2 * d}, {}, {}});          // the same across the periodic ends: bed
    simulation.place(6, {{0, 0.001, L - 0.89 * d}, {}, {}});
  };
  place_but_4();
  simulation.place(4, {{0, 0, 0.40 + 1.09 * d}, {}, {}});
  start(simulation);
  run(simulation, 1);
  const bool expected[] = {true, false, true, false, false, false, false};
  for (int id = 0; id < watched::particle_count; ++id) {
    CAPTURE(id);
    CHECK(simulation.state().gas.floats[id] == expected[id]);
  }
  place_but_4();
  simulation.place(4, {{0, 0, 0.40 + 1.11 * d}, {}, {}});  // beyond 1.1 d: both float
  start(simulation);
  run(simulation, 1);
  CHECK(simulation.state().gas.floats[3]);
  CHECK(simulation.state().gas.floats[4]);
}

}  // namespace
}  // namespace fixdem::tests
