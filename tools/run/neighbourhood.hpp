// fault.vtp: the particles around the one that a fault names, at the last good step.
#pragma once

#include <vector>

#include "case_facts.hpp"
#include "snapshot.hpp"

namespace fixdem::program {

inline constexpr double neighbourhood_reach = 3;  ///< distance of centres, in diameters of the largest particle

/// Numbers of the particles within reach of one, itself among them, across periodic ends too; all when it is -1.
std::vector<int> neighbourhood(const CaseFacts&, const Snapshot&, int particle);

}  // namespace fixdem::program
