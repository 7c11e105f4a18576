// What the kernel makes of a state whose contact histories are empty, for comparison with LAMMPS (lammps_test.py).
//
// Usage: kernel_beside run STATE STEPS INTEGRATOR FACTOR   the state afterwards, as a LAMMPS dump on stdout; INTEGRATOR
// is
//                                                         euler or leapfrog; FACTOR 1 or 2: steps are halved so often
//        kernel_beside gas STATE      one update of the gas: a line `slice,...` for each slice, `force,...` for each
//                                     particle (N, and whether it floats), all in SI units
// Compiled for a case like its program. STEPS are steps of the case's length, whatever FACTOR.
#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>

#include FIXDEM_CASE_HEADER
#include "kernel/fixdem.hpp"
#include "tools/run/case_adapter.hpp"
#include "tools/run/case_facts.hpp"
#include "tools/run/dump.hpp"
#include "tools/run/snapshot.hpp"
#include "tools/run/state_file.hpp"

namespace {

using namespace fixdem;
using Original = cases::FIXDEM_CASE;

template <Integrator chosen, int divided>
struct Setting : Original {
  static constexpr Integrator integrator = chosen;
  static constexpr double time_step = Original::time_step / divided;
  static constexpr int gas_update_interval = Original::gas_update_interval * divided;
  static constexpr int gas_floater_interval = Original::gas_floater_interval * divided;
};

void require(const Status& status) {
  if (!status.ok()) throw std::runtime_error("the kernel stopped: " + std::to_string(static_cast<int>(status.fault)));
}

template <class Simulation>
void start_from(Simulation& simulation, const std::string& path) {
  const program::StoredState state = program::read_state(path);
  if (state.particles.size() != static_cast<std::size_t>(Simulation::count))
    throw std::runtime_error(path + " has another number of particles than the case");
  for (int id = 0; id < Simulation::count; ++id) simulation.place(id, state.particles[static_cast<std::size_t>(id)]);
  require(simulation.start());
}

template <class Case>
void run(const std::string& path, long long steps) {
  const auto simulation = std::make_unique<Simulation<Case>>();
  start_from(*simulation, path);
  require(simulation->run(steps));
  const program::CaseAdapter<Case> view(*simulation);
  const program::Snapshot snapshot = program::take_snapshot(view, Case::particle_count);
  fmt::print("{}", program::encode_dump(snapshot, program::case_facts<Case>()));
}

template <Integrator integrator>
void run(const std::string& path, long long steps, int divided) {
  if (divided == 2)
    run<Setting<integrator, 2>>(path, 2 * steps);
  else
    run<Setting<integrator, 1>>(path, steps);
}

/// The update that comes before the first step.
template <class Case>
void gas(const std::string& path) {
  const auto simulation = std::make_unique<Simulation<Case>>();
  start_from(*simulation, path);
  require(simulation->run(1));
  if constexpr (Case::has_gas) {
    const auto& state = simulation->state();
    const auto& slices = state.gas;
    for (int s = 0; s < Case::slice_count; ++s)
      fmt::print("slice,{},{},{},{},{},{},{},{},{}\n", s, slices.particles[s], slices.axial_velocity_sum[s],
                 slices.height[s], slices.bed_area[s], slices.void_fraction[s], slices.pressure_gradient[s],
                 slices.velocity_in_bed[s], slices.velocity_above[s]);
    constexpr double force_per_kick = Derived<Case>::mass / Case::time_step;
    for (int i = 0; i < Case::particle_count; ++i) {
      const double* kick = state.particles.gas_kick.row[i];
      fmt::print("force,{},{},{},{},{}\n", state.particles.id[i] + 1, int{slices.floats[state.particles.id[i]]},
                 force_per_kick * kick[0], force_per_kick * kick[1], force_per_kick * kick[2]);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::string mode = argc > 1 ? argv[1] : "";
  try {
    if (mode == "gas" && argc == 3) {
      gas<Original>(argv[2]);
    } else if (mode == "run" && argc == 6) {
      const long long steps = std::atoll(argv[3]);
      const int divided = std::atoi(argv[5]);
      if (argv[4] == std::string("leapfrog"))
        run<Integrator::leapfrog>(argv[2], steps, divided);
      else
        run<Integrator::euler>(argv[2], steps, divided);
    } else {
      std::fputs("usage: kernel_beside run STATE STEPS euler|leapfrog 1|2, or kernel_beside gas STATE\n", stderr);
      return 2;
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "kernel_beside: %s\n", error.what());
    return 1;
  }
}
