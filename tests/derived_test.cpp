// The coefficients that the compiler derives from a case, against the paper's values and the reference's formulas.
#include <cmath>

#include "cases/plug_u24.hpp"
#include "cases/settle.hpp"
#include "reference/contact_reference.hpp"
#include "support.hpp"

namespace fixdem::tests {
namespace {

struct rigid_wall : cases::settle {
  static constexpr double wall_youngs_modulus = __builtin_inf();
};
struct other_wall : cases::settle {
  static constexpr double wall_youngs_modulus = 7e8, wall_poisson_ratio = 0.45;
};
struct by_particle_mass : cases::settle {
  static constexpr DampingMass damping_mass = DampingMass::particle;
};
template <int permille>
struct with_restitution : cases::settle {
  static constexpr double restitution = permille / 1000.0;
};
template <Damping kind>
struct linear : cases::settle {
  static constexpr NormalLaw normal = NormalLaw::linear;
  static constexpr double youngs_modulus = 0, poisson_ratio = 0, wall_youngs_modulus = 0, wall_poisson_ratio = 0;
  static constexpr double normal_stiffness = 800, tangential_stiffness = 200;
  static constexpr Damping damping = kind;
};

/// To 4e-15: a few roundings in either formula.
void check_same(double a, double b) {
  CAPTURE(a);
  CAPTURE(b);
  CHECK(std::abs(a - b) <= 4e-15 * std::abs(b));
}

template <class Case>
void check_against_reference() {
  enter({Case::name, 0});
  using D = Derived<Case>;
  const auto sphere = reference::sphere_properties<Case, double>();
  check_same(D::radius, sphere.radius);
  check_same(D::mass, sphere.mass);
  check_same(D::moment_of_inertia, sphere.moment_of_inertia);
  const auto pair = reference::pair_coefficients<Case, double>(), wall = reference::wall_coefficients<Case, double>();
  check_same(D::stiffness_pair, pair.normal_stiffness);
  check_same(D::stiffness_wall, wall.normal_stiffness);
  check_same(D::tangential_stiffness_pair, pair.tangential_stiffness);
  check_same(D::tangential_stiffness_wall, wall.tangential_stiffness);
  check_same(D::damping_pair, pair.normal_damping);
  check_same(D::damping_wall, wall.normal_damping);
  check_same(D::tangential_damping_pair, pair.tangential_damping);
  check_same(D::tangential_damping_wall, wall.tangential_damping);
}

TEST_CASE("derived: the stiffness of Table 2") {
  enter({cases::plug_u24::name, 0});
  using D = Derived<cases::plug_u24>;
  CHECK(D::stiffness_pair == doctest::Approx(1.122e8).epsilon(5e-4));  // N/m^1.5
  CHECK(D::stiffness_wall == doctest::Approx(1.587e8).epsilon(5e-4));
  CHECK(D::tangential_stiffness_wall / (1.5 * D::stiffness_wall) == doctest::Approx(1.60).epsilon(5e-3));
  CHECK(D::tangential_stiffness_pair / (1.5 * D::stiffness_pair) == doctest::Approx(0.80).epsilon(5e-3));
  CHECK(D::mass == doctest::Approx(5.235988e-4).epsilon(1e-6));  // kg
}

TEST_CASE("derived: alpha of eq. (30)") {
  using D = Derived<cases::plug_u24>;
  const auto alpha = [](double e) { return std::sqrt(5.0) * D::damping_ratio(e); };
  CHECK(std::abs(alpha(0.9) - 0.07495) < 1e-5);
  CHECK(std::abs(alpha(0.5) - 0.48177) < 1e-5);
  CHECK(std::abs(alpha(0.2) - 1.01953) < 1e-5);
  CHECK(alpha(1) == 0);
  check_same(alpha(0.1), reference::damping_constant(0.1));
}

TEST_CASE("derived: every coefficient equals the reference's") {
  check_against_reference<cases::plug_u24>();
  check_against_reference<rigid_wall>();
  check_against_reference<other_wall>();
  check_against_reference<by_particle_mass>();
  check_against_reference<with_restitution<200>>();
  check_against_reference<linear<Damping::restitution>>();
  check_against_reference<linear<Damping::critical>>();
}

}  // namespace
}  // namespace fixdem::tests
