// How full the kernel's fixed arrays have been in a run, and what to set in the case: shrink or grow.
#pragma once

#include <string>
#include <vector>

#include "simulation_view.hpp"

namespace fixdem::program {

/// One line of uses, and one of advice where there is any, by what a case may set. Empty when a mark is missing.
std::string describe_capacities(const std::vector<CapacityUse>&, long long most_neighbours = 30);

}  // namespace fixdem::program
