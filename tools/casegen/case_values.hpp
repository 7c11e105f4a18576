// What a case file says, as plain data.
//
// The reader fills one `CaseValues` from a TOML file; the member initialisers are the defaults of the case format and
// the only place where they are written (the table of keys in cases/README.md prints them from here). Defaults that
// follow from other keys (the wall's material, slice lengths, intervals) are filled in by `complete`. SI units.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "kernel/sizes.hpp"
#include "kernel/time_table.hpp"

namespace fixdem::casegen {

using Vector3 = std::array<double, 3>;
/// A value that may change in time; one row: it does not.
using TimeTable = std::vector<TimeValue>;

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

/// One entry of `[[probe]]`.
struct Probe {
  double position = 0;  // m
  double interval = 0;  // s
};

struct CaseValues {
  std::string title;

  std::int64_t count = 0;     // at the start; with species the sum of theirs
  double diameter = 0;        // m; 0 with several sizes
  double density = 0;         // kg/m3; with species the default of theirs
  std::int64_t capacity = 0;  // of a line: most particles that are present at once
  std::int64_t most_present() const { return is_line() ? capacity : count; }

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
  /// In a line those of the particles at the start, and behind them those that are fed with equal probability.
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
  double inclination = 0;  // degrees
  bool is_line() const { return ends == "open"; }
  bool has_walls() const { return wall || ends == "closed" || is_line(); }
  bool has_rotation() const { return friction > 0 || (has_walls() && wall_friction > 0); }

  // What a wall has where the file says nothing of it.
  double default_wall_friction() const { return friction; }
  double default_wall_restitution() const { return restitution; }
  double default_wall_rolling_friction() const { return wall_friction > 0 ? rolling_friction : 0; }

  TimeTable feed_rate{{0, 0}};       // kg/s
  double feed_start = 0;             // s
  double feed_length = 0;            // m
  double feed_velocity = 0.5;        // m/s
  std::vector<double> feed_mixture;  // share of the mass of each species
  std::int64_t feed_seed = 1;

  bool has_gas = false;
  TimeTable gas_velocity{{0, 0}};  // m/s, superficial
  double gas_density = 0;          // kg/m3
  double gas_viscosity = 0;        // m2/s, kinematic
  double gas_bed_diameter = 0;     // m
  std::int64_t gas_update_interval = 1;
  std::int64_t gas_floater_interval = 25;
  std::string gas_bed_height = "continuous";
  double gas_full_gap = 0;      // m; 0: the diameter of the particles
  double gas_slice_length = 0;  // m
  std::int64_t slice_count = 1;
  bool gas_compressible = false;
  double gas_outlet_pressure = 101325;  // Pa
  double gas_temperature = 293.15;      // K
  double gas_constant = 287.06;         // J/(kg K)
  bool gas_storage = false;
  double gas_supply_volume = 0;                         // m3
  double gas_inlet_pressure = 0;                        // Pa; 0: the velocity is given
  double gas_blower_flow = 0, gas_blower_pressure = 0;  // m3/s, Pa; 0: there is no blower
  bool has_blower() const { return gas_blower_flow > 0 || gas_blower_pressure > 0; }

  std::string arrangement;  // "random", or empty
  std::int64_t seed = 1;
  double start_velocity = 0;  // m/s
  std::string start_from;     // name of another case, or empty
  std::string start_motion = "stop";
  std::vector<PlacedParticle> placed;
  /// A line into which all particles are fed.
  bool starts_empty() const {
    return is_line() && count == 0 && std::ranges::all_of(species, [](const Species& s) { return s.count == 0; });
  }

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
  double slice_interval = 0;    // s; 0: none
  double contact_interval = 0;  // s; 0: none
  double statistics_from = -1;  // s; below 0: half of the run
  std::vector<Probe> probes;
};

}  // namespace fixdem::casegen
