#include "arrangement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cell_grid.hpp"
#include "failure.hpp"
#include "random_numbers.hpp"

namespace fixdem::program {
namespace {

constexpr double spacing = 1.001;        // target distance of centres, in diameters
constexpr double wall_clearance = 5e-4;  // in diameters: half of what neighbours keep
constexpr int tries_per_particle = 200;  // then it is inserted overlapping

class Packing {
 public:
  Packing(const Container& container, double diameter, unsigned long long seed)
      : container_(container),
        diameter_(diameter),
        reach_((container.pipe_diameter - diameter) / 2 - wall_clearance * diameter),
        low_(container.is_periodic ? 0 : (0.5 + wall_clearance) * diameter),
        high_(container.is_periodic ? container.pipe_length : container.pipe_length - low_),
        grid_(container.pipe_diameter, container.pipe_length, container.is_periodic, spacing * diameter),
        random_(seed) {
    if (reach_ < 0) reach_ = 0;  // a particle as wide as the pipe has one place in the cross section
    if (high_ < low_) low_ = high_ = container.pipe_length / 2;
  }

  /// Sequential insertion; returns how many found no free place.
  int insert(int count) {
    int overlapping = 0;
    // Once insertion is hopeless, trying 200 times for each of the others would only cost time.
    int tries = tries_per_particle;
    for (int i = 0; i < count; ++i) {
      Position trial = random_position();
      int k = 1;
      while (!is_free(trial) && k < tries) trial = random_position(), ++k;
      if (k == tries && !is_free(trial)) ++overlapping, tries = std::max(tries / 2, 20);
      positions_.push_back(trial);
      grid_.add(trial);
    }
    return overlapping;
  }

  /// One sweep of pushing apart. Returns the smallest distance met, in diameters, each before its pair was pushed.
  double push_apart() {
    refill();
    const double target = spacing * diameter_;
    double least = target;
    for (int i = 0; i < count(); ++i) {
      grid_.visit_near(at(i), [&](int j) {
        if (j <= i) return true;
        Position between = difference(at(i), at(j));
        const double distance = length(between);
        if (distance >= target) return true;
        least = std::min(least, distance);
        if (distance == 0) between = {target, 0, 0};
        const double push = 0.5 * (target - distance) / (distance == 0 ? target : distance);
        for (std::size_t k = 0; k < 3; ++k) at(i)[k] -= push * between[k], at(j)[k] += push * between[k];
        keep_inside(at(i));
        keep_inside(at(j));
        return true;
      });
    }
    return least / diameter_;
  }

  /// Numbers the spheres along the pipe: neighbours in space become neighbours in memory.
  void sort_along_pipe() {
    std::stable_sort(positions_.begin(), positions_.end(),
                     [](const Position& a, const Position& b) { return a[2] < b[2]; });
  }

  /// Smallest distance of two centres in diameters, 1.001 if none is nearer than that.
  double min_distance() {
    refill();
    double least = spacing * diameter_;
    for (int i = 0; i < count(); ++i)
      grid_.visit_near(at(i), [&](int j) {
        if (j > i) least = std::min(least, length(difference(at(i), at(j))));
        return true;
      });
    return least / diameter_;
  }

  std::vector<Position>& positions() { return positions_; }
  RandomNumbers& random() { return random_; }

 private:
  int count() const { return static_cast<int>(positions_.size()); }
  Position& at(int i) { return positions_[static_cast<std::size_t>(i)]; }

  Position random_position() {
    double x, y;
    do {
      x = random_.between(-reach_, reach_);
      y = random_.between(-reach_, reach_);
    } while (x * x + y * y > reach_ * reach_);
    return {x, y, random_.between(low_, high_)};
  }

  Position difference(const Position& from, const Position& to) const {
    double z = to[2] - from[2];
    if (container_.is_periodic) {
      if (z > container_.pipe_length / 2) z -= container_.pipe_length;
      if (z < -container_.pipe_length / 2) z += container_.pipe_length;
    }
    return {to[0] - from[0], to[1] - from[1], z};
  }
  static double length(const Position& p) { return std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]); }

  bool is_free(const Position& trial) {
    bool free = true;
    grid_.visit_near(trial, [&](int j) { return free = length(difference(trial, at(j))) >= spacing * diameter_; });
    return free;
  }

  void keep_inside(Position& p) const {
    const double q = std::sqrt(p[0] * p[0] + p[1] * p[1]);
    if (q > reach_) p[0] *= reach_ / q, p[1] *= reach_ / q;
    if (container_.is_periodic) {
      if (p[2] < 0) p[2] += container_.pipe_length;
      if (p[2] >= container_.pipe_length) p[2] -= container_.pipe_length;
    } else {
      p[2] = std::clamp(p[2], low_, high_);
    }
  }

  void refill() {
    grid_.clear();
    for (const Position& p : positions_) grid_.add(p);
  }

  Container container_;
  double diameter_, reach_, low_, high_;
  CellGrid grid_;
  RandomNumbers random_;
  std::vector<Position> positions_;
};

[[noreturn]] void refuse(const Container& container, int count, double diameter, double min_distance, int sweeps) {
  const double radius_ratio = diameter / container.pipe_diameter;
  const double fraction = 2.0 / 3.0 * count * diameter * radius_ratio * radius_ratio / container.pipe_length;
  throw Failure(
      exit_bad_input,
      fmt::format("cannot place {} particles of {} m at random in a pipe of {} m x {} m (solids fraction {:.3f})\n"
                  "  after {} sweeps of pushing overlapping particles apart, two centres are still only {:.4f} "
                  "diameters apart\n"
                  "  lower [particles] count or raise [pipe] length; dense beds (above about 0.5) are made by letting "
                  "a longer pipe settle:\n  [start] from = \"that_case\"",
                  count, diameter, container.pipe_diameter, container.pipe_length, fraction, sweeps, min_distance));
}

Packing pack(const Container& container, int count, double diameter, unsigned long long seed,
             ArrangementReport& report) {
  Packing packing(container, diameter, seed);
  report.inserted_overlapping = packing.insert(count);
  report.sweeps = 0;
  packing.sort_along_pipe();
  report.min_distance = packing.min_distance();
  double last_gap = 1;
  while (report.min_distance < 1.0) {
    // Jammed: 500 sweeps that close less than a tenth of what is missing lead nowhere.
    const double gap = 1 - report.min_distance;
    if (report.sweeps > 0 && report.sweeps % 500 == 0) {
      if (gap > 0.9 * last_gap) refuse(container, count, diameter, report.min_distance, report.sweeps);
      last_gap = gap;
    }
    report.min_distance = packing.push_apart();
    ++report.sweeps;
    if (report.min_distance >= 1.0) report.min_distance = packing.min_distance();  // of all pairs at once
  }
  return packing;
}

}  // namespace

std::vector<Position> arrange(const Container& container, int count, double diameter, unsigned long long seed,
                              ArrangementReport* report) {
  ArrangementReport local;
  return pack(container, count, diameter, seed, report ? *report : local).positions();
}

std::vector<Particle> arrange_moving(const Container& container, int count, double diameter, double speed,
                                     unsigned long long seed) {
  ArrangementReport report;
  Packing packing = pack(container, count, diameter, seed, report);
  std::vector<Particle> particles;
  for (const Position& position : packing.positions()) {
    Particle particle{};
    for (std::size_t k = 0; k < 3; ++k) {
      particle.position[k] = position[k];
      particle.velocity[k] = packing.random().between(-speed, speed);
    }
    particles.push_back(particle);
  }
  return particles;
}

}  // namespace fixdem::program
