// The kernel in a world without operating system or library: compiled with -ffreestanding, and what this file needs
// from outside must be no more than the four functions that a compiler may call by itself (memcpy and its kin).
#include "scene.hpp"

#include "kernel/fixdem.hpp"
#include "tests/identical/scenes.hpp"

namespace {
struct everything : fixdem::tests::identical::line_leapfrog {
  static constexpr int start_count = 60, particle_count = 80;
  static constexpr double pipe_length = 0.162;
};
fixdem::Simulation<everything> simulation;
}  // namespace

bool scene_start() {
  fixdem::tests::identical::place_agitated(simulation);
  return simulation.start().ok();
}
bool scene_run(long long steps) { return simulation.run(steps).ok(); }
double scene_kinetic_energy() { return simulation.energy().kinetic; }
long long scene_listings() { return simulation.listings(); }
