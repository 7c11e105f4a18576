// Back to the last good step after a fault: a copy of the simulation from a little earlier, run forward again.
//
// A fault is found in a state that already has it. Steps follow from the state alone, so running the copy again gives
// the same states up to the step before. A copy is taken between blocks of steps, when the run has gone on for 20 ms
// since the last one and for two hundred times as long as that took. Simulations beyond 1 GiB are not doubled like
// that: their runs end in the state of the fault.
#pragma once

#include <string>

#include "simulation_view.hpp"

namespace fixdem::program {

class Rewind {
 public:
  explicit Rewind(SimulationView& view) : view_(view) {}

  /// Between blocks of steps; `seconds` of run time so far.
  void keep(double seconds);
  /// After a fault: the simulation is that of the last step before it. False when it cannot be brought back.
  bool go_back(const Status& fault);

 private:
  bool put_back();

  SimulationView& view_;
  std::string copy_;
  long long step_ = 0;
  double next_ = 0;  ///< s of run time, when a copy is due again
};

}  // namespace fixdem::program
