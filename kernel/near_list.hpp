// The near list: who may touch whom, and for how long that stays true.
//
// Two levels. The outer list holds all pairs that were closer than d + outer margin when particles were last sorted
// (order.hpp); out of it each range of pairs lists what is closer than d + margin, and each chunk the walls closer than
// a margin of their own (validity.hpp says for how long). One fast particle makes its own surroundings be listed again
// and no others. No list causes an error: what it omits does not touch.
//
// The outer list lasts until two particles can have come its margin nearer to each other, whatever their chunks: each
// chunk adds up its maximum travel in a frame that moves as the middle between the extreme velocities did when
// particles were sorted. Whether to sort again is decided at steps that lie `order_interval` apart, or fewer if
// particles could use up the rest before. The decisions depend on step numbers and states alone, so results depend
// neither on how a run is cut into pieces nor on the order in which chunks are computed.
#pragma once

#include "outer_search.hpp"

namespace fixdem {

inline constexpr int order_interval = 16;  ///< steps between two decisions whether to sort
inline constexpr double speed_growth = 4;  ///< allowed for between two decisions; beyond, the run stops
/// Where a new order would not last for so many steps with that allowance, the next decision is made at the next step
/// and none is needed: what has been travelled is known before contacts are computed. A line of 110 000 spheres of 3 mm
/// at 3e-5 s was sorted at every step without this.
inline constexpr double fewest_steps = 4;

template <class Case>
struct NearList {
  using D = Derived<Case>;
  using Cap = Capacity<Case>;
  static constexpr int ranges = PairBatches<Case>::ranges;

  VelocityBox velocities[Cap::chunks];  ///< at present
  double frame[3];                      ///< velocity, m/s
  double travel[Cap::chunks];           ///< bound on the travel in that frame since the sort, m
  long long sorted_at;                  ///< step of the last sort
  long long next_decision;              ///< step at which it is decided whether to sort
  OuterList<Case> outer;
  long long listings, sorts;

  // High-water marks of the capacities.
  int most_neighbours, most_chunk_pairs, most_wrap_pairs, most_reach, most_histories;

  /// Velocities of all particles that a range concerns.
  VelocityBox velocities_of(int range) const {
    VelocityBox box;
    if (D::is_periodic && range == Cap::chunks) {
      for (int c = 0; c <= outer.last_at_start; ++c) box.add(velocities[c]);
      for (int c = outer.first_at_end; c < Cap::chunks; ++c) box.add(velocities[c]);
    } else {
      for (int c = range; c <= range + outer.span && c < Cap::chunks; ++c) box.add(velocities[c]);
    }
    return box;
  }

  /// Whether particles are so slow that no contact of the range turns by an angle that counts in the law: whose square
  /// is half a unit in the last place (turning_square). In a step two particles move by twice the bound on the speed at
  /// most, over the distance of their centres, or one over its distance from the axis; a factor of four is left.
  static bool is_still(const VelocityBox& box) {
    constexpr double reach = D::pipe_radius - D::largest_radius, d = smallest_diameter<Case>;
    constexpr double lever = Case::has_wall && reach < d ? reach : d;
    constexpr double angle = is_mixed<Case> ? 0x1p-13 : 0x1p-27, limit = angle * lever / (8 * Case::time_step);
    return box.speed() < limit;
  }

  /// Bound on how far particles have come along the pipe since the sort, m.
  double moved(long long step, int chunks) const {
    double most = abs(frame[2]) * Case::time_step * static_cast<double>(step - sorted_at);
    double longest = 0;
    for (int c = 0; c < chunks; ++c) longest = max(travel[c], longest);
    return most + longest;
  }

  /// A chunk has moved.
  void note_step(int chunk, const VelocityBox& box) {
    velocities[chunk] = box;
    travel[chunk] += box.speed(frame) * Case::time_step;
  }

  /// Whether particles must be sorted before this step. If not, the next decision is set. `chunks`: in use.
  bool order_is_due(long long step, int chunks) {
    if (step < next_decision) return false;
    double longest = 0, fastest = 0;
    for (int c = 0; c < chunks; ++c) longest = max(travel[c], longest), fastest = max(velocities[c].speed(), fastest);
    const VelocityBox still{{0, 0, 0}, {0, 0, 0}};
    const double rest = outer.allowed_travel() - longest;
    const double of_a_step = (speed_growth * fastest + still.speed(frame)) * Case::time_step;
    const bool is_short_lived = fewest_steps * of_a_step > outer.allowed_travel();
    if (!((is_short_lived ? 0 : of_a_step) <= rest)) return true;
    // What flies as one leaves a periodic pipe without using anything up; it must not by a whole length.
    if (D::is_periodic &&
        abs(frame[2]) * Case::time_step * static_cast<double>(step - sorted_at) > 0.5 * Case::pipe_length)
      return true;
    const int most =
        step < order_interval ? 1 : order_interval;  // what lies overlapping at the start becomes fast at once
    const int lasts = most * of_a_step <= rest ? most : static_cast<int>(rest / of_a_step);
    next_decision = step + (lasts > 0 ? lasts : 1);
    return false;
  }
  /// After a sort. In a state so fast that no allowance would do, the next decision is made at the next step.
  /// `chunks`: in use before it or after it.
  void start_order(const Particles<Case>& p, long long step, int chunks) {
    VelocityBox all;
    for (int chunk = 0; chunk < chunks; ++chunk) {
      const int base = chunk * Cap::chunk_size;
      velocities[chunk] = {};
      for (int i = base; i < base + particles_in(p, chunk); ++i) velocities[chunk].add(p.motion[i], p.motion[i]);
      all.add(velocities[chunk]);
      travel[chunk] = 0;
    }
    for (int c = 0; c < 3; ++c) frame[c] = 0.5 * (all.low[c] + all.high[c]);
    ++sorts;
    sorted_at = step;
    most_reach = outer.reach > most_reach ? outer.reach : most_reach;
    if (order_is_due(next_decision = step, chunks_in_use(p))) next_decision = step + 1;
  }
};

}  // namespace fixdem
