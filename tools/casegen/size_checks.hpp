// The two ways to have particles of several sizes, one file each; check_sizes.cpp chooses.
#pragma once

#include "checks.hpp"

namespace fixdem::casegen {

/// Key of a placed particle's species.
std::string placed_species_key(std::size_t particle);

/// Count, diameter and density are not known: later checks that need them are left out.
void mark_sizes_unknown(Reading& reading);

/// One more, or so many more, at the end of the list.
void add_run(std::vector<SizeRun>& runs, std::int64_t count, double diameter, double density, std::size_t species);

/// Kinds of what a line is fed, behind those of its start; false when something is wrong.
bool add_fed_species(Reading& reading, Report& report);

/// Fill in `sizes`, and `count` with species, or mark them as unknown.
void take_species(Reading& reading, Report& report);
void take_distribution(Reading& reading, Report& report);

}  // namespace fixdem::casegen
