// The gas with particles of several sizes: flow and forces in one slice, floaters and their drag; the kernel, and the
// reference by itself. Whole scenes are in agreement_sizes_test.cpp.
#include "gas_sizes_scenes.hpp"
#include "kernel/fixdem.hpp"
#include "reference/reference.hpp"

namespace fixdem::tests {
namespace {

template <class Case>
using ReferenceProgram = reference::Reference<Case, double>;

constexpr double pipe_area = 3.14159265358979324 / 4 * 0.05 * 0.05;

struct SliceFigures {
  double sauter_diameter, void_fraction, solids_velocity, gradient, in_bed, above, on_large, on_small;
};
constexpr SliceFigures in_full = {7.368421053e-3, 0.626666667,   0.571428571, 1497.125575, 2.4, 2.4,
                                  1.753445132e-3, 3.403746433e-4};
constexpr SliceFigures in_half = {7.777777778e-3, 0.661145274, 0.128571429,    16.600884506,
                                  0.331263487,    4.937414237, 2.188292978e-5, 4.384207094e-6};

doctest::Approx near(double x) { return doctest::Approx(x).epsilon(3e-9); }

template <class Case>
void check_figures(const SliceFigures& expected) {
  reference::BedSums<double> sums;
  for (int id = 0; id < Case::particle_count; ++id)
    sums.add(diameter_of<Case>(id) / 0.010, Case::velocities[species_of<Case>(id)], Case::height);
  const auto bed = sums.bed();
  CHECK(bed.velocity == near(expected.solids_velocity));
  CHECK(bed.sauter_diameter * 0.010 == near(expected.sauter_diameter));
  const auto flow = reference::slice_flow<Case>(bed);
  CHECK(flow.void_fraction == near(expected.void_fraction));
  CHECK(flow.pressure_gradient == near(expected.gradient));
  CHECK(flow.velocity_in_bed == near(expected.in_bed));
  CHECK(flow.velocity_above == near(expected.above));
  double sum = 0;
  for (int id = 0; id < Case::particle_count; ++id) sum += reference::force_in_bed(flow, diameter_of<Case>(id) / 0.010);
  CHECK(sum == doctest::Approx(flow.pressure_gradient * 0.01 * flow.bed_area).epsilon(1e-14));
}

TEST_CASE("gas with sizes: flow in a slice, in the reference") {
  check_figures<full_slice>(in_full);
  check_figures<half_slice>(in_half);
}

TEST_CASE("gas with sizes: forces on the particles of a slice, in the reference") {
  static ReferenceProgram<full_slice> full;
  check_slice<full_slice>(full, in_full.on_large, in_full.on_small);
  static ReferenceProgram<half_slice> half;
  check_slice<half_slice>(half, in_half.on_large, in_half.on_small);
}

TEST_CASE("gas with sizes: forces on the particles of a slice") {
  static Simulation<full_slice> full;
  check_slice<full_slice>(full, in_full.on_large, in_full.on_small);
  CHECK(full.pressure_gradient(1) == near(in_full.gradient));
  CHECK(full.bed_area(1) == near(pipe_area));
  static Simulation<half_slice> half;
  check_slice<half_slice>(half, in_half.on_large, in_half.on_small);
  CHECK(half.pressure_gradient(1) == near(in_half.gradient));
  // 1 - sum V/(A_d dz) = eps
  CHECK(half.bed_area(1) == near(7 * 5.235987756e-7 / (1 - in_half.void_fraction) / 0.01));
}

TEST_CASE("gas with sizes: which particles float, and their drag") {
  static ReferenceProgram<watched_gas> program;
  check_floaters(program, [&](int id) { return program.floats(id); });
  static Simulation<watched_gas> simulation;
  check_floaters(simulation, [&](int id) { return simulation.state().gas.floats[id]; });
}

}  // namespace
}  // namespace fixdem::tests
