// Whether placed particles lie in the pipe and apart from one another, by at most `max_overlap` radii, the limit at
// which a run stops. Lengths in metres.
//
// Those found in order are sorted into cells one diameter wide; a particle is compared with those in the 27 cells
// around it. One that overlaps is reported and left out, so that cells never hold more than fit, and the work is
// proportional to the number of particles.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include "checks.hpp"

namespace fixdem::casegen {
namespace {

/// Overlap of a placed particle with the pipe and its ends; the largest of the three.
double wall_overlap(const CaseValues& v, const Vector3& x) {
  const double radius = v.diameter / 2;
  double overlap = -v.pipe_diameter;
  if (v.wall) overlap = std::hypot(x[0], x[1]) - (v.pipe_diameter / 2 - radius);
  if (v.ends == "closed") overlap = std::max({overlap, radius - x[2], x[2] - (v.pipe_length - radius)});
  return overlap;
}

double distance(const CaseValues& v, const Vector3& a, const Vector3& b) {
  double along = std::abs(a[2] - b[2]);
  if (v.ends == "periodic") along = std::min(along, v.pipe_length - along);
  return std::hypot(a[0] - b[0], a[1] - b[1], along);
}

/// The accepted particles by cell.
class Cells {
 public:
  explicit Cells(const CaseValues& values)
      : values_(values), layers_(std::max(1.0, std::floor(values.pipe_length / values.diameter))) {}

  void add(std::size_t particle) { cells_[cell(values_.placed[particle].position)].push_back(particle); }

  /// The first accepted particle that overlaps this one by more than the limit.
  std::optional<std::size_t> overlapping(std::size_t particle, double limit) const {
    const Vector3& x = values_.placed[particle].position;
    const Cell centre = cell(x);
    std::optional<std::size_t> first;
    for (double i = -1; i <= 1; ++i)
      for (double j = -1; j <= 1; ++j)
        for (double k = -1; k <= 1; ++k) {
          const double layer = centre[2] + k, wrapped = layer < 0 ? layers_ - 1 : layer >= layers_ ? 0 : layer;
          const auto found = cells_.find({centre[0] + i, centre[1] + j, wrapped});
          if (found == cells_.end()) continue;
          for (const std::size_t other : found->second)
            if ((!first || other < *first) &&
                values_.diameter - distance(values_, x, values_.placed[other].position) > limit)
              first = other;
        }
    return first;
  }

 private:
  using Cell = std::array<double, 3>;

  Cell cell(const Vector3& x) const {
    const double layer = std::floor(x[2] / values_.pipe_length * layers_);
    return {std::floor(x[0] / values_.diameter), std::floor(x[1] / values_.diameter),
            std::clamp(layer, 0.0, layers_ - 1)};
  }

  const CaseValues& values_;
  double layers_;  // cells along the pipe, at least a diameter long
  std::map<Cell, std::vector<std::size_t>> cells_;
};

std::string entry(std::size_t index, const char* key) { return fmt::format("start.particle.{}.{}", index, key); }

}  // namespace

void check_placed(const Reading& reading, Report& report) {
  const CaseValues& v = reading.values;
  if (!reading.usable({"particles.diameter", "pipe.diameter", "pipe.length", "pipe.ends", "run.max_overlap"})) return;
  const double limit = v.max_overlap * v.diameter / 2;
  Cells accepted(v);
  for (std::size_t i = 0; i < v.placed.size(); ++i) {
    const PlacedParticle& particle = v.placed[i];
    const std::string spin = entry(i, "angular_velocity"), position = entry(i, "position");
    if (!v.has_rotation() && reading.usable({"material.friction", "material.wall_friction"}) &&
        particle.angular_velocity != Vector3{})
      report.error(reading.place(spin), fmt::format("{} with friction = 0; allowed: [0, 0, 0]", reading.quote(spin)),
                   "without friction particles do not rotate: remove it, or raise [material] friction");
    if (!reading.usable({position})) continue;
    const double overlap = wall_overlap(v, particle.position);
    if (particle.position[2] < 0 || particle.position[2] > v.pipe_length || overlap > limit) {
      report.error(reading.place(position),
                   fmt::format("{} (particle {}) is outside the pipe; allowed: z from 0 to {:.6g}, overlap with the "
                               "walls at most {:.6g}",
                               reading.quote(position), i, v.pipe_length, limit),
                   fmt::format("the centre must stay within {:.6g} m of the axis x = y = 0{}",
                               (v.pipe_diameter - v.diameter) / 2,
                               v.ends == "closed" ? ", and a radius away from the ends" : ""));
    } else if (const auto other = accepted.overlapping(i, limit)) {
      report.error(reading.place(position),
                   fmt::format("{} (particle {}) overlaps particle {} by {:.6g} m; allowed: at most {:.6g}",
                               reading.quote(position), i, *other,
                               v.diameter - distance(v, particle.position, v.placed[*other].position), limit),
                   "move one of them: centres a diameter apart just touch");
    } else {
      accepted.add(i);
    }
  }
}

}  // namespace fixdem::casegen
