// What a case file says, as plain data.
//
// The reader fills one `CaseValues` from a TOML file; the member initialisers are the defaults of the case format and
// the only place where they are written (the table of keys in cases/README.md prints them from here). Defaults that
// follow from other keys (the wall's material, slice lengths, intervals) are filled in by `complete`. SI units.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "kernel/sizes.hpp"

namespace fixdem::casegen {

using Vector3 = std::array<double, 3>;

/// One entry of `[[particles.species]]`.
struct Species {
  std::string name;  // its number, unless given
  std::int64_t count = 0;
  double diameter = 0;  // m
  double density = 0;   // kg/m3; that of [particles], unless given
};

/// One entry of `[[start.particle]]`.
struct PlacedParticle {
  std::string species;  // number or name as written, the number once it is known to be one; empty without species
  Vector3 position{};   // m
  Vector3 velocity{};   // m/s
  Vector3 angular_velocity{};  // rad/s
};

struct CaseValues {
  std::string title;

  std::int64_t count = 0;  // with species the sum of theirs
  double diameter = 0;     // m; 0 with several sizes
  double density = 0;      // kg/m3; with species the default of theirs

  bool has_species = false;
  std::vector<Species> species;

  bool has_distribution = false;  // of diameters
  std::string size_distribution;
  double size_minimum = 0, size_maximum = 0;  // m
  double size_mean = 0, size_deviation = 0;   // m
  double size_median = 0, size_spread = 0;    // m; standard deviation of the logarithm
  std::vector<double> size_diameters;         // m, sieves
  std::vector<double> size_below;             // share below each
  std::string size_weight = "volume";
  std::int64_t size_seed = 1;

  /// Consecutive particles, by number, that are equal; empty where all are. Follows from species or the distribution.
  std::vector<SizeRun> sizes;
  bool has_sizes() const { return !sizes.empty(); }

  double youngs_modulus = 0;  // Pa; 0 with the linear law, which does not use it
  double poisson_ratio = 0;
  double restitution = 0;
  double friction = 0;
  double wall_youngs_modulus = 0;  // Pa; infinity is a rigid wall
  double wall_poisson_ratio = 0;
  double wall_friction = 0;
  double wall_restitution = 0;
  double rolling_friction = 0;
  double wall_rolling_friction = 0;

  std::string normal = "hertz";
  std::string tangential = "displacement";
  std::string slider = "clip";
  std::string friction_limit = "total";
  std::string damping_mass = "reduced";
  std::string damping = "restitution";
  double normal_stiffness = 0;      // N/m; 0 with Hertz
  double tangential_stiffness = 0;  // N/m; 0 with Hertz

  double pipe_diameter = 0;  // m
  double pipe_length = 0;    // m
  std::string ends;
  bool wall = true;
  bool has_walls() const { return wall || ends == "closed"; }
  bool has_rotation() const { return friction > 0 || (has_walls() && wall_friction > 0); }

  // What a wall has where the file says nothing of it.
  double default_wall_friction() const { return friction; }
  double default_wall_restitution() const { return restitution; }
  double default_wall_rolling_friction() const { return wall_friction > 0 ? rolling_friction : 0; }

  bool has_gas = false;
  double gas_velocity = 0;      // m/s, superficial
  double gas_density = 0;       // kg/m3
  double gas_viscosity = 0;     // m2/s, kinematic
  double gas_bed_diameter = 0;  // m
  std::int64_t gas_update_interval = 1;
  std::int64_t gas_floater_interval = 25;
  std::string gas_bed_height = "continuous";
  double gas_slice_length = 0;  // m
  std::int64_t slice_count = 1;

  std::string arrangement;  // "random", or empty
  std::int64_t seed = 1;
  double start_velocity = 0;  // m/s
  std::string start_from;     // name of another case, or empty
  std::string start_motion = "stop";
  std::vector<PlacedParticle> placed;

  double time_step = 0;  // s
  double duration = 0;   // s
  std::string integrator = "euler";
  std::string precision = "double";
  Vector3 gravity{0, -9.81, 0};  // m/s2
  double reference_speed = 0;    // m/s
  double max_overlap = 0.5;      // in particle radii
  double overlap_warning = 0.1;  // in particle radii
  double stability_limit = 1.5;  // in stable steps

  std::int64_t neighbour_capacity = 14;
  std::int64_t tile_steps = 0;     // 0: the kernel chooses
  std::int64_t memory_budget = 0;  // bytes; 0: none

  double log_interval = 0;    // s
  double frame_interval = 0;  // s; 0: no frames
  std::string frame_data = "binary";
  double sample_interval = 0.01;   // s
  double checkpoint_interval = 0;  // s; 0: by the clock
  bool dump = false;
  bool energy_ledger = true;
};

}  // namespace fixdem::casegen
