#include "arrangement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "cell_grid.hpp"
#include "failure.hpp"
#include "random_numbers.hpp"

namespace fixdem::program {
namespace {

constexpr double spacing = 1.001;        // target distance of centres, in sums of radii
constexpr double wall_clearance = 5e-4;  // in diameters: half of what neighbours keep
constexpr int tries_per_particle = 200;  // then it is inserted overlapping

/// Where the centre of a sphere may be: so far from the axis, and between these places along it.
struct Room {
  double radius, cube, reach, low, high;
  Room(const Container& container, double diameter)
      : radius(diameter / 2),
        cube(radius * radius * radius),
        reach((container.pipe_diameter - diameter) / 2 - wall_clearance * diameter),
        low(container.is_periodic ? 0 : (0.5 + wall_clearance) * diameter),
        high(container.is_periodic ? container.pipe_length : container.pipe_length - low) {
    if (reach < 0) reach = 0;  // a particle as wide as the pipe has one place in the cross section
    if (high < low) low = high = container.pipe_length / 2;
  }
};

class Packing {
 public:
  /// `diameters`: of the spheres, the largest first.
  Packing(const Container& container, const std::vector<double>& diameters, unsigned long long seed)
      : container_(container),
        grid_(container.pipe_diameter, container.pipe_length, container.is_periodic, diameters, spacing),
        random_(seed) {
    for (const double diameter : diameters) rooms_.emplace_back(container, diameter);
  }

  /// Sequential insertion; returns how many found no free place.
  int insert() {
    int overlapping = 0;
    // Once insertion is hopeless, trying 200 times for each of the others would only cost time.
    int tries = tries_per_particle;
    for (const Room& room : rooms_) {
      Position trial = random_position(room);
      int k = 1;
      while (!is_free(trial, room) && k < tries) trial = random_position(room), ++k;
      if (k == tries && !is_free(trial, room)) ++overlapping, tries = std::max(tries / 2, 20);
      positions_.push_back(trial);
      grid_.add(trial);
    }
    return overlapping;
  }

  /// One sweep of pushing apart. Returns the smallest distance met, over that of touching, each before its pair was
  /// pushed.
  double push_apart() {
    refill();
    double least = spacing;
    for (int i = 0; i < count(); ++i) {
      grid_.visit_smaller(i, room(i).radius, at(i), [&](int j) {
        if (j <= i) return true;
        Position between = difference(at(i), at(j));
        const double distance = length(between), touching = room(i).radius + room(j).radius;
        const double target = spacing * touching;
        if (distance >= target) return true;
        least = std::min(least, distance / touching);
        if (distance == 0) between = {target, 0, 0};
        // The heavier one gives way the less.
        const double share = room(j).cube / (room(i).cube + room(j).cube);
        const double gap = (target - distance) / (distance == 0 ? target : distance);
        for (std::size_t k = 0; k < 3; ++k)
          at(i)[k] -= share * gap * between[k], at(j)[k] += (1 - share) * gap * between[k];
        keep_inside(at(i), room(i));
        keep_inside(at(j), room(j));
        return true;
      });
    }
    return least;
  }

  /// Numbers equal spheres along the pipe: neighbours in space become neighbours in memory.
  void sort_along_pipe() {
    std::stable_sort(positions_.begin(), positions_.end(),
                     [](const Position& a, const Position& b) { return a[2] < b[2]; });
  }

  /// Smallest distance of two centres over that of touching, 1.001 if none is nearer than that.
  double min_distance() {
    refill();
    double least = spacing;
    for (int i = 0; i < count(); ++i)
      grid_.visit_smaller(i, room(i).radius, at(i), [&](int j) {
        if (j > i) least = std::min(least, length(difference(at(i), at(j))) / (room(i).radius + room(j).radius));
        return true;
      });
    return least;
  }

  std::vector<Position>& positions() { return positions_; }
  RandomNumbers& random() { return random_; }

 private:
  int count() const { return static_cast<int>(positions_.size()); }
  Position& at(int i) { return positions_[static_cast<std::size_t>(i)]; }
  const Room& room(int i) const { return rooms_[static_cast<std::size_t>(i)]; }

  Position random_position(const Room& room) {
    double x, y;
    do {
      x = random_.between(-room.reach, room.reach);
      y = random_.between(-room.reach, room.reach);
    } while (x * x + y * y > room.reach * room.reach);
    return {x, y, random_.between(room.low, room.high)};
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

  bool is_free(const Position& trial, const Room& own) {
    bool free = true;
    grid_.visit_larger(count(), own.radius, trial, [&](int j) {
      return free = length(difference(trial, at(j))) >= spacing * (own.radius + room(j).radius);
    });
    return free;
  }

  void keep_inside(Position& p, const Room& own) const {
    const double q = std::sqrt(p[0] * p[0] + p[1] * p[1]);
    if (q > own.reach) p[0] *= own.reach / q, p[1] *= own.reach / q;
    if (container_.is_periodic) {
      if (p[2] < 0) p[2] += container_.pipe_length;
      if (p[2] >= container_.pipe_length) p[2] -= container_.pipe_length;
    } else {
      p[2] = std::clamp(p[2], own.low, own.high);
    }
  }

  void refill() {
    grid_.clear();
    for (const Position& p : positions_) grid_.add(p);
  }

  Container container_;
  SizedGrids grid_;
  RandomNumbers random_;
  std::vector<Position> positions_;
  std::vector<Room> rooms_;
};

[[noreturn]] void refuse(const Container& container, const std::vector<double>& diameters, double min_distance,
                         int sweeps) {
  const auto [least, most] = std::minmax_element(diameters.begin(), diameters.end());
  double fraction = 0;
  for (const double d : diameters) {
    const double radius_ratio = d / container.pipe_diameter;
    fraction += 2.0 / 3.0 * d * radius_ratio * radius_ratio / container.pipe_length;
  }
  throw Failure(
      exit_bad_input,
      fmt::format("cannot place {} particles of {} m at random in a pipe of {} m x {} m (solids fraction {:.3f})\n"
                  "  after {} sweeps of pushing overlapping particles apart, two centres are still only {:.4f} "
                  "{} apart\n"
                  "  lower {} or raise [pipe] length; dense beds (above about 0.5) are made by letting "
                  "a longer pipe settle:\n  [start] from = \"that_case\"",
                  diameters.size(), *least < *most ? fmt::format("{} to {}", *least, *most) : fmt::format("{}", *most),
                  container.pipe_diameter, container.pipe_length, fraction, sweeps, min_distance,
                  *least < *most ? "sums of their radii" : "diameters",
                  *least < *most ? "the number of particles" : "[particles] count"));
}

/// `are_alike`: the spheres may be renumbered; otherwise the largest come first.
Packing pack(const Container& container, const std::vector<double>& diameters, bool are_alike, unsigned long long seed,
             ArrangementReport& report) {
  Packing packing(container, diameters, seed);
  report.inserted_overlapping = packing.insert();
  report.sweeps = 0;
  if (are_alike) packing.sort_along_pipe();
  report.min_distance = packing.min_distance();
  double last_gap = 1;
  while (report.min_distance < 1.0) {
    // Jammed: 500 sweeps that close less than a tenth of what is missing lead nowhere.
    const double gap = 1 - report.min_distance;
    if (report.sweeps > 0 && report.sweeps % 500 == 0) {
      if (gap > 0.9 * last_gap) refuse(container, diameters, report.min_distance, report.sweeps);
      last_gap = gap;
    }
    report.min_distance = packing.push_apart();
    ++report.sweeps;
    if (report.min_distance >= 1.0) report.min_distance = packing.min_distance();  // of all pairs at once
  }
  return packing;
}

Packing pack_alike(const Container& container, int count, double diameter, unsigned long long seed,
                   ArrangementReport& report) {
  return pack(container, std::vector<double>(static_cast<std::size_t>(std::max(count, 0)), diameter), true, seed,
              report);
}

/// Inserts the largest first and brings the spheres back into the order of the diameters.
Packing pack_sizes(const Container& container, const std::vector<double>& diameters, unsigned long long seed,
                   ArrangementReport& report) {
  std::vector<std::size_t> order(diameters.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return diameters[a] > diameters[b]; });
  std::vector<double> sorted;
  for (const std::size_t id : order) sorted.push_back(diameters[id]);
  Packing packing = pack(container, sorted, false, seed, report);
  const std::vector<Position> found = packing.positions();
  for (std::size_t k = 0; k < order.size(); ++k) packing.positions()[order[k]] = found[k];
  return packing;
}

std::vector<Particle> moving(Packing packing, double speed) {
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

}  // namespace

std::vector<Position> arrange(const Container& container, int count, double diameter, unsigned long long seed,
                              ArrangementReport* report) {
  ArrangementReport local;
  return pack_alike(container, count, diameter, seed, report ? *report : local).positions();
}

std::vector<Position> arrange(const Container& container, const std::vector<double>& diameters, unsigned long long seed,
                              ArrangementReport* report) {
  ArrangementReport local;
  return pack_sizes(container, diameters, seed, report ? *report : local).positions();
}

std::vector<Particle> arrange_moving(const Container& container, int count, double diameter, double speed,
                                     unsigned long long seed) {
  ArrangementReport report;
  return moving(pack_alike(container, count, diameter, seed, report), speed);
}

std::vector<Particle> arrange_moving(const Container& container, const std::vector<double>& diameters, double speed,
                                     unsigned long long seed) {
  ArrangementReport report;
  return moving(pack_sizes(container, diameters, seed, report), speed);
}

}  // namespace fixdem::program
