// How long a list of near contacts stays true.
//
// What it omits lies at least a margin away, so until those concerned have come that margin nearer, nothing that is not
// listed can touch. What uses it up is motion relative to each other: of pairs the spread between the minimum and the
// maximum velocity of their chunks, in each component, so a group that flies as one keeps its lists; of a wall the
// speed towards it. The margin is what the present motion would use up in `horizon_steps`, within bounds, so a bed at
// rest keeps a list of almost exactly its contacts.
#pragma once

#include "lanes.hpp"

namespace fixdem {

inline constexpr double horizon_steps = 240;  ///< as long as a list of a bed should last; measured optimum 200-300
/// In diameters. Million particle-steps/s of a plug early and late on Zen 5: 151 and 97 with 0.008, 149 and 98 with
/// 0.015, 144 and 95 with 0.03; walls with 0.03 are no better.
inline constexpr double maximum_margin = 0.015, maximum_wall_margin = 0.1, minimum_margin = 1e-5;

/// With long steps a margin is as wide as to last for so many: they are what lists cost. A fed line at 5e-5 s
/// took 10.8, 7.4, 6.8, 7.8 s with 1, 8, 12 and 16. Where particles come 0.0025 diameters in a step or less it changes
/// nothing.
/// But no wider than `longest_margin` (in diameters) for that: fifteen centres fit around one within 1.108 d at the
/// least (the Tammes problem), and a near list has room for fourteen.
inline constexpr double shortest_life = 6, longest_margin = 0.06;

/// Minimum and maximum velocity of a group of particles in each component, m/s.
struct VelocityBox {
  double low[3] = {1e300, 1e300, 1e300}, high[3] = {-1e300, -1e300, -1e300};

  void add(const double* lowest, const double* highest) {
    for (int c = 0; c < 3; ++c) low[c] = min(lowest[c], low[c]), high[c] = max(highest[c], high[c]);
  }
  void add(const VelocityBox& box) { add(box.low, box.high); }
  /// Bound on the speed of one particle relative to another; zero of no particles.
  double spread() const { return high[0] < low[0] ? 0 : length(high[0] - low[0], high[1] - low[1], high[2] - low[2]); }
  /// Bound on the speed relative to `frame`.
  double speed(const double* frame) const {
    return length(farthest(0, frame[0]), farthest(1, frame[1]), farthest(2, frame[2]));
  }
  double speed() const { return length(farthest(0, 0), farthest(1, 0), farthest(2, 0)); }
  double speed_across() const { return length(farthest(0, 0), farthest(1, 0), 0); }
  double speed_along() const { return farthest(2, 0); }

 private:
  double farthest(int c, double frame) const { return max(high[c] - frame, frame - low[c]); }
  static double length(double x, double y, double z) { return sqrt(fused(z, z, fused(y, y, x * x))); }
};

/// Until when a list holds: what it omits is farther away than the margin, less what the particles have used of it.
struct Validity {
  double margin, used;  ///< m

  /// `travel`: of a step; `widest`: maximum of the margin, in diameters.
  void renew(double travel, double widest, double diameter) {
    const double most = max(widest * diameter, min(travel * shortest_life, longest_margin * diameter));
    margin = min(max(travel * horizon_steps * 1.2, minimum_margin * diameter), most);
    used = 0;
  }
  /// A step further; false when the list no longer holds. A NaN counts as that.
  bool still_holds(double travel) {
    used += travel;
    return used <= margin;
  }
};

}  // namespace fixdem
