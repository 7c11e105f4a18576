// What follows from the sizes of the particles, whether they are equal, of several species or distributed. SI units.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "case_values.hpp"

namespace fixdem::casegen {

inline constexpr std::size_t most_species = 16;
inline constexpr double largest_ratio = 10;               ///< of two diameters
inline constexpr std::int64_t most_particles = 10000000;  ///< of all species together
inline constexpr std::int64_t most_distributed = 20000;   ///< each is a line of the header

inline constexpr int kinds_of_distribution = 1000;  ///< that stand for it where particles are fed

/// Consecutive particles that are equal; with one size one run, which is put into `all`.
std::span<const SizeRun> runs_of(const CaseValues& values, SizeRun& all);

/// Those of the particles at the start: all but those that a line is fed with.
std::vector<SizeRun> runs_at_start(const CaseValues& values);

/// Diameter of each particle at the start, by number.
std::vector<double> diameters_of(const CaseValues& values);

struct SizeFigures {
  double smallest = 0, largest = 0, mean = 0;  ///< diameters
  double sauter = 0;                           ///< mean diameter by volume over surface, sum d^3/sum d^2
  double mean_volume = 0;
  double reference_density = 0;  ///< of the heaviest of the largest
};
SizeFigures figures_of(std::span<const SizeRun> runs);

/// Of all particles. Of a line, mean and Sauter diameter are those of what is fed; the mean volume is that or the one
/// of the start, whichever is less.
SizeFigures figures_of(const CaseValues& values);

/// Volume of the particles at the start.
double volume_at_start(const CaseValues& values);

/// So many particles of this mean volume fill 0.64 of the pipe, as densely as random packings get.
double most_in_pipe(const CaseValues& values, double mean_volume);

/// Near pairs that one particle may need room for: 1.8 times as many of the smallest as fit around the largest by the
/// solid angle that each takes, and one.
std::int64_t neighbours_for(const SizeFigures& figures);

}  // namespace fixdem::casegen
