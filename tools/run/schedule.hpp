// When outputs are due, counted in whole steps: event k of an interval is at the step nearest to k * interval.
//
// An interval of 0 or less, or without end, never comes due; one shorter than a step comes due every step. The first
// event is at the start of the run; the program itself adds one at its end. An event beyond `most_steps`, which no run
// reaches, never comes: there the number of a step would no longer be exact, and soon not fit its type.
#pragma once

#include <cmath>
#include <limits>

namespace fixdem::program {

/// Longer runs are refused: up to here (2^53) a double counts steps exactly.
inline constexpr double most_steps = 9e15;

inline bool is_possible_duration(double duration, double time_step) {
  const double steps = duration / time_step;
  return duration >= 0 && steps >= 0 && steps < most_steps;
}
inline long long steps_of(double duration, double time_step) { return std::llround(duration / time_step); }

class Schedule {
 public:
  Schedule(double interval, double time_step) : steps_(interval / time_step) {
    if (!(interval > 0) || std::isinf(interval)) next_ = never;
  }

  long long next() const { return next_; }
  bool is_due(long long step) const { return step >= next_; }
  /// To the first event after this step.
  void advance(long long step) {
    if (next_ == never || next_ > step) return;
    if (steps_ < 1) {
      next_ = step + 1;
      return;
    }
    double event = std::floor(static_cast<double>(step) / steps_), place = event * steps_;
    while (place < most_steps && std::llround(place) <= step) place = ++event * steps_;
    next_ = place < most_steps ? std::llround(place) : never;
  }

 private:
  static constexpr long long never = std::numeric_limits<long long>::max();
  double steps_;
  long long next_ = 0;
};

}  // namespace fixdem::program
