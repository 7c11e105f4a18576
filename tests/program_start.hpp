// Start states for the cases that begin from another one's final state, without running that one: particles
// arranged at rest, written as the file that the other case would have left.
#pragma once

#include <string>

#include "tools/run/arrangement.hpp"
#include "tools/run/state_file.hpp"

namespace fixdem::tests {

/// In a pipe that is 50 mm wide and a little more than 0.79 m long, or in another one.
inline program::StoredState pile(int count, const std::string& case_name, double diameter = 0.01,
                                 program::Container pipe = {0.05, 0.79, false}) {
  program::StoredState state;
  state.case_name = case_name;
  state.complete = true;
  state.diameter = diameter;
  state.time = state.duration = 1.2;
  state.step = 600000;
  state.particles = program::arrange_moving(pipe, count, diameter, 0, 1);
  state.images.assign(static_cast<std::size_t>(count), 0);
  return state;
}

}  // namespace fixdem::tests
