// The open line in its textbook form: what is due, where it falls in, and who leaves.
//
// A particle is fed when its mass is due, at a place drawn at random in the upper half of the feed section; one that
// reaches the end of the pipe leaves. Random numbers are a function of the seed, of how many have been fed, of the try
// and of the component, so there is no state of a generator. Particles keep their numbers (serials) for ever: those
// that are fed go behind the others, and one that has left stays in the list, marked. SI units.
//
//   (F1)  due: the integral of the feed rate from feed_start on
//   (F2)  x = (2 u_1 - 1)(R - r) across, s = u_2 (R - r) upwards, z = r + (L_f - 2 r) u_3, inside the pipe and
//         touching nobody; the first of those due that finds no place in 20 tries ends the event, and tries the next
//         20 places at the next one
//   (F4)  a centre at z >= L leaves when its position has been updated
#pragma once

#include <cstdint>
#include <vector>

#include "direction_reference.hpp"
#include "reference_state.hpp"

namespace fixdem::reference {

/// Particles that are placed by hand.
template <class Case>
constexpr int count_at_start() {
  if constexpr (is_line<Case>)
    return Case::start_count;
  else
    return Case::particle_count;
}

/// The finaliser of SplitMix64.
inline std::uint64_t mixed_bits(std::uint64_t z) {
  z += 0x9E3779B97F4A7C15ULL;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
  return z ^ (z >> 31);
}

/// u: in [0, 1), for the number-th particle fed, from 0.
inline double drawn_number(std::uint64_t seed, std::uint64_t number, std::uint64_t attempt, std::uint64_t component) {
  const std::uint64_t h = mixed_bits(mixed_bits(mixed_bits(seed) + number) + 4 * attempt + component);
  return static_cast<double>(h >> 11) / 9007199254740992.0;  // 2^53
}

template <class Case, class Scalar>
class Line {
  using Sphere = SphereState<Scalar>;
  using Vector3 = Vector<Scalar>;

 public:
  void start() {
    totals_ = {};
    totals_.at_start = totals_.present = Case::start_count;
    fed_mass_ = left_mass_ = 0, tried_ = 0;
  }

  /// What comes before a step: one feeding event where one is due.
  void feed(long long step, std::vector<Sphere>& spheres, Energy& energy) {
    const Scalar time = Scalar(step) * Scalar(Case::time_step);
    if (step % Case::feed_interval != 0 || time < Scalar(Case::feed_start)) return;
    const Scalar due = mass_due(time);
    while (is_due(due) && feed_one(spheres, energy)) {
    }
    const Scalar backlog = std::max(due - fed_mass_, Scalar(0));
    const bool is_blocked = is_due(due) && backlog > rate_at(time) * 1;  // one waits, and with it a second of the feed
    if (is_blocked) totals_.blocked_time += Case::feed_interval * Case::time_step;
    totals_.asked = static_cast<double>(due), totals_.backlog = static_cast<double>(backlog);
  }

  /// What comes after a step: whether one is past the end and leaves.
  bool takes(Sphere& s, Energy& energy) {
    if (!s.is_present || s.x.z() < Scalar(Case::pipe_length)) return false;
    s.is_present = false;
    ++totals_.left, --totals_.present;
    left_mass_ += s.own.mass;
    energy.left_with += static_cast<double>(kinetic_energy(s));
    return true;
  }

  LineTotals totals() const {
    LineTotals t = totals_;
    t.accepted = static_cast<double>(fed_mass_), t.left_mass = static_cast<double>(left_mass_);
    return t;
  }

  /// The feed rate at a time, kg/s.
  static Scalar rate_at(Scalar time) {
    const auto& table = Case::feed_rate;
    constexpr int rows = sizeof(table) / sizeof(table[0]);
    int after = 0;  // the first row that lies behind this time
    while (after < rows && Scalar(table[after].time) <= time) ++after;
    if (after == 0 || after == rows) return table[after == 0 ? 0 : rows - 1].value;
    const Scalar t0 = table[after - 1].time, t1 = table[after].time;
    const Scalar v0 = table[after - 1].value, v1 = table[after].value;
    return (v0 * (t1 - time) + v1 * (time - t0)) / (t1 - t0);
  }

  /// Eq. (F1), kg: the rate is linear between the rows of its table, so its mean over such a piece is that of the ends.
  static Scalar mass_due(Scalar time) {
    std::vector<Scalar> ends{Scalar(Case::feed_start)};
    for (const auto& row : Case::feed_rate)
      if (row.time > Case::feed_start && Scalar(row.time) < time) ends.push_back(row.time);
    ends.push_back(time);
    Scalar mass = 0;
    for (std::size_t k = 1; k < ends.size(); ++k)
      mass += (rate_at(ends[k - 1]) + rate_at(ends[k])) / 2 * (ends[k] - ends[k - 1]);
    return mass;
  }

  /// The kind of the number-th particle fed: any of those that are not at the start, with equal chances.
  static int kind_of_fed(long long number) {
    if constexpr (lists_sizes<Case>) {
      int kinds = 0;
      for (const SizeRun& run : Case::sizes) kinds += run.count;
      kinds -= Case::first_fed_kind;
      return Case::first_fed_kind + static_cast<int>(drawn(number, 0, 3) * kinds);
    } else {
      return 0;
    }
  }

  /// Eq. (F2): the place of a try; the walls of the pipe are not asked yet.
  static Vector3 place_of(long long number, long long attempt, Scalar r) {
    const Scalar reach = Scalar(Case::pipe_diameter) / 2 - r;
    const Scalar x = (2 * Scalar(drawn(number, attempt, 0)) - 1) * reach, s = Scalar(drawn(number, attempt, 1)) * reach;
    const Vector3 up = upwards<Case, Scalar>(), across(up.y(), -up.x(), 0);
    const Scalar z = r + (Scalar(Case::feed_length) - 2 * r) * Scalar(drawn(number, attempt, 2));
    return x * across + s * up + Vector3(0, 0, z);
  }

 private:
  static double drawn(long long number, long long attempt, int component) {
    return drawn_number(Case::feed_seed, static_cast<std::uint64_t>(number), static_cast<std::uint64_t>(attempt),
                        static_cast<std::uint64_t>(component));
  }

  static bool is_free(const Sphere& s, const std::vector<Sphere>& spheres) {
    const Scalar reach = Scalar(Case::pipe_diameter) / 2 - s.own.radius;
    if (s.x.x() * s.x.x() + s.x.y() * s.x.y() > reach * reach) return false;
    for (const Sphere& other : spheres)
      if (other.is_present && (other.x - s.x).norm() < other.own.radius + s.own.radius) return false;
    return true;
  }

  /// The next particle; it has no place yet.
  Sphere next() const {
    Sphere s;
    s.kind = kind_of_fed(totals_.fed);
    s.own = sphere_properties<Case, Scalar>(s.kind);
    return s;
  }

  bool is_due(Scalar due) const { return fed_mass_ + next().own.mass <= due * (1 + Scalar(1e-12L)); }

  /// Whether the next particle has found a place.
  bool feed_one(std::vector<Sphere>& spheres, Energy& energy) {
    Sphere s = next();
    for (int k = 0; k < 20; ++k) {
      s.x = place_of(totals_.fed, tried_++, s.own.radius);
      if (!is_free(s, spheres)) continue;
      s.v = -Scalar(Case::feed_velocity) * upwards<Case, Scalar>();
      s.floats = !has_no_bed<Case>();  // until floaters are told again; no force of the gas until its next update
      spheres.push_back(s);
      energy.entered += static_cast<double>(kinetic_energy(s));
      ++totals_.fed, ++totals_.present;
      fed_mass_ += s.own.mass;
      tried_ = 0;
      return true;
    }
    return false;
  }

  LineTotals totals_;
  Scalar fed_mass_ = 0, left_mass_ = 0;
  long long tried_ = 0;  ///< places by the next particle
};

}  // namespace fixdem::reference
