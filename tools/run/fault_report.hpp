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

/// What overlaps and ways are told in: "radii", with several sizes of the smallest particle.
const char* overlap_unit(const CaseFacts&);

/// How the particle of a fault is told: its serial number, and its kind for the diameter.
struct NamedParticle {
  long long serial;
  int kind;
};

/// "particle 318 has an overlap of 0.61 radii (limit 0.5)"; with several sizes the particle's diameter is named.
std::string fault_sentence(const CaseFacts&, const Status&, const NamedParticle&);
inline std::string fault_sentence(const CaseFacts& facts, const Status& status) {
  return fault_sentence(facts, status, {status.particle, status.particle});
}

/// What to change. For an unstable run the time step is compared with the duration of a contact at `speed` (maximum
/// speed seen before the fault; the case's reference speed if that is 0): 20 steps per contact are asked for.
std::string fault_advice(const CaseFacts&, const Status&, double speed);

/// Empty where a contact has time steps enough for a true rebound; otherwise the warning: by the deepest overlap so
/// far, m, or before there is one by the speed that the case expects.
std::string contact_warning(const CaseFacts&, double deepest_overlap);

/// Duration of the shortest contact that the case can have, of two particles of any kinds or with a wall, without
/// damping, at this approach speed, s (contact_time.hpp). Infinite where nothing can touch.
double contact_time(const CaseFacts&, double speed);
/// The same of an impact with this maximum overlap, m.
double contact_time_of(const CaseFacts&, double max_overlap);

}  // namespace fixdem::program
