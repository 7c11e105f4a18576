// How the program ends: exit codes, and the one exception that carries them.
//
// Everything that stops a run before it is done throws Failure with the code and a message for a person; only
// run_program (driver.cpp) catches it. The kernel itself knows neither exceptions nor exit codes.
#pragma once

#include <stdexcept>
#include <string>

namespace fixdem::program {

enum ExitCode : int {
  exit_done = 0,
  exit_wrong_usage = 2,    ///< an option that does not exist or makes no sense here
  exit_bad_input = 3,      ///< the case, its arrangement or its start state cannot be used
  exit_capacity = 4,       ///< a fixed array of the kernel is full
  exit_unstable = 5,       ///< non-finite, outside the pipe, overlapping or moving too much
  exit_input_output = 6,   ///< a file could not be read or written
  exit_signal_base = 128,  ///< plus the number of the signal
};

/// Stops the program with an exit code. The message says what is wrong, with numbers, and what to change.
class Failure : public std::runtime_error {
 public:
  Failure(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

}  // namespace fixdem::program
