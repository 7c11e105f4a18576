// Defaults that follow from other keys.
//
// Lengths that are one diameter of equal spheres are one of the largest with several sizes; the gas then takes the
// Sauter diameter of each slice, for which its bed diameter of 0 stands.
//
// slice_count is the nearest whole number of pipe length / slice length, at least 1 (without gas the slices only
// measure solids fractions and are one diameter long). The reference speed is the largest of the start velocities,
// the gas velocity, that of the feed and the speed of a fall through the pipe's diameter, sqrt(2 g D).
//
// A line has room for what its pipe can hold.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "checks.hpp"
#include "sizes.hpp"

namespace fixdem::casegen {
namespace {

double length_of(const Vector3& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

double expected_speed(const CaseValues& v) {
  double speed = std::sqrt(2 * length_of(v.gravity) * v.pipe_diameter);
  speed = std::max(speed, std::sqrt(3.0) * v.start_velocity);  // per component
  for (const auto& [time, velocity] : v.gas_velocity) speed = std::max(speed, std::abs(velocity));
  if (v.pipe_diameter > 0)
    speed = std::max(speed, v.gas_blower_flow / (std::numbers::pi / 4 * v.pipe_diameter * v.pipe_diameter));
  if (v.is_line()) speed = std::max(speed, v.feed_velocity);
  for (const auto& particle : v.placed) speed = std::max(speed, length_of(particle.velocity));
  return speed;
}

/// Room for what the pipe can hold, and a feed section that lies within it.
void complete_line(Reading& reading, const SizeFigures& sizes) {
  CaseValues& v = reading.values;
  if (!v.is_line()) return;
  if (!reading.has("particles.capacity")) {
    constexpr double beyond = 1e9;  // where a diameter is not known; refused
    const double most = most_in_pipe(v, sizes.mean_volume);
    v.capacity = std::max(v.count, static_cast<std::int64_t>(most < beyond ? most : beyond));
  }
  if (!reading.has("feed.length")) v.feed_length = std::min(std::max(0.1, 10 * sizes.largest), v.pipe_length);
}

}  // namespace

void complete(Reading& reading) {
  CaseValues& v = reading.values;
  if (v.normal == "hertz") {
    if (!reading.has("material.wall_youngs_modulus")) v.wall_youngs_modulus = v.youngs_modulus;
    if (!reading.has("material.wall_poisson_ratio")) v.wall_poisson_ratio = v.poisson_ratio;
  }
  if (!reading.has("material.wall_friction")) v.wall_friction = v.default_wall_friction();
  if (!reading.has("material.wall_restitution")) v.wall_restitution = v.default_wall_restitution();
  if (!reading.has("material.wall_rolling_friction")) v.wall_rolling_friction = v.default_wall_rolling_friction();
  const SizeFigures sizes = figures_of(v);
  if (v.has_gas && !reading.has("gas.bed_diameter")) v.gas_bed_diameter = v.has_sizes() ? 0 : v.diameter;
  if (!reading.has("gas.slice_length")) v.gas_slice_length = sizes.largest;
  if (v.has_sizes() && !reading.has("capacity.neighbours")) v.neighbour_capacity = neighbours_for(sizes);
  if (v.gas_slice_length > 0) {
    const double slices = std::clamp(std::round(v.pipe_length / v.gas_slice_length), 1.0, 1e9);
    v.slice_count = static_cast<std::int64_t>(slices);
  }
  complete_line(reading, sizes);
  if (v.gas_compressible) {
    v.gas_density = v.gas_outlet_pressure / (v.gas_constant * v.gas_temperature);
    v.gas_storage =
        v.gas_storage || reading.has("gas.supply_volume") || reading.has("gas.inlet_pressure") || v.has_blower();
  }
  for (std::size_t k = 0; k < v.probes.size(); ++k)
    if (!reading.has(fmt::format("probe.{}.interval", k))) v.probes[k].interval = v.sample_interval;
  if (!reading.has("run.reference_speed")) v.reference_speed = expected_speed(v);
  if (!reading.has("output.log_interval")) v.log_interval = v.duration / 50;
}

}  // namespace fixdem::casegen
