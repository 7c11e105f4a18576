// Start states for the cases that begin from another one's final state, without running that one: particles
// arranged at rest, written as the file that the other case would have left.
#pragma once

#include <string>

#include "tools/run/arrangement.hpp"
#include "tools/run/state_file.hpp"

namespace fixdem::tests {

inline program::StoredState pile(int count, const std::string& case_name) {
  program::StoredState state;
  state.case_name = case_name;
  state.complete = true;
  state.diameter = 0.01;
  state.time = state.duration = 1.2;
  state.step = 600000;
  state.particles = program::arrange_moving({0.05, 0.79, false}, count, 0.01, 0, 1);
  state.images.assign(static_cast<std::size_t>(count), 0);
  return state;
}

}  // namespace fixdem::tests
