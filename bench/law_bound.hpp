// The arithmetic bound: how fast the contact law alone would go.
//
// Contacts of a simulation that is under way, evenly chosen and in its proportion of pairs to walls, are packed into
// lanes and stay in the first-level cache. Timed is the arithmetic that no method can leave out: root and normal from
// the difference of positions, springs, law, torque, new history. No rows are looked up and nothing is summed, so a
// whole step cannot be faster; `fraction_of_bound` (counters.hpp) says how near it comes. Histories are read and the
// new ones written elsewhere: each pass does the same work on contacts as they were found, sliding ones included.
#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <memory>
#include <type_traits>

#include "core_clock.hpp"
#include "kernel/fixdem.hpp"

namespace fixdem::bench {

template <class Case>
class PackedContacts {
  using D = Derived<Case>;
  using T = Real<Case>;
  using Pair = PairSide<Case>;
  using Wall = WallSide<Case, PipeSurface<Case>>;
  static constexpr int W = contact_lanes<Case, native_lanes>, lanes = Capacity<Case>::batch;
  using V = Lanes<W, T>;

 public:
  static constexpr int most_batches = 12;  // 24 kB: within any first-level cache

  static constexpr int samples = 8;  ///< disjoint choices of contacts: few slide, and those make their batch slow

  PackedContacts(Simulation<Case>& simulation, int sample)
      : pair_(simulation.state().particles, 0, 0, 0), wall_(simulation.state().particles, 0) {
    const Observation seen = simulation.observe();
    const int pairs = seen.contacts, walls = seen.wall_contacts;
    if (pairs + walls == 0) return;
    pair_batches_ = (most_batches * pairs + (pairs + walls) / 2) / (pairs + walls);
    if (pairs > 0 && walls > 0) pair_batches_ = std::clamp(pair_batches_, 1, most_batches - 1);
    wall_batches_ = most_batches - pair_batches_;
    Place pair{0, pairs, lanes * pair_batches_, sample, 0, 0},
        wall{lanes * pair_batches_, walls, lanes * wall_batches_, sample, 0, 0};
    simulation.for_each_contact([&](const Contact& contact) {
      Place& at = contact.partner >= 0 ? pair : wall;
      while (at.is_next()) pack(simulation, contact, at.first + at.taken++);
      ++at.seen;
    });
  }

  /// Contacts that one pass computes.
  int count() const { return lanes * (pair_batches_ + wall_batches_); }

  void pass() {
    stages(pair_, 0, lanes * pair_batches_);
    stages(wall_, lanes * pair_batches_, count());
    benchmark::ClobberMemory();
  }

  /// Processor time of one contact, the best of five stretches of a fifth of a millisecond or so; 0 without contacts.
  double seconds_per_contact() {
    if (count() == 0) return 0;
    constexpr int passes = 200;
    double best = 1e300;
    for (int trial = 0; trial < 5; ++trial) {
      const double begin = processor_seconds();
      for (int k = 0; k < passes; ++k) pass();
      best = std::min(best, processor_seconds() - begin);
    }
    return best / passes / count();
  }

 private:
  struct Batch {
    alignas(64) double between[3][lanes];  ///< centre of the owner to that of its partner, or from the axis; m
    alignas(64) T velocity[3][lanes], spin[3][lanes], history[3][lanes];
    alignas(64) T separation[3][lanes], gap_square[lanes], root[lanes];     ///< of the first stage
    alignas(64) T normal[3][lanes], repulsion[lanes], overlap_root[lanes];  ///< of the second
    alignas(64) T force[3][lanes], torque[3][lanes], new_history[3][lanes];
  };

  /// Which of the contacts of a kind go where: number `taken` of `wanted`, evenly out of `available`.
  struct Place {
    int first, available, wanted, sample, taken, seen;
    bool is_next() const {
      const long long fine = static_cast<long long>(samples) * taken + sample;
      return taken < wanted && fine * available / (static_cast<long long>(samples) * wanted) == seen;
    }
  };

  void pack(const Simulation<Case>& simulation, const Contact& contact, int number) {
    Batch& batch = batch_[number / lanes];
    const int lane = number % lanes;
    const bool is_wall = contact.partner < 0;
    constexpr double unit = Case::tangential == TangentialLaw::displacement ? 1 : Case::time_step / D::mass;
    const double distance = is_wall ? D::pipe_radius - D::radius + contact.overlap : Case::diameter - contact.overlap;
    const Particle owner = simulation.particle(contact.owner);
    const Particle partner = is_wall ? Particle{} : simulation.particle(contact.partner);
    // An end wall is turned to where a pipe wall could be: the arithmetic is the same, but for the root of a square.
    const int turn = contact.partner < pipe_wall ? 2 : 0;
    for (int c = 0; c < 3; ++c) {
      const int from = (c + turn) % 3;
      batch.between[c][lane] = distance * contact.normal[from];
      batch.velocity[c][lane] = static_cast<T>(owner.velocity[from] - partner.velocity[from]);
      batch.spin[c][lane] = static_cast<T>(D::radius * (owner.angular_velocity[from] + partner.angular_velocity[from]));
      batch.history[c][lane] = static_cast<T>(unit * contact.history[from]);
    }
  }

  static FIXDEM_INLINE Vec3<V> load_vector(const T (&a)[3][lanes], int lane) {
    return {load<V>(a[0] + lane), load<V>(a[1] + lane), load<V>(a[2] + lane)};
  }
  static FIXDEM_INLINE void store_vector(T (&a)[3][lanes], int lane, const Vec3<V>& v) {
    store(a[0] + lane, v.x);
    store(a[1] + lane, v.y);
    store(a[2] + lane, v.z);
  }

  /// The stages of the kernel, interleaved as there: otherwise the roots of a contact would delay its law.
  template <class Side>
  void stages(const Side& side, int first, int end) {
    const auto separate = [&](int k) FIXDEM_INLINE_LAMBDA {
      if (k < end) separation(side, batch_[k / lanes], k % lanes);
    };
    const auto resolve = [&](int k) FIXDEM_INLINE_LAMBDA {
      if (k < end) geometry(side, batch_[k / lanes], k % lanes);
    };
    separate(first);
    separate(first + W);
    resolve(first);
    for (int k = first; k < end; k += W) {
      resolve(k + W);
      separate(k + 2 * W);
      law<typename Side::Law>(batch_[k / lanes], k % lanes);
    }
  }

  template <class Side>
  static FIXDEM_INLINE void separation(const Side& side, Batch& batch, int lane) {
    const auto part = [&](auto width, int first) FIXDEM_INLINE_LAMBDA {
      using Doubles = Lanes<decltype(width)::value>;
      const int at = lane + first;
      const Vec3<Doubles> r = {load<Doubles>(batch.between[0] + at), load<Doubles>(batch.between[1] + at),
                               load<Doubles>(batch.between[2] + at)};
      if constexpr (std::is_same_v<Side, Wall>) {
        return PipeSurface<Case>::separation(r, splat<Doubles>(D::reference_radius));
      } else {
        const Doubles square = dot(r, r);
        return Separation<Doubles>{r, is_mixed<Case> ? Case::diameter * Case::diameter - square : square};
      }
    };
    Separation<V> s;
    if constexpr (is_mixed<Case>)
      s = narrowed<W>(part);
    else
      s = part(std::integral_constant<int, W>{}, 0);
    store_vector(batch.separation, lane, s.separation);
    store(batch.gap_square + lane, s.gap_square);
    store(batch.root + lane, side.root(s));
  }

  template <class Side>
  static FIXDEM_INLINE void geometry(const Side& side, Batch& batch, int lane) {
    Vec3<V> n;
    const Separation<V> s{load_vector(batch.separation, lane), load<V>(batch.gap_square + lane)};
    const ContactBodies<typename Side::Law, Case, V> bodies(Motion<V>{});
    const SpringBase<V> base =
        spring_base<typename Side::Law, Case>(side.resolve(s, load<V>(batch.root + lane), n), bodies);
    store_vector(batch.normal, lane, n);
    store(batch.repulsion + lane, base.repulsion);
    store(batch.overlap_root + lane, base.root);
  }

  /// Third stage of W contacts. As in the kernel, lanes that slide or turn are left to a function of their own.
  template <class Law, SlidingLanes mode>
  static FIXDEM_INLINE bool law_of_lanes(Batch& batch, int lane) {
    const Vec3<V> n = load_vector(batch.normal, lane), velocity = load_vector(batch.velocity, lane);
    const ContactBodies<Law, Case, V> bodies(Motion<V>{});
    const Springs<V> k =
        springs<Law, Case>(SpringBase<V>{load<V>(batch.repulsion + lane), load<V>(batch.overlap_root + lane)}, bodies);
    const V normal_velocity = dot(velocity, n);
    History<V> history{load_vector(batch.history, lane), k.tangential_stiffness};
    const Vec3<V> surface_velocity = add_cross(velocity, load_vector(batch.spin, lane), n);
    bool is_done;
    const ContactForce<V> f =
        contact_force<Law, Case, mode>(bodies, k, n, surface_velocity, normal_velocity, normal_velocity, Vec3<V>{},
                                       k.tangential_stiffness > V{}, history, is_done);
    if (!is_done) return false;
    store_vector(batch.force, lane, f.force);
    if constexpr (D::has_rotation) {
      store_vector(batch.torque, lane, cross(n, f.force));
      store_vector(batch.new_history, lane, history.spring);
    }
    return true;
  }
  template <class Law>
  [[gnu::noinline]] static void law_of_sliding_lanes(Batch& batch, int lane) {
    law_of_lanes<Law, SlidingLanes::computed>(batch, lane);
  }
  template <class Law>
  static FIXDEM_INLINE void law(Batch& batch, int lane) {
    if (!law_of_lanes<Law, SlidingLanes::reported>(batch, lane)) law_of_sliding_lanes<Law>(batch, lane);
  }

  Pair pair_;  // formulas of the kernel; their particles are not looked at
  Wall wall_;
  Batch batch_[most_batches];
  int pair_batches_ = 0, wall_batches_ = 0;
};

/// Processor time that the law takes for one contact of a simulation, the mean of all samples; 0 without contacts.
template <class Case>
double law_seconds_per_contact(Simulation<Case>& simulation) {
  double sum = 0;
  for (int sample = 0; sample < PackedContacts<Case>::samples; ++sample)
    sum += std::make_unique<PackedContacts<Case>>(simulation, sample)->seconds_per_contact();
  return sum / PackedContacts<Case>::samples;
}

}  // namespace fixdem::bench
