#include "log.hpp"

#include <fmt/format.h>

#include <cmath>

#include "energy_balance.hpp"

namespace fixdem::program {
namespace {

/// A multiple of the time step without the rounding of its last digits: 0.1, not 0.09999999999999999.
double tidy(double time) { return std::stod(fmt::format("{:.12g}", time)); }

/// Both the header and the rows come from one list of columns, so they cannot drift apart.
template <class Visitor>
void for_each_column(const CaseFacts& facts, const LogRow& row, Visitor&& column) {
  const Observation& o = row.observation;
  column("time [s]", tidy(row.time));
  column("step", static_cast<double>(row.step));
  column("kinetic energy translation [J]", o.kinetic_translation);
  column("kinetic energy rotation [J]", o.kinetic_rotation);
  column("pair contacts", o.contacts);
  column("wall contacts", o.wall_contacts);
  column("coordination number", o.coordination_number);
  column("max overlap / radius", o.max_overlap / facts.smallest_radius());
  column("max speed [m/s]", o.max_speed);
  column("mean axial velocity [m/s]", o.mean_axial_velocity);
  column("mean height [m]", o.mean_height);
  column("time step / stable step", row.step_ratio);
  if (facts.has_gas) {
    column("pressure drop [Pa]", row.plug.pressure_drop);
    column("plug front [m]", row.plug.front);
    column("plug length [m]", row.plug.length);
    column("plug particle velocity [m/s]", row.plug.particle_velocity);
    column("layer area ratio", row.plug.layer_area_ratio);
    for (int k = 0; facts.has_species() && k < facts.species_count; ++k)
      column(fmt::format("mean axial velocity of {} [m/s]", facts.species[k]).c_str(),
             row.species_velocity.empty() ? 0 : row.species_velocity[static_cast<std::size_t>(k)]);
  }
  if (facts.line.is_open) {
    const LineTotals& totals = row.line.totals;
    column("present", static_cast<double>(totals.present));
    column("fed", static_cast<double>(totals.fed));
    column("left", static_cast<double>(totals.left));
    column("holdup [kg]", row.line.holdup);
    column("asked rate [kg/s]", row.line.asked_rate);
    column("accepted rate [kg/s]", row.line.accepted_rate);
    column("leaving rate [kg/s]", row.line.left_rate);
    column("backlog [kg]", totals.backlog);
    column("blocked time [s]", totals.blocked_time);
  }
  if (facts.energy_ledger) {
    column("elastic energy [J]", row.energy.elastic);
    column("elastic energy of tangential springs [J]", row.energy.elastic_tangential);
    column("dissipated by damping [J]", row.energy.dissipated_damping);
    column("dissipated by sliding [J]", row.energy.dissipated_sliding);
    if (facts.has_rolling) column("dissipated by rolling [J]", row.energy.dissipated_rolling);
    column("made by the tangential law [J]", row.energy.made_by_law);
    column("gravity work [J]", row.energy.gravity_work);
    if (facts.has_gas) column("gas work [J]", row.energy.gas_work);
    if (facts.line.is_open) {
      column("energy fed [J]", row.energy.entered);
      column("energy that has left [J]", row.energy.left_with);
    }
    column("energy balance error", row.balance_error);
  }
}

}  // namespace

std::string log_header(const CaseFacts& facts) {
  std::string line;
  for_each_column(facts, LogRow{},
                  [&](const char* name, double) { line += (line.empty() ? "" : ",") + std::string(name); });
  return line + "\n";
}

std::string log_line(const CaseFacts& facts, const LogRow& row) {
  std::string line;
  bool first = true;
  for_each_column(facts, row, [&](const char*, double value) {
    if (!first) line += ",";
    first = false;
    if (std::isfinite(value)) line += fmt::format("{}", value);
  });
  return line + "\n";
}

std::string table_header(const CaseFacts& facts) {
  std::string line = fmt::format("{:>9} {:>11} {:>11} {:>8} {:>6} {:>9} {:>8}", "time", "E transl", "E rot", "contacts",
                                 "coord", "overlap", "v max");
  if (facts.line.is_open) line += fmt::format(" {:>7} {:>7}", "present", "left");
  if (facts.has_gas) line += fmt::format(" {:>9} {:>8} {:>8}", "dp", "v mean", "front");
  line += fmt::format("\n{:>9} {:>11} {:>11} {:>8} {:>6} {:>9} {:>8}", "s", "J", "J", "", "", "/ radius", "m/s");
  if (facts.line.is_open) line += fmt::format(" {:>7} {:>7}", "", "");
  if (facts.has_gas) line += fmt::format(" {:>9} {:>8} {:>8}", "Pa", "m/s", "m");
  return line + "\n";
}

std::string table_row(const CaseFacts& facts, const LogRow& row) {
  const Observation& o = row.observation;
  std::string line = fmt::format("{:>9.6g} {:>11.4e} {:>11.4e} {:>8} {:>6.3f} {:>9.2e} {:>8.4f}", row.time,
                                 o.kinetic_translation, o.kinetic_rotation, o.contacts + o.wall_contacts,
                                 o.coordination_number, o.max_overlap / facts.smallest_radius(), o.max_speed);
  if (facts.line.is_open) line += fmt::format(" {:>7} {:>7}", row.line.totals.present, row.line.totals.left);
  if (facts.has_gas) {
    line += fmt::format(" {:>9.1f} {:>8.4f}", row.plug.pressure_drop, o.mean_axial_velocity);
    line += row.plug.found ? fmt::format(" {:>8.4f}", row.plug.front) : fmt::format(" {:>8}", "-");
  }
  return line + "\n";
}

}  // namespace fixdem::program
