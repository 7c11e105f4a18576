// A live picture of the run on the terminal: the side view in letters and the key figures, drawn over itself.
//
// Only where standard output is a terminal that can go back up (not TERM=dumb); elsewhere there is none, and the run
// prints its table as always. A line is shown in pieces, one below the other, up to four. Letters of cells that move
// along the pipe at more than a tenth of a metre per second are coloured, unless NO_COLOR is set. At most ten pictures
// a second.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "case_facts.hpp"
#include "log.hpp"
#include "side_view.hpp"

namespace fixdem::program {

class Watch {
 public:
  /// Empty where there is no such terminal.
  static std::optional<Watch> on_terminal(const CaseFacts&, double duration);

  Watch(const CaseFacts&, double duration, int columns, bool colour);

  bool is_due() const;
  void show(const Snapshot&, const LogRow&);
  /// The next picture goes below what has been printed since.
  void begin_below() { lines_on_screen_ = 0; }

  /// The lines of a picture, without the way back up.
  std::string picture(const Snapshot&, const LogRow&);

 private:
  CaseFacts facts_;
  double duration_;
  std::vector<SideView> views_;  ///< of the pieces of the pipe, from z = 0 on
  bool colour_;
  int lines_on_screen_ = 0;
  std::chrono::steady_clock::time_point last_{};
};

}  // namespace fixdem::program
