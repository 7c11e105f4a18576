// When outputs are due, counted in whole steps: event k of an interval is at the step nearest to k * interval.
//
// An interval of 0 or less, or without end, never comes due; one shorter than a step comes due every step. The first
// event is at the start of the run; the program itself adds one at its end. An event beyond `most_steps`, which no run
// reaches, never comes: there the number of a step would no longer be exact, and soon not fit its type.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace fixdem::program {

/// Longer runs are refused: up to here (2^53) a double counts steps exactly.
inline constexpr double most_steps = 9e15;

class Schedule {
 public:
  Schedule(double interval, double time_step) : steps_(interval / time_step) {
    if (!(interval > 0) || std::isinf(interval)) next_ = never;
  }

  long long next() const { return next_; }
  bool is_due(long long step) const { return step >= next_; }
  void advance(long long step) {
    while (next_ != never && next_ <= step) {
      const double place = static_cast<double>(++event_) * steps_;
      next_ = place < most_steps ? std::max(next_ + 1, std::llround(place)) : never;
    }
  }
  /// For checkpoints.
  template <class Archive>
  void transfer(Archive& archive) {
    archive(event_, next_);
  }

 private:
  static constexpr long long never = std::numeric_limits<long long>::max();
  double steps_;
  long long event_ = 0, next_ = 0;
};

}  // namespace fixdem::program
