#include "summary.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "capacity_advice.hpp"
#include "contact_time.hpp"
#include "energy_balance.hpp"
#include "species_velocity.hpp"

namespace fixdem::program {
namespace {

using Json = nlohmann::ordered_json;  // keys in the order written here

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }
Json triple(const double (&v)[3]) { return Json::array({number(v[0]), number(v[1]), number(v[2])}); }

double rate(const Outcome& outcome) {
  return outcome.kernel_time > 0 ? outcome.particle_steps / outcome.kernel_time : 0;
}

Json energy(const CaseFacts& facts, const Outcome& outcome) {
  const Energy& e = outcome.energy;
  // What a step has to sum up exists only with the ledger; the rest follows from the state.
  const auto entry = [&facts](double value) { return facts.energy_ledger ? number(value) : Json(nullptr); };
  Json list = {{"kinetic", number(outcome.observation.kinetic_translation + outcome.observation.kinetic_rotation)},
               {"elastic", number(e.elastic)},
               {"elastic_tangential", number(e.elastic_tangential)},
               {"dissipated", entry(dissipated(e))},
               {"dissipated_damping", entry(e.dissipated_damping)},
               {"dissipated_sliding", entry(e.dissipated_sliding)}};
  if (facts.has_rolling) list["rolling"] = entry(e.dissipated_rolling);
  list["made_by_law"] = entry(e.made_by_law);
  list["gravity_work"] = number(e.gravity_work);
  list["gas_work"] = facts.has_gas ? entry(e.gas_work) : Json(nullptr);
  if (facts.line.is_open) list["entered"] = number(e.entered), list["left_with"] = number(e.left_with);
  list["balance_error"] = entry(balance_error(outcome.start_energy, e));
  return list;
}

Json plug(const PlugResult& p) {
  return {{"front_velocity", number(p.front_velocity)},
          {"particle_velocity", number(p.particle_velocity)},
          {"length", number(p.length)},
          {"layer_area_ratio", number(p.layer_area_ratio)},
          {"layer_area_ratio_eq41", number(p.layer_area_ratio_eq41)},
          {"pressure_gradient", number(p.pressure_gradient)},
          {"pressure_drop", number(p.pressure_drop)},
          {"samples", p.samples},
          {"samples_with_plug", p.samples_with_plug}};
}

Json collision(const Outcome& outcome) {
  if (!outcome.collision) return nullptr;
  const Collision& c = *outcome.collision;
  return {
      {"restitution", number(c.restitution)},           {"tangential_restitution", number(c.tangential_restitution)},
      {"angular_velocity", number(c.angular_velocity)}, {"contact_time", number(c.contact_time)},
      {"max_overlap", number(c.max_overlap)},           {"max_normal_force", number(c.max_normal_force)}};
}

/// What walls have of their own, and rolling resistance; null where there is neither.
Json own_material(const CaseFacts& facts) {
  const ContactCoefficients &pair = facts.pair_contact, &wall = facts.wall_contact;
  Json own;
  if (wall.friction != pair.friction || wall.restitution != pair.restitution)
    own = {{"wall_friction", wall.friction}, {"wall_restitution", wall.restitution}};
  if (!facts.has_rolling) return own;
  own["rolling_friction"] = pair.rolling_friction;
  if (facts.has_wall || !facts.is_periodic) own["wall_rolling_friction"] = wall.rolling_friction;
  return own;
}

Json particles(const CaseFacts& facts, const Outcome& outcome) {
  if (outcome.snapshot.particles.size() > 64) return nullptr;
  Json list = Json::array();
  for (const Particle& p : outcome.snapshot.particles) {
    const int id = static_cast<int>(list.size());
    list.push_back({{"position", triple(p.position)},
                    {"velocity", triple(p.velocity)},
                    {"angular_velocity", triple(p.angular_velocity)}});
    if (facts.has_sizes()) list.back()["diameter"] = facts.diameter_of(outcome.snapshot.kind(id));
  }
  return list;
}

Json sizes(const CaseFacts& facts, const Snapshot& snapshot) {
  const SizeStatistics all = size_statistics(facts, static_cast<int>(snapshot.particles.size()),
                                             snapshot.is_of_line ? snapshot.kinds.data() : nullptr);
  return {{"minimum_diameter", all.minimum_diameter},
          {"maximum_diameter", all.maximum_diameter},
          {"mean_diameter", number(all.mean_diameter)},
          {"sauter_diameter", number(all.sauter_diameter)},
          {"total_mass", all.total_mass},
          {"total_volume", all.total_volume}};
}

Json species(const CaseFacts& facts, const Outcome& outcome) {
  const std::vector<CountedKind> kinds = counted_kinds(facts, facts.particle_count);
  const std::vector<double> velocities = axial_velocities(facts, outcome.snapshot);
  std::vector<int> counts(kinds.size(), 0);
  for (int id = 0; id < static_cast<int>(outcome.snapshot.particles.size()); ++id)
    ++counts[static_cast<std::size_t>(facts.species_of(outcome.snapshot.kind(id)))];
  Json list = Json::array();
  for (std::size_t k = 0; k < kinds.size(); ++k)
    list.push_back({{"name", facts.species[k]},
                    {"count", counts[k]},
                    {"diameter", kinds[k].kind.diameter},
                    {"density", kinds[k].kind.density},
                    {"mean_axial_velocity", number(velocities[k])},
                    {"mass", counts[k] * kinds[k].kind.mass()}});
  return list;
}

Json line(const LineResult& r) {
  const LineTotals& t = r.totals;
  return {{"at_start", t.at_start},
          {"fed", t.fed},
          {"left", t.left},
          {"present", t.present},
          {"asked_rate", number(r.asked_rate)},
          {"accepted_rate", number(r.accepted_rate)},
          {"backlog", number(t.backlog)},
          {"blocked_time", number(t.blocked_time)},
          {"holdup", number(r.holdup.mean)},
          {"plug_velocity", number(r.plug_velocity.mean)},
          {"plug_particle_velocity", number(r.plug_particle_velocity.mean)},
          {"plug_length", number(r.plug_length.mean)},
          {"layer_ratio", number(r.layer_ratio.mean)},
          {"layer_ratio_eq41", number(r.layer_ratio_eq41)},
          {"plug_frequency", number(r.plug_frequency)},
          {"plugs", r.plugs},
          {"inlet_pressure", number(r.inlet_pressure.mean)}};
}

/// Standard deviations of those that are means of single values.
Json line_scatter(const LineResult& r) {
  return {{"holdup", number(r.holdup.deviation)},
          {"plug_velocity", number(r.plug_velocity.deviation)},
          {"plug_particle_velocity", number(r.plug_particle_velocity.deviation)},
          {"plug_length", number(r.plug_length.deviation)},
          {"layer_ratio", number(r.layer_ratio.deviation)},
          {"inlet_pressure", number(r.inlet_pressure.deviation)}};
}

}  // namespace

std::string encode_plug(const PlugResult& result) { return plug(result).dump(2) + "\n"; }

std::string encode_summary(const CaseFacts& facts, const Options& options, const Outcome& outcome) {
  const Observation& o = outcome.observation;
  Json capacity = Json::object();
  for (const CapacityUse& use : outcome.capacities)
    capacity[use.name] = {{"limit", use.limit}, {"high_water", use.high_water}};
  Json summary = {
      {"case", facts.name},
      {"case_hash", fmt::format("{:016x}", facts.source_hash)},
      {"kernel", facts.kernel},
      {"start_state", options.start_hash != 0 ? Json(fmt::format("{:016x}", options.start_hash)) : Json(nullptr)},
      {"features", features(facts)},
      {"precision", precision_name(facts.precision)},
      {"integrator", integrator_name(facts.integrator)},
      {"time_step", facts.time_step},
      {"duration", options.duration},
      {"steps", outcome.snapshot.step},
      {"status", outcome.status},
      {"seed", facts.start == StartKind::random ? Json(options.seed) : Json(nullptr)},
      {"final",
       {{"time", outcome.snapshot.time},
        {"kinetic_energy", number(o.kinetic_translation + o.kinetic_rotation)},
        {"contacts", o.contacts + o.wall_contacts},
        {"coordination_number", number(o.coordination_number)},
        {"max_overlap", number(o.max_overlap)},
        {"max_speed", number(o.max_speed)},
        {"mean_axial_velocity", number(o.mean_axial_velocity)},
        {"mean_height", number(o.mean_height)},
        {"state_hash", state_hash(outcome.snapshot)}}},
      {"frames", outcome.frames >= 0 ? Json(outcome.frames) : Json(nullptr)},
      {"stability",
       {{"maximum_step_ratio", number(outcome.maximum_step_ratio)},
        {"steps_per_contact", number(outcome.steps_per_contact)},
        {"steps_per_contact_needed", fewest_steps_per_contact}}},
      {"energy", energy(facts, outcome)},
      {"capacity", capacity},
      {"performance",
       {{"wall_time", outcome.wall_time},
        {"kernel_time", outcome.kernel_time},
        {"particle_steps_per_second", rate(outcome)}}},
      {"plug", outcome.plug ? plug(*outcome.plug) : Json(nullptr)},
      {"collision", collision(outcome)},
      {"particles", particles(facts, outcome)}};
  if (Json own = own_material(facts); !own.is_null()) summary["material"] = std::move(own);
  if (facts.has_sizes()) summary["sizes"] = sizes(facts, outcome.snapshot);
  if (facts.has_species()) summary["species"] = species(facts, outcome);
  if (outcome.line) {
    summary["line"] = line(*outcome.line);
    summary["line_scatter"] = line_scatter(*outcome.line);
    summary["line_verdict"] = verdict(*outcome.line);
  }
  return summary.dump(2) + "\n";
}

std::string describe_outcome(const CaseFacts& facts, const Outcome& outcome) {
  std::string text = fmt::format(
      "\n{}: {}, {} steps, {:.6g} s simulated in {:.2f} s, {:.4g} million particle-steps/s\n", facts.name,
      outcome.status, outcome.snapshot.step, outcome.snapshot.time, outcome.wall_time, 1e-6 * rate(outcome));
  if (facts.energy_ledger)
    text += fmt::format("energy balance error {:.2e}\n", balance_error(outcome.start_energy, outcome.energy));
  if (outcome.steps_per_contact < fewest_steps_per_contact)
    text +=
        fmt::format("only {:.1f} steps per contact at the deepest overlap ({:.0f} are needed): results may be wrong\n",
                    outcome.steps_per_contact, fewest_steps_per_contact);
  text += describe_capacities(outcome.capacities, facts.most_neighbours());
  if (outcome.plug && std::isfinite(outcome.plug->front_velocity)) {
    const PlugResult& p = *outcome.plug;
    text += fmt::format(
        "plug: front {:.3f} m/s, particles {:.3f} m/s, length {:.3f} m, layer area ratio {:.3f} (eq. 41: {:.3f}), "
        "{:.0f} Pa/m\n",
        p.front_velocity, p.particle_velocity, p.length, p.layer_area_ratio, p.layer_area_ratio_eq41,
        p.pressure_gradient);
  } else if (outcome.plug) {
    text += fmt::format("plug: none ({} of {} samples in the second half of the run show one)\n",
                        outcome.plug->samples_with_plug, outcome.plug->samples);
  }
  if (outcome.line) text += describe_line(*outcome.line);
  if (outcome.collision) {
    const Collision& c = *outcome.collision;
    text +=
        fmt::format("collision: restitution {:.5f}, contact time {:.4e} s, maximum overlap {:.4e} m, force {:.4e} N\n",
                    c.restitution, c.contact_time, c.max_overlap, c.max_normal_force);
    if (std::isfinite(c.tangential_restitution))
      text += fmt::format("           tangential restitution {:.5f}, angular velocity {:.5g} rad/s\n",
                          c.tangential_restitution, c.angular_velocity);
  }
  return text;
}

}  // namespace fixdem::program
