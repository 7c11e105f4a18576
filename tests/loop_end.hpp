// How the program's time loop ends: the exit code, and what the user is told.
#pragma once

#include <string>

#include "tools/run/failure.hpp"
#include "tools/run/time_loop.hpp"

namespace fixdem::tests {

struct LoopEnd {
  int code = 0;
  std::string message;
};

inline LoopEnd end_of_loop(program::SimulationView& view, const program::CaseFacts& facts,
                           const program::Options& options) {
  try {
    return {program::TimeLoop(view, facts, options).run(), ""};
  } catch (const program::Failure& failure) {
    return {failure.code(), failure.what()};
  }
}

}  // namespace fixdem::tests
