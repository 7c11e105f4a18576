// Defaults that follow from other keys.
//
// Lengths that are one diameter of equal spheres are one of the largest with several sizes; the gas then takes the
// Sauter diameter of each slice, for which its bed diameter of 0 stands.
//
// slice_count is the nearest whole number of pipe length / slice length, at least 1 (without gas the slices only
// measure solids fractions and are one diameter long). The reference speed is the largest of the start velocities,
// the gas velocity and the speed of a fall through the pipe's diameter, sqrt(2 g D).
#include <algorithm>
#include <cmath>

#include "checks.hpp"
#include "sizes.hpp"

namespace fixdem::casegen {
namespace {

double length_of(const Vector3& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

double expected_speed(const CaseValues& v) {
  double speed = std::sqrt(2 * length_of(v.gravity) * v.pipe_diameter);
  speed = std::max(speed, std::sqrt(3.0) * v.start_velocity);  // per component
  speed = std::max(speed, std::abs(v.gas_velocity));
  for (const auto& particle : v.placed) speed = std::max(speed, length_of(particle.velocity));
  return speed;
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
  if (!reading.has("run.reference_speed")) v.reference_speed = expected_speed(v);
  if (!reading.has("output.log_interval")) v.log_interval = v.duration / 50;
}

}  // namespace fixdem::casegen
