// The command line of a case's program (CLI11): what a user may change without compiling anything again.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "case_facts.hpp"
#include "simulation_view.hpp"

namespace fixdem::program {

struct Options {
  std::filesystem::path out;                         ///< folder of all results
  std::optional<std::filesystem::path> start_state;  ///< given explicitly, instead of ../<other>/final.fixdem
  std::uint64_t start_hash = 0;                      ///< XXH64 of the state that the run starts from; 0: of no file
  unsigned long long seed = 0;
  double duration = 0;   ///< s
  double extension = 0;  ///< s beyond the duration of the finished run in the folder
  bool quiet = false;
  bool watch = false;  ///< a live picture instead of the table, if there is a terminal
  bool frames = true;
  bool resume = false;
  std::optional<std::filesystem::path> resume_from;  ///< a certain checkpoint instead of the latest
  bool fresh = false;                                ///< results that lie in the folder are moved aside
  bool replace = false;                              ///< ... or thrown away
  bool keeps_checkpoint = true;                      ///< once it is done, so that it can be extended
  double checkpoint_interval = 0;                    ///< s of simulated time; 0: by the clock (time_loop.hpp)
  bool seed_is_given = false, duration_is_given = false;
};

inline constexpr const char* program_version = "0.1.0";

/// Empty when --help or --version has been answered; throws Failure (exit 2) on wrong usage.
std::optional<Options> read_options(const CaseFacts&, const SimulationView&, int argc, char** argv);

}  // namespace fixdem::program
