// The constants of a case as run-time values, for the parts of the program that are compiled once for all cases.
//
// case_facts<Case>() copies them out of the generated header; nothing here is looked at inside a step. SI units.
#pragma once

#include <string>
#include <vector>

#include "line_facts.hpp"
#include "particle_kinds.hpp"

namespace fixdem::program {

/// Springs and dampers of one kind of contact (kernel/case.hpp): factors of overlap^(3/2), ^(1/2) and ^(1/4) with
/// Hertz, N/m and kg/s with the linear law; and what they follow from.
struct ContactCoefficients {
  double stiffness, tangential_stiffness, damping, tangential_damping, friction, restitution;
  double rolling_friction = 0;
};

struct CaseFacts : ParticleKinds {
  const char* name;
  const char* title;
  const char* source;
  unsigned long long source_hash;
  const char* keys = "";  ///< "[table] key = value", one a line; empty in a case that casegen has not written

  int particle_count;  ///< in a line the most that may be present at once
  double pipe_diameter, pipe_length;
  bool is_periodic, has_wall, has_gas, has_rotation, has_rolling;
  double gas_velocity;
  int slice_count;
  double gravity[3];
  double time_step, duration;
  double log_interval, frame_interval, sample_interval;
  double contact_interval = 0;  ///< between files of contact forces; 0: none
  double checkpoint_interval;   ///< 0: by the clock
  double reference_speed;
  double max_overlap;      ///< in radii of the smallest particle; the kernel stops beyond
  double overlap_warning;  ///< in the same
  double stability_limit;  ///< of the time step, in stable steps (stability_watch.hpp)
  bool text_frames, dump, energy_ledger;

  NormalLaw normal;
  TangentialLaw tangential;
  Slider slider;
  FrictionLimit friction_limit;
  DampingMass damping_mass;
  Damping damping;
  BedHeight bed_height;
  Integrator integrator;
  Precision precision;
  double stiffness_pair, stiffness_wall;  ///< N/m^1.5 (hertz) or N/m (linear): only for advice about the time step
  ContactCoefficients pair_contact, wall_contact;
  double pair_radius, pair_mass;  ///< R* and M of pair_contact (contact_kinds.hpp); wall_contact: radius and mass

  StartKind start;
  unsigned long long seed;
  double start_velocity;
  bool start_keeps_motion;
  const char* start_from;
  const Placed* placed;

  LineFacts line;

  const char* instruction_set;  ///< of the translation unit that holds the kernel
  const char* compiler;
  const char* kernel;  ///< checksum of its source, where make gave one

  /// Particles that are there at the start.
  int start_count() const { return line.is_open ? line.start_count : particle_count; }
  /// What [capacity] neighbours may be at most.
  int most_neighbours() const { return has_sizes() ? 160 : 30; }
};

/// What the compiler was allowed to use, from its own macros.
constexpr const char* compiled_instruction_set() {
#if defined(__AVX512F__)
  return "AVX-512";
#elif defined(__AVX2__) && defined(__FMA__)
  return "AVX2 with FMA";
#elif defined(__AVX__)
  return "AVX";
#elif defined(__x86_64__)
  return "x86-64 baseline (SSE2)";
#elif defined(__ARM_FEATURE_SVE)
  return "AArch64 SVE";
#elif defined(__aarch64__)
  return "AArch64 NEON";
#else
  return "generic";
#endif
}

constexpr const char* compiler_name() {
#if defined(__clang__)
  return __VERSION__;  // begins with its name
#else
  return "g++ " __VERSION__;
#endif
}

#ifndef FIXDEM_KERNEL
#define FIXDEM_KERNEL "unknown"
#endif

template <class Case>
constexpr CaseFacts case_facts() {
  using D = Derived<Case>;
  CaseFacts f{};
  static_cast<ParticleKinds&>(f) = particle_kinds<Case>();
  f.name = Case::name, f.title = Case::title, f.source = Case::source, f.source_hash = Case::source_hash;
  if constexpr (requires { Case::keys; }) f.keys = Case::keys;
  f.particle_count = Case::particle_count;
  f.has_rotation = D::has_rotation, f.has_rolling = D::has_rolling, f.friction_limit = D::friction_limit;
  f.pipe_diameter = Case::pipe_diameter, f.pipe_length = Case::pipe_length;
  f.is_periodic = D::is_periodic, f.has_wall = Case::has_wall, f.has_gas = Case::has_gas;
  f.gas_velocity = Case::gas_velocity, f.slice_count = Case::slice_count;
  for (int k = 0; k < 3; ++k) f.gravity[k] = Case::gravity[k];
  f.time_step = Case::time_step, f.duration = Case::duration;
  f.log_interval = Case::log_interval, f.frame_interval = Case::frame_interval;
  f.sample_interval = Case::sample_interval, f.checkpoint_interval = Case::checkpoint_interval;
  if constexpr (requires { Case::contact_interval; }) f.contact_interval = Case::contact_interval;
  f.line = line_facts<Case>();
  f.reference_speed = Case::reference_speed;
  f.max_overlap = Case::max_overlap, f.overlap_warning = Case::overlap_warning;
  f.stability_limit = Case::stability_limit;
  f.text_frames = Case::text_frames, f.dump = Case::dump, f.energy_ledger = Case::energy_ledger;
  f.normal = Case::normal, f.tangential = Case::tangential, f.slider = Case::slider;
  f.damping_mass = Case::damping_mass, f.damping = Case::damping;
  f.bed_height = Case::gas_bed_height, f.integrator = Case::integrator;
  f.precision = Case::precision;
  f.stiffness_pair = D::stiffness_pair, f.stiffness_wall = D::stiffness_wall;
  f.pair_contact = {
      D::stiffness_pair, D::tangential_stiffness_pair, D::damping_pair, D::tangential_damping_pair, Case::friction,
      Case::restitution, D::rolling_friction};
  f.wall_contact = {
      D::stiffness_wall, D::tangential_stiffness_wall, D::damping_wall,         D::tangential_damping_wall,
      D::wall_friction,  D::wall_restitution,          D::wall_rolling_friction};
  f.pair_radius = D::reduced_radius_pair, f.pair_mass = D::reduced_mass_pair;
  f.start = Case::start, f.seed = Case::seed, f.start_velocity = Case::start_velocity;
  f.start_keeps_motion = Case::start_keeps_motion, f.start_from = Case::start_from, f.placed = Case::placed;
  f.instruction_set = compiled_instruction_set();
  f.compiler = compiler_name();
  f.kernel = FIXDEM_KERNEL;
  return f;
}

/// Names of what is compiled in, in a fixed order: laws, walls, gas, integrator.
std::vector<std::string> features(const CaseFacts&);
const char* integrator_name(Integrator);
const char* precision_name(Precision);  ///< as in a case file

}  // namespace fixdem::program
