// The command line of a case's program (CLI11): what a user may change without compiling anything again.
#pragma once

#include <filesystem>
#include <optional>

#include "case_facts.hpp"
#include "simulation_view.hpp"

namespace fixdem::program {

struct Options {
  std::filesystem::path out;                         ///< folder of all results
  std::optional<std::filesystem::path> start_state;  ///< given explicitly, instead of ../<other>/final.fixdem
  unsigned long long seed = 0;
  double duration = 0;  ///< s
  bool quiet = false;
  bool frames = true;
};

/// Empty when --help or --version has been answered; throws Failure (exit 2) on wrong usage.
std::optional<Options> read_options(const CaseFacts&, const SimulationView&, int argc, char** argv);

}  // namespace fixdem::program
