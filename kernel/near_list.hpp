// The near list: who may touch whom, and for how long that stays true.
//
// A promise in way. A range of pairs lists what is closer than d + margin, a chunk the walls closer than margin;
// nothing else can touch until the particles concerned have used up the margin. Each chunk keeps a bound on the way its
// particles have come since they were sorted, and each range the ways at which it was listed; so one fast particle
// makes its own surroundings be listed anew (listing.hpp) and no others. The margin is what the present speeds would
// use up in `horizon_steps`, within bounds, so a bed at rest keeps a list of almost exactly its contacts. Being an
// upper bound, the list causes no error: what it omits does not touch.
//
// Candidates for a range come from the order along the pipe: when particles are sorted (order.hpp, renewal.hpp), each
// notes how many followers lie within d + greatest margin + slack in z. That holds until two particles have come the
// slack nearer to each other. Whether to sort again is decided every `order_interval` steps, with an allowance for the
// way until the next decision, or at every step while particles are so fast that no allowance would do (`in_haste`).
// The decisions depend on step numbers and states alone, so results depend neither on how a run is cut into pieces nor
// on the order in which chunks are worked off.
#pragma once

#include "contacts.hpp"
#include "status.hpp"
#include "watch.hpp"

namespace fixdem {

inline constexpr double horizon_steps = 240;  ///< as long as a list of a bed should last; measured optimum 200-300
/// In diameters. A scene in motion looks at fewer pairs the smaller it is, and lists them more often: million
/// particle-steps/s of an agitated start 293 with 0.015 and 0.02, 285 with 0.025, 273 with 0.04; a plug 88 with any.
/// Two margins stay below the 0.1 d that floaters need.
inline constexpr double greatest_margin = 0.02;
inline constexpr double least_margin = 1e-5;  ///< in diameters: at rest, before gravity has acted
inline constexpr double order_slack = 0.2;    ///< in diameters: how much nearer two particles may come between sorts
inline constexpr int order_interval = 16;     ///< steps between two decisions whether to sort
inline constexpr double speed_growth = 4;     ///< allowed for between two decisions; beyond, the run stops

/// Until when a range of pairs, with the walls of its chunk, holds.
struct Promise {
  double margin;              ///< m
  double own_way, other_way;  ///< ways of the chunk and of the one its partners lie in, when it was listed, m
  double third_way;           ///< across the periodic ends partners lie in two chunks
};

template <class Case>
struct NearList {
  using D = Derived<Case>;
  using Cap = Capacity<Case>;
  static constexpr int count = Case::particle_count;
  static constexpr int ranges = PairBatches<Case>::ranges;
  /// The first particles, seen once more behind the last in a periodic pipe.
  static constexpr int copies = D::is_periodic ? (count < Cap::chunk_size ? count : Cap::chunk_size) : 0;

  double way[Cap::chunks];    ///< bound on the way of each particle of a chunk since the sort, m
  double speed[Cap::chunks];  ///< bound on its present speed, m/s
  Promise promise[ranges];
  int end_of_reach[count];  ///< behind the last candidate of each particle; beyond `count` in a periodic pipe
  bool in_haste;
  long long listings, sorts;

  // High-water marks of the capacities.
  int most_neighbours, most_chunk_pairs, most_wrap_pairs, most_reach;

  /// Chunks in which the particles of a range lie: owners, partners, and across the ends more partners.
  struct Concerned {
    int own, other, third;
    explicit Concerned(int range) {
      const bool wraps = range == Cap::chunks;
      own = wraps ? 0 : range;
      other = wraps ? Cap::chunks - 1 : (range + 1 < Cap::chunks ? range + 1 : range);
      third = wraps && Cap::chunks > 1 ? Cap::chunks - 2 : other;
    }
  };

  /// Whether some pair or wall of the range could touch unlisted. A NaN counts as yes.
  bool is_broken(int range) const {
    const Promise& p = promise[range];
    const int chunks = Cap::chunks;
    if (D::is_periodic && range == chunks) {
      const double owners = way[0] - p.own_way;
      double partners = way[chunks - 1] - p.other_way;
      if constexpr (Cap::chunks > 1) partners = max(partners, way[chunks - 2] - p.third_way);
      return !(owners + partners <= p.margin);
    }
    const double own = way[range] - p.own_way;
    const double other = chunks > 1 && range + 1 < chunks ? way[range + 1] - p.other_way : 0;
    return !(own + max(own, other) <= p.margin);
  }

  /// A new promise from the present speeds.
  void promise_anew(int range) {
    Promise& p = promise[range];
    const Concerned at(range);
    p.own_way = way[at.own], p.other_way = way[at.other], p.third_way = way[at.third];
    const double wanted =
        2 * max(speed[at.own], max(speed[at.other], speed[at.third])) * Case::time_step * horizon_steps * 1.2;
    constexpr double least = least_margin * Case::diameter, greatest = greatest_margin * Case::diameter;
    p.margin = wanted < least ? least : (wanted > greatest ? greatest : wanted);
  }

  /// Whether particles are so slow that no contact of the range turns by an angle that counts in the law: whose square
  /// is half a unit in the last place (turning_square). In a step two particles move by twice the bound on the speed at
  /// most, over the distance of their centres, or one over its distance from the axis; a factor of four is left.
  bool is_still(int range) const {
    constexpr double reach = D::pipe_radius - D::radius;
    constexpr double lever = Case::has_wall && reach < Case::diameter ? reach : Case::diameter;
    constexpr double angle = is_mixed<Case> ? 0x1p-13 : 0x1p-27, limit = angle * lever / (8 * Case::time_step);
    const Concerned at(range);
    return speed[at.own] < limit && speed[at.other] < limit && speed[at.third] < limit;
  }

  double longest_way() const {
    double longest = 0;
    for (double w : way) longest = max(w, longest);
    return longest;
  }
  double greatest_speed() const {
    double greatest = 0;
    for (double v : speed) greatest = max(v, greatest);
    return greatest;
  }

  /// Twice the way to the next decision at speeds that may grow.
  double allowance() const { return 2 * order_interval * speed_growth * greatest_speed() * Case::time_step; }
  /// Whether the order along the pipe must be made anew before this step.
  bool order_is_due(long long step) {
    constexpr double slack = order_slack * Case::diameter;
    if (step % order_interval == 0) return !(2 * longest_way() + allowance() <= slack);
    return in_haste && !(2 * longest_way() <= slack);
  }
  /// Called before every step at which a decision is made, sorted or not.
  void choose_pace(long long step) {
    if (step % order_interval == 0) in_haste = step == 0 || !(allowance() <= order_slack * Case::diameter);
  }
};

}  // namespace fixdem
