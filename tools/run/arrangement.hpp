// A random arrangement of spheres without overlap, seeded and the same on every machine.
//
// Random sequential insertion: a uniformly random place in the pipe is taken when no earlier sphere is nearer than
// 1.001 times where the two would touch. That saturates far below a packed bed, so a sphere that finds no place in 200
// tries is put down anyway, and the overlaps are relaxed away: in sweeps over all pairs nearer than that, both are
// pushed apart to that distance and kept inside the walls, until none overlap. Spheres of several sizes are inserted
// the largest first, while there is room for them. Neighbours come from grids of cells (cell_grid.hpp). Only additions,
// multiplications, divisions and square roots are used, so the result is bit-identical everywhere.
//
// Centres stay within pipe radius - r of the axis (also where the case has no pipe wall) and between r and length - r
// with closed ends, r being the sphere's own radius; with periodic ends distances are those of the nearest image. SI
// units.
#pragma once

#include <array>
#include <vector>

#include "simulation_view.hpp"

namespace fixdem::program {

struct Container {
  double pipe_diameter, pipe_length;
  bool is_periodic;
};

using Position = std::array<double, 3>;

/// What it took, for messages and tests.
struct ArrangementReport {
  int inserted_overlapping = 0;
  int sweeps = 0;
  /// Of any two centres that are near, over that where they would touch; 1.001 or more if none is nearer.
  double min_distance = 0;
};

/// Equal spheres, numbered along the pipe. Throws Failure (exit 3) with the numbers when the overlaps cannot be relaxed
/// away.
std::vector<Position> arrange(const Container&, int count, double diameter, unsigned long long seed,
                              ArrangementReport* report = nullptr);
/// Spheres of these diameters, in their order.
std::vector<Position> arrange(const Container&, const std::vector<double>& diameters, unsigned long long seed,
                              ArrangementReport* report = nullptr);

/// The same with velocities, each component uniform in +-speed; no rotation.
std::vector<Particle> arrange_moving(const Container&, int count, double diameter, double speed,
                                     unsigned long long seed);
std::vector<Particle> arrange_moving(const Container&, const std::vector<double>& diameters, double speed,
                                     unsigned long long seed);

}  // namespace fixdem::program
