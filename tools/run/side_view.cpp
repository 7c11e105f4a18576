#include "side_view.hpp"

#include <algorithm>
#include <cmath>

namespace fixdem::program {
namespace {

constexpr char letters[] = " .:-=+*#%@";
constexpr int heaviest = 9;
constexpr double densest = 0.6;
constexpr int samples = 8;  // of a particle's diameter, each way

}  // namespace

SideView::SideView(const CaseFacts& facts, int columns, double begin, double length)
    : kinds_(facts),
      pipe_radius_(facts.pipe_diameter / 2),
      begin_(begin),
      length_(length),
      is_periodic_(facts.is_periodic),
      columns_(columns),
      rows_(std::clamp(static_cast<int>(std::lround(0.5 * columns * facts.pipe_diameter / length_)), 6, 20)),
      cells_(index(rows_, 0)) {}

void SideView::draw(const Snapshot& snapshot) {
  std::fill(cells_.begin(), cells_.end(), Cell{});
  for (std::size_t id = 0; id < snapshot.particles.size(); ++id) {
    const Particle& p = snapshot.particles[id];
    const double radius = kinds_.radius_of(snapshot.kind(static_cast<int>(id))), step = 2 * radius / samples;
    for (int i = 0; i < samples; ++i)
      for (int j = 0; j < samples; ++j) {
        const double across = (i + 0.5) * step - radius, up = (j + 0.5) * step - radius;
        const double under_root = radius * radius - across * across - up * up;
        if (under_root <= 0) continue;
        double place = (p.position[2] + across - begin_) / length_;
        if (is_periodic_) place -= std::floor(place);
        const double column = std::floor(place * columns_);
        const double row = std::floor((pipe_radius_ - p.position[1] - up) / (2 * pipe_radius_) * rows_);
        if (!(column >= 0 && column < columns_ && row >= 0 && row < rows_)) continue;
        const double solids = 2 * std::sqrt(under_root) * step * step;
        Cell& cell = cells_[index(static_cast<int>(row), static_cast<int>(column))];
        cell.solids += solids;
        cell.momentum += solids * p.velocity[2];
      }
  }
}

char SideView::letter(int row, int column) const {
  // Half as deep as the pipe's cross section is at this height, and half a letter more where that would be nothing.
  const double height = pipe_radius_ * (1 - (2 * row + 1.0) / rows_);
  const double radius = kinds_.largest_radius();
  const double depth = 2 * std::sqrt(std::max(pipe_radius_ * pipe_radius_ - height * height, radius * radius));
  const double room = depth * (2 * pipe_radius_ / rows_) * (length_ / columns_);
  const double fraction = cells_[index(row, column)].solids / room;
  if (!(fraction > 0)) return letters[0];
  return letters[std::clamp(1 + static_cast<int>(fraction / densest * (heaviest - 1)), 1, heaviest)];
}

double SideView::axial_velocity(int row, int column) const {
  const Cell& cell = cells_[index(row, column)];
  return cell.solids > 0 ? cell.momentum / cell.solids : 0;
}

}  // namespace fixdem::program
