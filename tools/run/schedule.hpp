// When outputs are due, counted in whole steps: event k of an interval is at the step nearest to k * interval.
//
// An interval of 0 or less, or without end, never comes due; one shorter than a step comes due every step. The first
// event is at the start of the run; the program itself adds one at its end.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace fixdem::program {

class Schedule {
 public:
  Schedule(double interval, double time_step) : steps_(interval / time_step) {
    if (!(interval > 0) || std::isinf(interval)) next_ = never;
  }

  long long next() const { return next_; }
  bool is_due(long long step) const { return step >= next_; }
  void advance(long long step) {
    if (next_ == never) return;
    while (next_ <= step) next_ = std::max(next_ + 1, std::llround(static_cast<double>(++event_) * steps_));
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
