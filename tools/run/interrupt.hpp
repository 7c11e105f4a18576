// SIGINT, SIGTERM, SIGHUP and SIGXCPU: remembered, so that the run can finish its block, write its state and end with
// 128 + signal.
//
// Signals repeat: make hands on to its children what a terminal or a scheduler has sent to all of them already, so the
// program sees two within a millisecond. A repetition must not cost the state that is being written; only from the
// third on, and five seconds after the first, does one end the program at once, for somebody who cannot wait for a slow
// disk. SIGXCPU, which comes every second, never does. SIGPIPE is ignored: a reader of the table that goes away
// (`| head`) must not cost the run its results. So is SIGXFSZ: a write beyond the limit on the size of files fails
// then, and is reported like a full disk.
#pragma once

namespace fixdem::program {

/// Opens /dev/null for whichever of stdin, stdout and stderr is closed, so that no file of the run gets their numbers;
/// ignores SIGPIPE and SIGXFSZ. To be called first of all.
void prepare_process();

void catch_interrupts();
/// Number of the signal that came, 0 if none.
int interrupt_signal();

}  // namespace fixdem::program
