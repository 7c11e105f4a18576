// Whether placed particles lie in the pipe and apart from one another, by at most `max_overlap` radii (of the smallest
// particle), the limit at which a run stops. Lengths in metres.
//
// Those found in order are sorted into cells one diameter wide, of several sizes each into cells of its own; a particle
// is compared with those in the 27 cells around it. The largest come first, so that nobody need look for smaller ones,
// which may be many. One that overlaps is reported and left out, so that cells never hold more than fit, and the work
// is proportional to the number of particles.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <optional>
#include <vector>

#include "checks.hpp"
#include "sizes.hpp"

namespace fixdem::casegen {
namespace {

/// Overlap of a placed particle with the pipe and its ends; the largest of the three.
double wall_overlap(const CaseValues& v, double radius, const Vector3& x) {
  double overlap = -v.pipe_diameter;
  if (v.wall) overlap = std::hypot(x[0], x[1]) - (v.pipe_diameter / 2 - radius);
  if (v.ends == "closed" || v.is_line()) overlap = std::max(overlap, radius - x[2]);
  if (v.ends == "closed") overlap = std::max(overlap, x[2] - (v.pipe_length - radius));
  return overlap;
}

double distance(const CaseValues& v, const Vector3& a, const Vector3& b) {
  double along = std::abs(a[2] - b[2]);
  if (v.ends == "periodic") along = std::min(along, v.pipe_length - along);
  return std::hypot(a[0] - b[0], a[1] - b[1], along);
}

/// The accepted particles of one diameter by cell.
class Cells {
 public:
  Cells(const CaseValues& values, double diameter)
      : values_(values), diameter_(diameter), layers_(std::max(1.0, std::floor(values.pipe_length / diameter))) {}

  double diameter() const { return diameter_; }

  void add(std::size_t particle) { cells_[cell(values_.placed[particle].position)].push_back(particle); }

  /// The first of these, if it comes before `first`, that overlaps a sphere here, with which it touches at a distance
  /// of `touch`, by more than the limit.
  void find(const Vector3& x, double touch, double limit, std::optional<std::size_t>& first) const {
    const Cell centre = cell(x);
    for (const double i : {-1.0, 0.0, 1.0})
      for (const double j : {-1.0, 0.0, 1.0})
        for (const double k : {-1.0, 0.0, 1.0}) {
          const double layer = centre[2] + k, wrapped = layer < 0 ? layers_ - 1 : layer >= layers_ ? 0 : layer;
          const auto found = cells_.find({centre[0] + i, centre[1] + j, wrapped});
          if (found == cells_.end()) continue;
          for (const std::size_t other : found->second)
            if ((!first || other < *first) && touch - distance(values_, x, values_.placed[other].position) > limit)
              first = other;
        }
  }

 private:
  using Cell = std::array<double, 3>;

  Cell cell(const Vector3& x) const {
    const double layer = std::floor(x[2] / values_.pipe_length * layers_);
    return {std::floor(x[0] / diameter_), std::floor(x[1] / diameter_), std::clamp(layer, 0.0, layers_ - 1)};
  }

  const CaseValues& values_;
  double diameter_;
  double layers_;  // cells along the pipe, at least a diameter long
  std::map<Cell, std::vector<std::size_t>> cells_;
};

/// Distance of the centres of two spheres of these diameters that just touch.
double touching(double one, double other) { return (one + other) / 2; }

std::string entry(std::size_t index, const char* key) { return fmt::format("start.particle.{}.{}", index, key); }

}  // namespace

void check_placed(const Reading& reading, Report& report) {
  const CaseValues& v = reading.values;
  if (v.placed.empty() ||
      !reading.usable({"particles.diameter", "pipe.diameter", "pipe.length", "pipe.ends", "run.max_overlap"}))
    return;
  std::vector<double> diameters(v.placed.size(), v.diameter);
  if (v.has_sizes()) diameters = diameters_of(v);
  std::vector<std::size_t> largest_first(v.placed.size());
  std::iota(largest_first.begin(), largest_first.end(), 0);
  std::ranges::stable_sort(largest_first, std::greater<>(), [&](std::size_t i) { return diameters[i]; });

  const double limit = v.max_overlap * diameters[largest_first.back()] / 2;
  std::vector<Cells> accepted;  // for each diameter, the last that of the present one
  for (const std::size_t i : largest_first) {
    const PlacedParticle& particle = v.placed[i];
    const double diameter = diameters[i];
    if (accepted.empty() || accepted.back().diameter() != diameter) accepted.emplace_back(v, diameter);
    const std::string spin = entry(i, "angular_velocity"), position = entry(i, "position");
    if (!v.has_rotation() && reading.usable({"material.friction", "material.wall_friction"}) &&
        particle.angular_velocity != Vector3{})
      report.error(reading.place(spin), fmt::format("{} with friction = 0; allowed: [0, 0, 0]", reading.quote(spin)),
                   "without friction particles do not rotate: remove it, or raise [material] friction");
    if (!reading.usable({position})) continue;
    const double z = particle.position[2];
    if (z < 0 || z > v.pipe_length || (v.is_line() && z == v.pipe_length) ||  // which would leave at once
        wall_overlap(v, diameter / 2, particle.position) > limit) {
      report.error(
          reading.place(position),
          fmt::format("{} (particle {}) is outside the pipe; allowed: z from 0 to {:.6g}, overlap with the "
                      "walls at most {:.6g}",
                      reading.quote(position), i, v.pipe_length, limit),
          fmt::format("the centre must stay within {:.6g} m of the axis x = y = 0{}", (v.pipe_diameter - diameter) / 2,
                      v.ends == "closed" ? ", and a radius away from the ends"
                      : v.is_line()      ? ", a radius away from z = 0 and before the outlet"
                                         : ""));
      continue;
    }
    std::optional<std::size_t> other;
    for (const Cells& cells : accepted)
      cells.find(particle.position, touching(cells.diameter(), diameter), limit, other);
    if (other)
      report.error(
          reading.place(position),
          fmt::format("{} (particle {}) overlaps particle {} by {:.6g} m; allowed: at most {:.6g}",
                      reading.quote(position), i, *other,
                      touching(diameters[*other], diameter) - distance(v, particle.position, v.placed[*other].position),
                      limit),
          "move one of them: centres a diameter apart just touch");
    else
      accepted.back().add(i);
  }
}

}  // namespace fixdem::casegen
