// Writes a case as a C++ struct that the kernel takes as template argument (kernel/case.hpp says what it must have).
//
// Floating-point numbers are hexadecimal, so that they read back bit for bit, with the shortest decimal form beside
// them. The text depends on the case file's bytes and its name alone: no date, no path of the machine.
#include "header_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "checks.hpp"
#include "header_members.hpp"
#include "schema.hpp"
#include "sizes.hpp"

namespace fixdem::casegen {
namespace {

/// For comments: a backslash or a line break in a path would change the meaning of the next line.
std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 32 || c == '\\'; }, '?');
  return text;
}

/// What keys that are in a header only if they say something have where they say nothing.
CaseValues silent_of(const CaseValues& values) {
  CaseValues silent;
  silent.wall_rolling_friction = values.default_wall_rolling_friction();  // with the friction that the wall has
  silent.wall_friction = values.default_wall_friction(), silent.wall_restitution = values.default_wall_restitution();
  return silent;
}

/// Diameter and density of equal spheres; of several sizes those of all particles, by number.
void write_sizes(Members& members, const CaseValues& v) {
  if (!v.has_sizes()) {
    members.real("diameter", v.diameter, "m");
    members.real("density", v.density, "kg/m3");
    return;
  }
  const SizeFigures sizes = figures_of(v);
  members.real("largest_diameter", sizes.largest, "m");
  members.real("smallest_diameter", sizes.smallest, "m");
  members.real("reference_density", sizes.reference_density, "kg/m3, of the heaviest of the largest");
  members.real("mean_volume", sizes.mean_volume, "m3");
  members.whole("species_count", static_cast<std::int64_t>(v.species.size()));
  if (!v.species.empty()) {
    std::string names;
    for (const auto& species : v.species) names += (names.empty() ? "" : ", ") + literal(species.name);
    members.add("const char*", "species_names[]", "{" + names + "}", "");
  }
  fmt::memory_buffer list;
  for (const auto& [count, diameter, density, species] : v.sizes)
    fmt::format_to(std::back_inserter(list), "\n      {{{}, {:a}, {:a}, {}}},", count, diameter, density, species);
  members.add("SizeRun", "sizes[]", "{" + fmt::to_string(list) + "\n  }", "count, diameter, density, species");
  if (v.is_line()) members.whole("first_fed_kind", v.count);
}

void write_physics(Members& members, const CaseValues& v) {
  const CaseValues silent = silent_of(v);
  members.heading("particles and material");
  members.whole("particle_count", v.most_present());
  write_start_count(members, v);
  write_sizes(members, v);
  members.real("youngs_modulus", v.youngs_modulus, "Pa");
  members.real("poisson_ratio", v.poisson_ratio, "");
  members.real("restitution", v.restitution, "");
  members.real("friction", v.friction, "");
  members.real("wall_youngs_modulus", v.wall_youngs_modulus, "Pa");
  members.real("wall_poisson_ratio", v.wall_poisson_ratio, "");
  if (v.wall_friction != silent.wall_friction) members.real("wall_friction", v.wall_friction, "");
  if (v.wall_restitution != silent.wall_restitution) members.real("wall_restitution", v.wall_restitution, "");
  if (v.rolling_friction != silent.rolling_friction) members.real("rolling_friction", v.rolling_friction, "");
  if (v.wall_rolling_friction != silent.wall_rolling_friction)
    members.real("wall_rolling_friction", v.wall_rolling_friction, "");

  members.heading("contact law");
  members.choice("NormalLaw", "normal", v.normal);
  members.choice("TangentialLaw", "tangential", v.tangential);
  members.choice("Slider", "slider", v.slider);
  if (v.friction_limit != silent.friction_limit) members.choice("FrictionLimit", "friction_limit", v.friction_limit);
  members.choice("DampingMass", "damping_mass", v.damping_mass);
  members.choice("Damping", "damping", v.damping);
  members.real("normal_stiffness", v.normal_stiffness, "N/m");
  members.real("tangential_stiffness", v.tangential_stiffness, "N/m");

  members.heading("pipe");
  members.real("pipe_diameter", v.pipe_diameter, "m");
  members.real("pipe_length", v.pipe_length, "m");
  members.choice("Ends", "ends", v.ends);
  members.flag("has_wall", v.wall);
  write_feed(members, v);

  members.heading("gas");
  members.flag("has_gas", v.has_gas);
  members.real("gas_velocity", v.gas_velocity.front().value, "m/s, superficial");
  members.real("gas_density", v.gas_density, "kg/m3");
  members.real("gas_viscosity", v.gas_viscosity, "m2/s, kinematic");
  members.real("gas_bed_diameter", v.gas_bed_diameter, "m");
  members.whole("gas_update_interval", v.gas_update_interval);
  members.whole("gas_floater_interval", v.has_gas ? v.gas_floater_interval : 1);
  members.choice("BedHeight", "gas_bed_height", v.gas_bed_height);
  members.whole("slice_count", v.slice_count);
  write_gas_beyond(members, v);

  members.heading("step");
  members.vector("gravity", v.gravity, "m/s2");
  members.real("time_step", v.time_step, "s");
  members.choice("Integrator", "integrator", v.integrator);
  members.choice("Precision", "precision", v.precision + "_precision");
  members.real("max_overlap", v.max_overlap, "radii");
  members.whole("neighbour_capacity", v.neighbour_capacity);
  if (v.tile_steps > 0) members.whole("tile_steps", v.tile_steps);
  if (v.memory_budget > 0) members.add("long long", "memory_budget", fmt::format("{}", v.memory_budget), "bytes");
  members.flag("energy_ledger", v.energy_ledger);
}

void write_program(Members& members, const CaseValues& v) {
  members.heading("for the program only");
  members.real("duration", v.duration, "s");
  members.real("log_interval", v.log_interval, "s");
  members.real("frame_interval", v.frame_interval, "s");
  members.real("sample_interval", v.sample_interval, "s");
  members.real("checkpoint_interval", v.checkpoint_interval, "s");
  members.flag("text_frames", v.frame_data == "text");
  members.flag("dump", v.dump);
  members.real("reference_speed", v.reference_speed, "m/s");
  members.real("overlap_warning", v.overlap_warning, "radii");
  members.real("stability_limit", v.stability_limit, "stable steps");
  members.choice("StartKind", "start", !v.start_from.empty() ? "from" : v.placed.empty() ? "random" : "placed");
  members.seed("seed", v.seed);
  members.real("start_velocity", v.start_velocity, "m/s, largest component");
  members.flag("start_keeps_motion", v.start_motion == "keep");
  members.text("start_from", predecessor_name(v.start_from));
  members.whole("placed_count", static_cast<std::int64_t>(v.placed.size()));
  std::string list;
  for (const auto& particle : v.placed)
    list += fmt::format("\n      {{{}, {}, {}}},", exact(particle.position), exact(particle.velocity),
                        exact(particle.angular_velocity));
  members.add("Placed", "placed[]", list.empty() ? "{{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}}" : "{" + list + "\n  }", "");
  write_watching(members, v);
}

/// Whether a key belongs into the list of all: it is used, and it says something where another would leave it out.
bool says_something(const Rule<CaseValues>& rule, const CaseValues& values, const CaseValues& silent) {
  if (rule.table == "particles.sizes") return values.has_distribution && applies(rule.when, values);
  if ((rule.table == "particles" || rule.table == "gas") && !applies(rule.when, values)) return false;
  if (rule.table == "feed" && !values.is_line()) return false;
  if (rule.when == When::species_default && values.has_species) return false;  // each has it
  return !rule.only_if_it_says_something || rule.value_in(values) != rule.value_in(silent);
}

/// Every key with its value, one a line: what a program compares when it is to go on with a run of another one.
std::string key_values(const CaseValues& values) {
  std::string text;
  const CaseValues silent = silent_of(values);
  for (const Rule<CaseValues>& rule : case_keys())
    if (says_something(rule, values, silent))
      text += fmt::format("{}{} = {}\n", rule.table.empty() ? "" : "[" + rule.table + "] ", rule.name,
                          one_line(rule.value_in(values)));
  for (std::size_t k = 0; k < values.species.size(); ++k)
    for (const Rule<Species>& rule : species_keys())
      text += fmt::format("[[particles.species]] {} {} = {}\n", k, rule.name, rule.value_in(values.species[k]));
  for (std::size_t k = 0; k < values.placed.size(); ++k)
    for (const Rule<PlacedParticle>& rule : placed_keys())
      if (!rule.only_if_it_says_something || rule.value_in(values.placed[k]) != rule.value_in(PlacedParticle{}))
        text += fmt::format("[[start.particle]] {} {} = {}\n", k, rule.name, rule.value_in(values.placed[k]));
  for (std::size_t k = 0; k < values.probes.size(); ++k)
    for (const Rule<Probe>& rule : probe_keys())
      text += fmt::format("[[probe]] {} {} = {}\n", k, rule.name, rule.value_in(values.probes[k]));
  return text;
}

std::string write_members(const CaseValues& values, const Source& source) {
  Members members;
  members.text("name", source.name);
  members.text("title", values.title.empty() ? source.name : values.title);
  members.text("source", source.label);
  members.add("unsigned long long", "source_hash", fmt::format("0x{:016x}ULL", source.hash), "XXH64 of the case file");
  members.text("keys", source.name.empty() ? "" : key_values(values));
  write_physics(members, values);
  write_program(members, values);
  return members.str();
}

/// Stems that cannot name a struct here: words of C++, and every word that appears inside the struct.
bool is_reserved(const std::string& name) {
  static const std::set<std::string> words = {
      "alignas", "alignof", "and", "and_eq", "asm", "auto", "bitand", "bitor", "bool", "break", "case", "catch", "char",
      "char8_t", "char16_t", "char32_t", "class", "compl", "concept", "const", "consteval", "constexpr", "constinit",
      "const_cast", "continue", "co_await", "co_return", "co_yield", "decltype", "default", "delete", "do", "double",
      "dynamic_cast", "else", "enum", "explicit", "export", "extern", "false", "float", "for", "friend", "goto", "if",
      "inline", "int", "long", "mutable", "namespace", "new", "noexcept", "not", "not_eq", "nullptr", "operator", "or",
      "or_eq", "private", "protected", "public", "register", "reinterpret_cast", "requires", "return", "short",
      "signed", "sizeof", "static", "static_assert", "static_cast", "struct", "switch", "template", "this",
      "thread_local", "throw", "true", "try", "typedef", "typeid", "typename", "union", "unsigned", "using", "virtual",
      "void", "volatile", "wchar_t", "while", "xor", "xor_eq", "linux", "unix", "fixdem", "cases",
      // members that only some headers have
      "tile_steps", "memory_budget", "wall_friction", "wall_restitution", "friction_limit", "FrictionLimit",
      "rolling_friction", "wall_rolling_friction", "largest_diameter", "smallest_diameter", "reference_density",
      "mean_volume", "species_count", "species_names", "sizes", "SizeRun", "first_fed_kind", "start_count", "feed_rate",
      "feed_start", "feed_length", "feed_velocity", "feed_seed", "feed_interval", "TimeValue", "gas_velocity_in_time",
      "gas_full_gap", "gas_compressible", "gas_outlet_pressure", "gas_temperature", "gas_constant", "gas_storage",
      "gas_supply_volume", "gas_inlet_pressure", "gas_blower_flow", "gas_blower_pressure", "slice_interval",
      "contact_interval", "statistics_from", "probe_count", "probes", "Probe"};
  if (words.contains(name)) return true;
  static const std::string members = write_members({}, {});
  const auto is_letter = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
  for (auto at = members.find(name); at != std::string::npos; at = members.find(name, at + 1))
    if (!is_letter(members[at - 1]) && !is_letter(members[at + name.size()])) return true;
  return false;
}

}  // namespace

std::string struct_name(const std::string& stem) {
  std::string name;
  for (const char c : stem) {
    const bool allowed = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
    name += allowed ? c : '_';
  }
  const bool bad_start = name.empty() || name.front() == '_' || (name.front() >= '0' && name.front() <= '9');
  return bad_start || is_reserved(name) ? "case_" + name : name;
}

std::string write_header(const CaseValues& values, const Source& source) {
  return fmt::format(
      "// Generated from {0} (xxh64 {1:016x}); do not edit. `make header CASE={2}` prints it.\n"
      "#pragma once\n\n#include \"kernel/case.hpp\"\n\nnamespace fixdem::cases {{\n\nstruct {3} {{\n{4}}};\n\n"
      "}}  // namespace fixdem::cases\n",
      one_line(source.label), source.hash, one_line(source.name), struct_name(source.name),
      write_members(values, source));
}

}  // namespace fixdem::casegen
