// SIGINT, SIGTERM and SIGXCPU: remembered, so that the run can finish its block, write its state and end with 128 +
// signal.
//
// A second signal ends the program at once (SIGXCPU, which comes every second, does not). SIGPIPE is ignored: a reader
// of the table that goes away (`| head`) must not cost the run its results.
#pragma once

namespace fixdem::program {

void catch_interrupts();
/// Number of the signal that came, 0 if none.
int interrupt_signal();

}  // namespace fixdem::program
