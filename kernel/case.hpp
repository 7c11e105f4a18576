// What a case is: the constants that a generated header provides, and what follows from them.
//
// A case file (cases/*.toml) becomes a struct of `static constexpr` values in namespace fixdem::cases (tools/casegen
// writes it); everything in the kernel is a template over that struct. This file gives the vocabulary of choices, the
// coefficients of the contact law derived once at compile time, the capacities, and the refusals: a configuration
// that makes no sense does not compile, and the message says what to change. SI units throughout.
//
// Equation numbers are those of Tsuji, Tanaka & Ishida, Powder Technology 71 (1992) 239-250.
#pragma once

#include <type_traits>

#include "constant_math.hpp"

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
/// `open`: nothing at the ends, for scenes that never reach them (no wall, no neighbour); only in cases written by
/// hand.
enum class Ends { periodic, closed, open };
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

/// Everything the step needs that follows from a case, evaluated at compile time.
template <class Case>
struct Derived {
  static constexpr double pi = 3.14159265358979323846;
  static constexpr double radius = Case::diameter / 2;
  static constexpr double volume = pi / 6 * Case::diameter * Case::diameter * Case::diameter;
  static constexpr double mass = volume * Case::density;
  static constexpr double moment_of_inertia = 0.4 * mass * radius * radius;
  static constexpr double pipe_radius = Case::pipe_diameter / 2;

  static constexpr bool has_ends = Case::ends == Ends::closed;
  static constexpr bool has_walls = Case::has_wall || has_ends;
  static constexpr bool is_periodic = Case::ends == Ends::periodic;
  static constexpr bool is_hertz = Case::normal == NormalLaw::hertz;

  // What a case may say of its walls; the particles' own where it says nothing.
  static constexpr double wall_friction = [] {
    if constexpr (requires { Case::wall_friction; })
      return Case::wall_friction;
    else
      return Case::friction;
  }();
  static constexpr double wall_restitution = [] {
    if constexpr (requires { Case::wall_restitution; })
      return Case::wall_restitution;
    else
      return Case::restitution;
  }();
  static constexpr FrictionLimit friction_limit = [] {
    if constexpr (requires { Case::friction_limit; })
      return Case::friction_limit;
    else
      return FrictionLimit::total;
  }();
  /// Whether particles rotate. A kind of contact without friction has no tangential law and no history (ContactLaw).
  static constexpr bool has_rotation = Case::friction > 0 || (has_walls && wall_friction > 0);

  static constexpr double shear_modulus = Case::youngs_modulus / (2 * (1 + Case::poisson_ratio));  // eq. (20)

  /// Normal stiffness: N/m^1.5 with Hertz (eqs. 16, 17), N/m with the linear law.
  static constexpr double stiffness_pair =
      is_hertz ? square_root(2 * radius) * Case::youngs_modulus / (3 * (1 - Case::poisson_ratio * Case::poisson_ratio))
               : Case::normal_stiffness;
  static constexpr double stiffness_wall =
      is_hertz ? 4.0 / 3.0 * square_root(radius) /
                     ((1 - Case::poisson_ratio * Case::poisson_ratio) / Case::youngs_modulus +
                      (1 - Case::wall_poisson_ratio * Case::wall_poisson_ratio) / Case::wall_youngs_modulus)
               : Case::normal_stiffness;

  /// Tangential stiffness: k_t = value * sqrt(overlap) with Hertz (eqs. 21, 22), N/m with the linear law.
  static constexpr double tangential_stiffness_pair =
      is_hertz ? 2 * square_root(2 * radius) * shear_modulus / (2 - Case::poisson_ratio) : Case::tangential_stiffness;
  static constexpr double tangential_stiffness_wall =
      is_hertz ? 8 * square_root(radius) * shear_modulus / (2 - Case::poisson_ratio) : Case::tangential_stiffness;

  /// -ln e / sqrt(pi^2 + ln^2 e): the damping ratio of a linear oscillator that returns the restitution e.
  static constexpr double damping_ratio(double e) {
    return -logarithm(e) / square_root(pi * pi + logarithm(e) * logarithm(e));
  }

  /// Mass in eq. (26) for a pair and for a wall.
  static constexpr double damping_mass_pair = Case::damping_mass == DampingMass::reduced ? mass / 2 : mass;
  static constexpr double damping_mass_wall = mass;

  /// Normal damping: eta = value * overlap^(1/4) with Hertz (eq. 26); kg/s, constant, with the linear law.
  static constexpr double damping(double stiffness, double damping_mass, double restitution) {
    const double ratio = damping_ratio(restitution);
    const double alpha = 2.2360679774997897 * ratio;  // closed form of eq. (30); sqrt(5)
    if (is_hertz) return alpha * square_root(damping_mass * stiffness);
    if (Case::damping == Damping::critical) return 2 * square_root(mass * stiffness);  // eq. (23)
    return 2 * ratio * square_root(damping_mass * stiffness);
  }
  static constexpr double damping_pair = damping(stiffness_pair, damping_mass_pair, Case::restitution);
  static constexpr double damping_wall = damping(stiffness_wall, damping_mass_wall, wall_restitution);

  /// Tangential damping: equal to the normal one (eq. 31), or critical with k_t (eq. 23).
  static constexpr double tangential_damping_pair =
      Case::damping == Damping::critical ? 2 * square_root(mass * tangential_stiffness_pair) : damping_pair;
  static constexpr double tangential_damping_wall =
      Case::damping == Damping::critical ? 2 * square_root(mass * tangential_stiffness_wall) : damping_wall;

  static constexpr double slice_length = Case::pipe_length / Case::slice_count;
};

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

/// How far beyond touching the outer list of pairs reaches (near_list.hpp), in diameters. With gas it answers who
/// floats as well, for which 0.1 d must be left (floaters.hpp).
template <class Case>
inline constexpr double outer_margin = Case::has_gas ? 0.3 : 0.25;

/// Cells in which particles are ordered (order.hpp): no side is shorter than d + outer margin, and there are no more of
/// them than twice the particles. Across the pipe they cover the places that centres can have.
template <class Case>
struct Cells {
  static constexpr double width = Case::pipe_diameter - Case::diameter;
  static constexpr double whole(double n) { return n > 1 ? n : 1; }
  static constexpr double side = [] {
    double side = (1 + outer_margin<Case>)*Case::diameter;
    while (whole(width / side) * whole(width / side) * whole(Case::pipe_length / side) >
           2.0 * Case::particle_count + 64)
      side *= 1.25;
    return side;
  }();
  static constexpr int across = static_cast<int>(whole(width / side));
  static constexpr int along = static_cast<int>(whole(Case::pipe_length / side));
  static constexpr int count = across * across * along;
  static constexpr double length = Case::pipe_length / along;  ///< of a slab of cells
};

/// Particles in a chunk of the pipe. Smaller chunks waste lanes and start more loops, so 128 at least, or 64 in a scene
/// of less than 512, which may have to fit a small board; in a wide pipe so many that those within reach lie in the
/// next two or three. Never more than the scene has. Measured with 64 and 128 of 1000 particles, million
/// particle-steps/s on Zen 5: settled bed 123 and 127 (AVX2 86 and 90), mixed 136 and 153, agitated 236 and 265; 192 is
/// no better.
constexpr int particles_per_chunk(int particle_count, double pipe_diameter, double diameter) {
  const int whole_scene = (particle_count + 15) / 16 * 16, usual = particle_count < 512 ? 64 : 128;
  const double wide = 0.5 * (pipe_diameter / diameter) * (pipe_diameter / diameter);
  const int size = wide < usual ? usual : (wide < whole_scene ? static_cast<int>(wide) / 16 * 16 : whole_scene);
  return size < whole_scene ? size : whole_scene;
}

/// A chunk beyond this would outgrow the stack (its slots are booked there) and the 32-bit offsets of its force rows.
inline constexpr int largest_chunk = 1 << 20;

/// Chunks that a tile of several steps needs (tiles.hpp).
constexpr int chunks_for_tile(int tile_steps) { return tile_steps == 1 ? 1 : 2 * tile_steps + 4; }

/// Fixed sizes of the arrays. Each says why it is what it is and what happens when it is not enough.
template <class Case>
struct Capacity {
  /// Contacts in a batch, on every machine: it is the data layout, not the register.
  static constexpr int batch = is_mixed<Case> ? 16 : 8;
  static constexpr unsigned short all_lanes = static_cast<unsigned short>((1u << batch) - 1);  ///< a bit for each

  /// Near pairs of one particle. Twelve equal spheres touch a central one at most; the maximum number observed at a
  /// list cut of 1.05 d is 12. The case can set it (`[capacity] neighbours`, default 14). Overflow: the run stops.
  static constexpr int neighbours = Case::neighbour_capacity;

  static constexpr double ratio = Case::pipe_diameter / Case::diameter;
  static constexpr int chunk_size = particles_per_chunk(Case::particle_count, Case::pipe_diameter, Case::diameter);
  static constexpr int chunks = (Case::particle_count + chunk_size - 1) / chunk_size;

  /// Particles in the order between one and the last that it is compared with: one slab of cells and two rows. Spheres
  /// whose centres lie in a slab fill 0.7405 of a hexagonal prism around the pipe, one diameter longer than the slab,
  /// at most; 3 % are added for overlap. Only particles that overlap more, or that no wall holds, can exceed it: the
  /// run stops.
  static constexpr int in_reach = [] {
    constexpr double slab = Cells<Case>::length / Case::diameter + 1, row = Cells<Case>::side / Case::diameter + 1;
    constexpr double per_volume = 1.03 * 0.7405 / 0.5236;  // spheres of unit diameter
    constexpr double most = per_volume * (0.8661 * ratio * ratio + 2 * row * ratio) * slab + 8;
    return most < Case::particle_count ? static_cast<int>(most) : Case::particle_count;
  }();
  /// Chunks behind its own in which the partners of a chunk's particles lie.
  static constexpr int span =
      (chunk_size - 1 + in_reach) / chunk_size < chunks - 1 ? (chunk_size - 1 + in_reach) / chunk_size : chunks - 1;

  /// Pairs owned by the particles of one chunk, each pair counted once: half the neighbours of each, and one batch of
  /// slack. Observed: 2.3 owned near pairs per particle on average in a bed. Overflow: the run stops.
  static constexpr int chunk_pairs = (chunk_size * neighbours / 2 + 2 * batch - 1) / batch * batch;
  /// Pairs across the periodic ends: a section of a close packing has 2.7 (D/d)^2 contacts.
  static constexpr int wrap_pairs = chunk_pairs + static_cast<int>(6 * ratio * ratio) / batch * batch;

  /// Pairs of the outer list, of a chunk and across the ends. Twelve neighbours of a close packing lie within its
  /// margin, of random packings hardly more. Overflow: the margin of the list is reduced (listing.hpp).
  static constexpr int outer_per_particle = neighbours / 2 + 1 > 8 ? neighbours / 2 + 1 : 8;
  static constexpr int outer_pairs = chunk_size * outer_per_particle + batch;
  static constexpr int outer_wrap_pairs = 2 * wrap_pairs;

  /// Contacts whose history is carried over while particles are sorted. Equal spheres that do not overlap touch twelve
  /// others at most, and fewer beside a wall, so six for each particle are enough for any packing; 64 are added for
  /// those that have just opened. Observed: 2.4 per particle in a settled bed. Overflow: the run stops.
  static constexpr int histories = 6 * Case::particle_count + 64;

  /// Chunks that a chunk's pairs reach into in a pipe that is a third full.
  static constexpr int usual_span = (chunk_size - 1 + in_reach / 3) / chunk_size;

  /// Steps that are computed together (tiles.hpp) where the state of the scene exceeds the caches, fewer where a step
  /// concerns more particles at a time; each has a ring of force rows. At most `order_interval` (near_list.hpp). A case
  /// can set it; results do not depend on it.
  static constexpr int tile_steps = [] {
    constexpr int concerned = (usual_span + 1) * chunk_size, most = concerned <= 512 ? 16 : (concerned <= 1024 ? 8 : 4);
    if constexpr (requires { Case::tile_steps; })
      return Case::tile_steps;
    else
      return Case::particle_count >= 16384 && chunks >= chunks_for_tile(most) ? most : 1;
  }();
};

/// Whether the gas model holds under this gravity. It takes the height of the bed along y (gas_slices.hpp), so a bed
/// must lie at the bottom of a horizontal pipe. One particle alone makes no bed while it flies, and none but at the
/// bottom.
constexpr bool gas_takes_gravity(const double* gravity, bool has_bed) {
  return gravity[0] == 0 && (has_bed ? gravity[1] < 0 && gravity[2] == 0 : gravity[1] <= 0);
}

/// Refuses what makes no sense. Casegen refuses the same with file and line; this is for hand-written cases.
template <class Case>
struct Checked {
  static_assert(Case::particle_count >= 1, "fixdem: [particles] count must be at least 1");
  static_assert(Case::diameter > 0 && Case::density > 0, "fixdem: [particles] diameter and density must be positive");
  static_assert(Case::diameter < Case::pipe_diameter,
                "fixdem: the particle is wider than the pipe: lower [particles] diameter or raise [pipe] diameter");
  static_assert(Case::restitution > 0 && Case::restitution <= 1,
                "fixdem: [material] restitution must be above 0 and at most 1");
  static_assert(Case::friction >= 0, "fixdem: [material] friction must not be negative");
  static_assert(Derived<Case>::wall_restitution > 0 && Derived<Case>::wall_restitution <= 1,
                "fixdem: [material] wall_restitution must be above 0 and at most 1");
  static_assert(Derived<Case>::wall_friction >= 0, "fixdem: [material] wall_friction must not be negative");
  static_assert(Derived<Case>::has_walls || (Derived<Case>::wall_friction == Case::friction &&
                                             Derived<Case>::wall_restitution == Case::restitution),
                "fixdem: [material] wall_friction and wall_restitution need a wall: set [pipe] wall = true or ends = "
                "\"closed\", or remove them");
  static_assert(Derived<Case>::friction_limit == FrictionLimit::total || Derived<Case>::has_rotation,
                "fixdem: friction_limit = \"elastic\" needs [material] friction above 0");
  static_assert(
      Derived<Case>::friction_limit == FrictionLimit::total || Case::slider != Slider::paper,
      "fixdem: friction_limit = \"elastic\" needs slider = \"clip\" or \"exact\": eqs. (10)-(12) to the letter use "
      "the whole force");
  static_assert(Capacity<Case>::chunk_size <= largest_chunk,
                "fixdem: a slice of the pipe holds too many particles: lower [pipe] diameter or [particles] count");
  static_assert(Case::normal != NormalLaw::hertz || (Case::poisson_ratio >= 0 && Case::poisson_ratio <= 0.5),
                "fixdem: [material] poisson_ratio must lie between 0 and 0.5");
  static_assert(Case::normal != NormalLaw::hertz || Case::youngs_modulus > 0,
                "fixdem: [material] youngs_modulus must be positive");
  static_assert(Case::normal != NormalLaw::linear || (Case::normal_stiffness > 0 && Case::tangential_stiffness > 0),
                "fixdem: normal = \"linear\" needs [contact] normal_stiffness and tangential_stiffness above 0");
  static_assert(Case::damping != Damping::critical || Case::normal == NormalLaw::linear,
                "fixdem: damping = \"critical\" belongs to normal = \"linear\"; with \"hertz\" use \"restitution\"");
  static_assert(Case::integrator != Integrator::impulse || Case::slider != Slider::paper,
                "fixdem: integrator = \"impulse\" needs slider = \"exact\" or \"clip\": with \"paper\" impacts do not "
                "converge, so nothing would be gained");
  static_assert(Case::ends != Ends::periodic || Case::pipe_length >= 4 * Case::diameter,
                "fixdem: a periodic pipe must be at least 4 particle diameters long: raise [pipe] length");
  static_assert(Case::ends != Ends::closed || Case::pipe_length >= 2 * Case::diameter,
                "fixdem: a closed pipe must be at least 2 particle diameters long: raise [pipe] length");
  static_assert(!Case::has_gas || Case::has_wall, "fixdem: the gas model needs the pipe wall: set [pipe] wall = true");
  static_assert(
      !Case::has_gas || gas_takes_gravity(Case::gravity, Case::particle_count > 1),
      "fixdem: the gas model takes the height of the bed along y: with gas, [run] gravity must be [0, -g, 0]");
  static_assert(Case::time_step > 0, "fixdem: [run] time_step must be positive");
  static_assert(Case::neighbour_capacity >= 2 && Case::neighbour_capacity <= 30,
                "fixdem: [capacity] neighbours must lie between 2 and 30");
  static constexpr bool ok = true;
};

}  // namespace fixdem
