// The program, from command line to exit code: start, time loop, outputs.
#pragma once

#include "case_facts.hpp"
#include "simulation_view.hpp"

namespace fixdem::program {

/// Returns the exit code (failure.hpp). Never throws.
int run_program(SimulationView&, const CaseFacts&, int argc, char** argv) noexcept;

}  // namespace fixdem::program
