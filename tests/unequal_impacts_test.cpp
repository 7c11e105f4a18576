// Impacts of unequal spheres against figures from outside: the kernel, and the reference by itself.
//
// The errors of `euler` and `leapfrog` are of first order in the step; with impulses they are of second order head on,
// and of first where a contact changes from sticking to sliding. Limited by the whole normal force, the bound of
// friction has a kink where that force changes its sign: at the same step the errors are some ten times larger.
#include "kernel/fixdem.hpp"
#include "mixed.hpp"
#include "reference/reference.hpp"
#include "unequal_figures.hpp"

namespace fixdem::tests {
namespace {

template <class Case>
using ReferenceProgram = reference::Reference<Case, double>;
template <class Case>
using Kernel = Simulation<Case>;
template <class Case>
using MixedKernel = Simulation<in_mixed_precision<Case>>;

using enum FrictionLimit;
using enum Integrator;

constexpr ImpactBounds euler_20{1e-4, 4e-4, 5e-4, 3e-4, 1e-5};
constexpr ImpactBounds leapfrog_20{4e-5, 3e-4, 1e-5, 1e-4, 1e-5};
constexpr ImpactBounds impulse_100{3e-7, 3e-4, 2e-5, 1e-4, 1e-6};
constexpr ImpactBounds impulse_20{1e-8, 3e-6, 1e-6, 1e-4, 3e-8};  // elastic limit
constexpr ImpactBounds mixed_impulse_100{3e-6, 4e-4, 4e-5, 1e-4, 3e-6};

/// Stiffness (N/m^1.5), tangential stiffness and reduced mass of the kinds of impact.
TEST_CASE("unequal spheres: coefficients, in the reference") {
  using Case = unequal<9, total, impulse, 100>;
  constexpr double expected[impact_kinds][3] = {{9.162794085e+07, 1.102827312e+08, 5.817764173e-05},
                                                {9.162794085e+07, 1.102827312e+08, 5.817764173e-05},
                                                {6.479073832e+07, 7.798166708e+07, 4.155545838e-06},
                                                {6.479073832e+07, 7.798166708e+07, 4.155545838e-06},
                                                {1.122208506e+08, 1.350682094e+08, 4.759988869e-04}};
  for (int kind = 0; kind < impact_kinds; ++kind) {
    const auto k = reference::pair_coefficients<Case, double>(8 * kind, 8 * kind + 4);
    const auto bodies = reference::bodies_of_contact<Case, double>(8 * kind, 8 * kind + 4);
    CHECK(k.normal_stiffness == doctest::Approx(expected[kind][0]).epsilon(1e-9));
    CHECK(k.tangential_stiffness == doctest::Approx(expected[kind][1]).epsilon(1e-9));
    CHECK(bodies.reduced_mass == doctest::Approx(expected[kind][2]).epsilon(1e-9));
  }
}

TEST_CASE("unequal spheres: impacts, in the reference") {
  check_unequal<ReferenceProgram, unequal<9, total, euler, 20>>(figures_at_nine_tenths(), euler_20);
  check_unequal<ReferenceProgram, unequal<5, elastic, leapfrog, 20>>(figures_at_a_half(), leapfrog_20);
  check_unequal<ReferenceProgram, unequal<9, total, impulse, 100>>(figures_at_nine_tenths(), impulse_100);
  check_unequal<ReferenceProgram, unequal<5, total, impulse, 100>>(figures_at_a_half(), impulse_100);
  check_unequal<ReferenceProgram, unequal<9, elastic, impulse, 20>>(figures_at_nine_tenths(), impulse_20);
  check_unequal<ReferenceProgram, unequal<5, elastic, impulse, 20>>(figures_at_a_half(), impulse_20);
}
TEST_CASE("unequal spheres: impacts by euler and leapfrog") {
  check_unequal<Kernel, unequal<9, total, euler, 20>>(figures_at_nine_tenths(), euler_20);
  check_unequal<Kernel, unequal<5, elastic, euler, 20>>(figures_at_a_half(), euler_20);
  check_unequal<Kernel, unequal<9, elastic, leapfrog, 20>>(figures_at_nine_tenths(), leapfrog_20);
  check_unequal<Kernel, unequal<5, total, leapfrog, 20>>(figures_at_a_half(), leapfrog_20);
}
TEST_CASE("unequal spheres: impacts by impulses") {
  check_unequal<Kernel, unequal<9, total, impulse, 100>>(figures_at_nine_tenths(), impulse_100);
  check_unequal<Kernel, unequal<5, total, impulse, 100>>(figures_at_a_half(), impulse_100);
  const Table table{"unequal-spheres", "closed form (head-on velocities), reference integration"};
  check_unequal<Kernel, unequal<9, elastic, impulse, 20>>(figures_at_nine_tenths(), impulse_20, table);
  check_unequal<Kernel, unequal<5, elastic, impulse, 20>>(figures_at_a_half(), impulse_20);
  check_unequal<MixedKernel, unequal<9, total, impulse, 100>>(figures_at_nine_tenths(), mixed_impulse_100);
}

}  // namespace
}  // namespace fixdem::tests
