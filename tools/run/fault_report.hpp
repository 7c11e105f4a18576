// What a person reads when the kernel stops: which particle, when, the value and its limit, and what to change.
#pragma once

#include <string>

#include "case_facts.hpp"
#include "failure.hpp"
#include "kernel/fixdem.hpp"

namespace fixdem::program {

/// Word for summary.json: "overlap", "non_finite", ...
const char* fault_name(Fault);
ExitCode fault_exit_code(Fault);

/// "particle 318 has an overlap of 0.61 radii (limit 0.5)"
std::string fault_sentence(const CaseFacts&, const Status&);

/// What to change. For an unstable run the time step is compared with the duration of a contact at `speed` (greatest
/// speed seen before the fault; the case's reference speed if that is 0): 20 steps per contact are asked for.
std::string fault_advice(const CaseFacts&, const Status&, double speed);

/// Duration of the shortest contact of two particles, or of one with a wall, at this approach speed, without damping,
/// s: 2.9433 (greatest overlap)/speed with Hertz, half a period with the linear law.
double contact_time(const CaseFacts&, double speed);

}  // namespace fixdem::program
