#include "line_station.hpp"

#include <fmt/format.h>

#include <cmath>

namespace fixdem::program {
namespace {
constexpr double armed_below = 0.30;  // solids fraction
}  // namespace

void Passages::look(double solids_fraction) {
  if (solids_fraction < armed_below) is_armed_ = true;
  if (!is_armed_ || !(solids_fraction > plug_threshold)) return;
  ++count_;
  is_armed_ = false;
}

double mass_from(const ParticleKinds& kinds, const Snapshot& snapshot, double z) {
  double mass = 0;
  for (std::size_t id = 0; id < snapshot.particles.size(); ++id)
    if (snapshot.particles[id].position[2] >= z) mass += kinds.mass_of(snapshot.kind(static_cast<int>(id)));
  return mass;
}

void Station::look(const LineSlices& slices) {
  const int at = slices.slice_of(position_);
  solids_fraction_ = smoothed(slices.profile)[static_cast<std::size_t>(at)];
  passages_.look(solids_fraction_);
}

std::string Station::header() { return "time [s],pressure [Pa],solids fraction,mass flow [kg/s],plug passages\n"; }

std::string Station::row(const ParticleKinds& kinds, const Snapshot& snapshot, const LineSlices& slices,
                         const LineTotals& totals) {
  const double beyond = totals.left_mass + mass_from(kinds, snapshot, position_);
  const double flow = (beyond - beyond_) / (slices.time - row_time_);
  beyond_ = beyond, row_time_ = slices.time;
  return fmt::format("{:.12g},{:.7g},{:.6g},{},{}\n", slices.time, slices.pressure_at(position_), solids_fraction_,
                     std::isfinite(flow) ? fmt::format("{:.6g}", flow) : "", passages_.count());
}

}  // namespace fixdem::program
