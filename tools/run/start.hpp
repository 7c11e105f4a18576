// Where the particles of a run come from: a random arrangement, a list in the case, or another case's final state.
//
// All of them are placed by number, then the kernel starts (it refuses overlaps beyond its limit and particles outside
// the pipe), and with `motion = "keep"` the contact histories are given back. What cannot be used is a Failure with
// exit code 3; a capacity of the kernel that is too small already now gives 4.
#pragma once

#include "options.hpp"

namespace fixdem::program {

/// XXH64 of the state file that a run with these options starts from; 0 where it starts from none.
std::uint64_t start_state_hash(const CaseFacts&, const Options&);

void start_simulation(SimulationView&, const CaseFacts&, const Options&);

/// Throws that Failure when the kernel has refused to start.
void check_started(const CaseFacts&, const Status&);

}  // namespace fixdem::program
