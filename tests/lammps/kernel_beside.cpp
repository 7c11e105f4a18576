// What the kernel makes of a state whose contact histories are empty, for comparison with LAMMPS (lammps_test.py).
//
// Usage: kernel_beside start STATE   writes the particles that the case places one by one as a state file
//        kernel_beside run STATE STEPS euler|leapfrog   the state afterwards, as a LAMMPS dump on stdout
//        kernel_beside gas STATE   one update of the gas: a line `slice,...` for each slice, `force,...` for each
//                                  particle (N, and whether it floats), all in SI units
// Compiled for a case like its program.
#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
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

template <Integrator chosen>
struct Setting : Original {
  static constexpr Integrator integrator = chosen;
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

/// Of a case whose start is a list of particles.
template <class Case>
void write_start(const std::string& path) {
  if constexpr (Case::start == StartKind::placed) {
    const auto simulation = std::make_unique<Simulation<Case>>();
    for (int id = 0; id < Case::particle_count; ++id) {
      Particle particle;
      std::memcpy(&particle, &Case::placed[id], sizeof particle);
      simulation->place(id, particle);
    }
    require(simulation->start());
    const auto snapshot = program::take_snapshot(program::CaseAdapter<Case>(*simulation), Case::particle_count);
    program::write_state(path, program::stored_state(program::case_facts<Case>(), snapshot, false, 0));
  } else {
    throw std::runtime_error("the case places no particles one by one");
  }
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
    } else if (mode == "start" && argc == 3) {
      write_start<Original>(argv[2]);
    } else if (mode == "run" && argc == 5 && argv[4] == std::string("leapfrog")) {
      run<Setting<Integrator::leapfrog>>(argv[2], std::atoll(argv[3]));
    } else if (mode == "run" && argc == 5 && argv[4] == std::string("euler")) {
      run<Setting<Integrator::euler>>(argv[2], std::atoll(argv[3]));
    } else {
      std::fputs(
          "usage: kernel_beside start STATE, kernel_beside run STATE STEPS euler|leapfrog, or kernel_beside gas "
          "STATE\n",
          stderr);
      return 2;
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "kernel_beside: %s\n", error.what());
    return 1;
  }
}
