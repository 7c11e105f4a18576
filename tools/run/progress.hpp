// How far the run is, on stderr: bar, per cent, time left, million particle-steps per second.
//
// On a terminal one line that is rewritten; NO_COLOR takes its colour away, TERM=dumb the rewriting too. Elsewhere
// plain lines, one for every 10 % at most. The rate counts time inside the kernel only.
#pragma once

#include <chrono>
#include <string>

#include "case_facts.hpp"

namespace fixdem::program {

class Progress {
 public:
  /// Of steps from `first_step` on.
  Progress(const CaseFacts&, long long first_step, long long total_steps, bool quiet);

  /// `particle_steps`: of all steps.
  void update(long long steps, double particle_steps, double kernel_seconds);
  /// Takes the line off the terminal, before something else is printed.
  void clear();

 private:
  enum class Style { none, plain, bar };

  std::string name_;
  double time_step_;
  long long first_, total_;
  Style style_ = Style::none;
  bool colour_ = false, on_screen_ = false;
  int last_tenth_ = 0;
  std::chrono::steady_clock::time_point begin_;
};

}  // namespace fixdem::program
