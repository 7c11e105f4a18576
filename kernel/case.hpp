// What a case is: the constants that a generated header provides, and what follows from them.
//
// A case file (cases/*.toml) becomes a struct of `static constexpr` values in namespace fixdem::cases (tools/casegen
// writes it); everything in the kernel is a template over that struct. This file gives the vocabulary of choices and
// the coefficients of the contact law, derived once at compile time. SI units throughout.
//
// Equation numbers are those of Tsuji, Tanaka & Ishida, Powder Technology 71 (1992) 239-250.
#pragma once

#include <type_traits>

#include "constant_math.hpp"
#include "sizes.hpp"
#include "time_table.hpp"

namespace fixdem {

enum class NormalLaw { hertz, linear };
/// What of the tangential spring is remembered: its displacement (eq. 7), its force, or its force rescaled on
/// unloading.
enum class TangentialLaw { displacement, force, rescale };
/// Coulomb slider: `clip` caps the spring, then the total; `exact` does the same, but turns the spring by the solution
/// of its motion (exact_slider.hpp); `paper` is eqs. (10)-(12) to the letter.
enum class Slider { clip, paper, exact };
/// Damping coefficient from the restitution (eq. 26 or its linear form), or critical (eq. 23; linear law only).
enum class Damping { restitution, critical };
/// Mass in eq. (26) between spheres: the reduced mass m/2 (restitution as asked), or m as the paper prints it.
enum class DampingMass { reduced, particle };
/// Limit of friction: mu times the whole normal force (eq. 9), or times its elastic part, which makes gross sliding
/// take exactly Coulomb's impulse mu (1 + e) M v.
enum class FrictionLimit { total, elastic };
/// `open`: a line, with a wall for particles at z = 0, where it is fed, and an outlet at z = pipe_length. `none`:
/// nothing at the ends, for scenes that never reach them (no wall, no neighbour); only in cases written by hand.
enum class Ends { periodic, closed, open, none };
/// Semi-implicit Euler; leapfrog; or leapfrog with contact impulses integrated along the step (impulse_law.hpp).
enum class Integrator { euler, leapfrog, impulse };
/// `mixed_precision`: state, position differences and gaps in double, contact arithmetic and history in float.
enum class Precision { double_precision, mixed_precision };
/// How the height of the bed counts against the pipe when almost full (kernel/gas_slices.hpp).
enum class BedHeight { continuous, hard, strict };

/// Where the particles of a run come from; the kernel itself never looks at it.
enum class StartKind { random, placed, from };

/// One particle of a `[[start.particle]]` list.
struct Placed {
  double position[3];          ///< m
  double velocity[3];          ///< m/s
  double angular_velocity[3];  ///< rad/s
};

/// A station along the pipe; for the program only.
struct Probe {
  double position, interval;  ///< m, s
};

/// Whether particles enter and leave (feed.hpp, outlet.hpp). `particle_count` is then the most that are present at
/// once.
template <class Case>
inline constexpr bool is_line = Case::ends == Ends::open;

namespace detail {
/// Particles at the start.
template <class Case>
inline constexpr int start_count = [] {
  if constexpr (is_line<Case>)
    return Case::start_count;
  else
    return Case::particle_count;
}();

/// Where gravity leaves a bed: across the axis, `up` is the unit vector against it, along +y where it has no such part.
/// Steeper than 80 degrees (`is_steep`) there is no bed, and the gas takes the whole section.
struct BedDirection {
  double x = 0, y = 1;
  bool is_steep = false;
  constexpr explicit BedDirection(const double (&g)[3]) {
    const double across = square_root(g[0] * g[0] + g[1] * g[1]);
    if (across > 0 && !(g[0] == 0 && g[1] < 0)) x = -g[0] / across, y = -g[1] / across;
    is_steep = across < 0.17 * square_root(across * across + g[2] * g[2]);
  }
};

/// What all particles have in common. Coefficients of contacts are given for spheres of the reference radius and mass.
template <class Case, bool has_sizes = fixdem::has_sizes<Case>>
struct Spheres {
  static constexpr double pi = 3.14159265358979323846;
  static constexpr double radius = Case::diameter / 2;
  static constexpr double volume = pi / 6 * Case::diameter * Case::diameter * Case::diameter;
  static constexpr double mass = volume * Case::density;
  static constexpr double moment_of_inertia = 0.4 * mass * radius * radius;
  static constexpr double largest_radius = radius, smallest_radius = radius;
  static constexpr double reference_radius = radius, reference_mass = mass;
  static constexpr double reduced_radius_pair = radius / 2, reduced_mass_pair = mass / 2;
};
/// Of several sizes: the sphere of reference is the heaviest of the largest ones, and what the springs of a pair follow
/// from is taken as that of a wall: a reduced radius and mass as its own (contact_sizes.hpp scales them).
template <class Case>
struct Spheres<Case, true> {
  static constexpr double pi = 3.14159265358979323846;
  static constexpr double largest_radius = Case::largest_diameter / 2, smallest_radius = Case::smallest_diameter / 2;
  static constexpr double reference_radius = largest_radius;
  static constexpr double reference_mass =
      pi / 6 * Case::largest_diameter * Case::largest_diameter * Case::largest_diameter * Case::reference_density;
  static constexpr double reduced_radius_pair = reference_radius, reduced_mass_pair = reference_mass;
};
}  // namespace detail

/// Everything the step needs that follows from a case, evaluated at compile time.
template <class Case>
struct Derived : detail::Spheres<Case> {
  using Spheres = detail::Spheres<Case>;
  using Spheres::pi;
  static constexpr double pipe_radius = Case::pipe_diameter / 2;

  static constexpr bool has_ends = Case::ends == Ends::closed || is_line<Case>;
  static constexpr bool has_walls = Case::has_wall || has_ends;
  static constexpr bool is_periodic = Case::ends == Ends::periodic;
  static constexpr bool is_hertz = Case::normal == NormalLaw::hertz;

  // What a case need not say: its own member, or what holds without it.
#define FIXDEM_SAID(type, member, otherwise)  \
  static constexpr type member = [] {         \
    if constexpr (requires { Case::member; }) \
      return Case::member;                    \
    else                                      \
      return otherwise;                       \
  }()
  FIXDEM_SAID(double, wall_friction, Case::friction);
  FIXDEM_SAID(double, wall_restitution, Case::restitution);
  FIXDEM_SAID(FrictionLimit, friction_limit, FrictionLimit::total);
  FIXDEM_SAID(double, rolling_friction, 0.0);  ///< tangent of the slope on which a sphere just does not roll
  FIXDEM_SAID(double, wall_rolling_friction, (wall_friction > 0 ? rolling_friction : 0.0));
#undef FIXDEM_SAID
  /// Whether particles rotate. A kind of contact without friction has no tangential law and no history (ContactLaw).
  static constexpr bool has_rotation = Case::friction > 0 || (has_walls && wall_friction > 0);
  static constexpr bool has_rolling = rolling_friction > 0 || (has_walls && wall_rolling_friction > 0);

  static constexpr double shear_modulus = Case::youngs_modulus / (2 * (1 + Case::poisson_ratio));  // eq. (20)

  /// Normal stiffness: N/m^1.5 with Hertz (eqs. 16, 17), N/m with the linear law.
  static constexpr double stiffness_pair = is_hertz
                                               ? square_root(4 * Spheres::reduced_radius_pair) * Case::youngs_modulus /
                                                     (3 * (1 - Case::poisson_ratio * Case::poisson_ratio))
                                               : Case::normal_stiffness;
  static constexpr double stiffness_wall =
      is_hertz ? 4.0 / 3.0 * square_root(Spheres::reference_radius) /
                     ((1 - Case::poisson_ratio * Case::poisson_ratio) / Case::youngs_modulus +
                      (1 - Case::wall_poisson_ratio * Case::wall_poisson_ratio) / Case::wall_youngs_modulus)
               : Case::normal_stiffness;

  /// Tangential stiffness: k_t = value * sqrt(overlap) with Hertz (eqs. 21, 22), N/m with the linear law.
  static constexpr double tangential_stiffness_pair =
      is_hertz ? 2 * square_root(4 * Spheres::reduced_radius_pair) * shear_modulus / (2 - Case::poisson_ratio)
               : Case::tangential_stiffness;
  static constexpr double tangential_stiffness_wall =
      is_hertz ? 8 * square_root(Spheres::reference_radius) * shear_modulus / (2 - Case::poisson_ratio)
               : Case::tangential_stiffness;

  /// -ln e / sqrt(pi^2 + ln^2 e): the damping ratio of a linear oscillator that returns the restitution e.
  static constexpr double damping_ratio(double e) {
    return -logarithm(e) / square_root(pi * pi + logarithm(e) * logarithm(e));
  }

  /// Mass in eq. (26) for a pair and for a wall.
  static constexpr double damping_mass_pair =
      Case::damping_mass == DampingMass::reduced ? Spheres::reduced_mass_pair : Spheres::reference_mass;
  static constexpr double damping_mass_wall = Spheres::reference_mass;
  /// Mass in eq. (23): 2 sqrt(2 M k) between spheres, 2 sqrt(m k) at a wall.
  static constexpr double critical_mass_pair = 2 * Spheres::reduced_mass_pair;
  static constexpr double critical_mass_wall = Spheres::reference_mass;

  /// Normal damping: eta = value * overlap^(1/4) with Hertz (eq. 26); kg/s, constant, with the linear law.
  static constexpr double damping(double stiffness, double damping_mass, double critical_mass, double restitution) {
    const double ratio = damping_ratio(restitution);
    const double alpha = 2.2360679774997897 * ratio;  // closed form of eq. (30); sqrt(5)
    if (is_hertz) return alpha * square_root(damping_mass * stiffness);
    if (Case::damping == Damping::critical) return 2 * square_root(critical_mass * stiffness);
    return 2 * ratio * square_root(damping_mass * stiffness);
  }
  static constexpr double damping_pair =
      damping(stiffness_pair, damping_mass_pair, critical_mass_pair, Case::restitution);
  static constexpr double damping_wall =
      damping(stiffness_wall, damping_mass_wall, critical_mass_wall, wall_restitution);

  /// Tangential damping: equal to the normal one (eq. 31), or critical with k_t (eq. 23).
  static constexpr double tangential_damping_pair =
      Case::damping == Damping::critical ? 2 * square_root(critical_mass_pair * tangential_stiffness_pair)
                                         : damping_pair;
  static constexpr double tangential_damping_wall =
      Case::damping == Damping::critical ? 2 * square_root(critical_mass_wall * tangential_stiffness_wall)
                                         : damping_wall;

  static constexpr double slice_length = Case::pipe_length / Case::slice_count;

  static constexpr double up[2] = {detail::BedDirection(Case::gravity).x, detail::BedDirection(Case::gravity).y};
  /// One particle alone makes no bed anyway.
  static constexpr bool is_steep = Case::particle_count > 1 && detail::BedDirection(Case::gravity).is_steep;
};

/// Height of a place over the axis of the pipe, against the part of gravity across it, m: y where gravity is along -y.
template <class Case>
double height_of(const double* x) {
  using D = Derived<Case>;
  if constexpr (D::up[0] == 0 && D::up[1] == 1)
    return x[1];
  else
    return D::up[0] * x[0] + D::up[1] * x[1];
}

/// Positions are held half a step ahead of velocities.
template <class Case>
inline constexpr bool holds_positions_ahead = Case::integrator != Integrator::euler;

template <class Case>
inline constexpr bool takes_impulses = Case::integrator == Integrator::impulse;

/// Gravity and the velocity of the gas are not the case's but set between steps by another program (coupling.hpp): for
/// a struct that derives from a generated case and adds `static constexpr bool is_coupled = true;`.
template <class Case>
inline constexpr bool is_coupled = [] {
  if constexpr (requires { Case::is_coupled; })
    return Case::is_coupled;
  else
    return false;
}();

template <class Case>
inline constexpr bool is_mixed = Case::precision == Precision::mixed_precision;

/// What contacts are computed in.
template <class Case>
using Real = std::conditional_t<is_mixed<Case>, float, double>;

/// Lanes of a contact loop on a machine that computes on W doubles at once.
template <class Case, int W>
inline constexpr int contact_lanes = is_mixed<Case>&& W > 1 ? 2 * W : W;

/// Whether the gas model holds under this gravity: it must say where a bed lies, or that there is none (Derived::up,
/// is_steep). One particle alone makes no bed.
constexpr bool gas_takes_gravity(const double* gravity, bool has_bed) {
  return !has_bed || gravity[0] != 0 || gravity[1] != 0 || gravity[2] != 0;
}

}  // namespace fixdem
