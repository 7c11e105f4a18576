// What an earlier run has left in a folder, and whether it is the one that is asked for.
//
// A run is finished when summary.json says `done`, the final state is that of its end, and no checkpoint of a longer
// run lies there (an extension that has been stopped). What it was is read from its latest checkpoint or, where none
// has been kept, from summary.json. Nothing in the folder is changed.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "checkpoint.hpp"
#include "options.hpp"

namespace fixdem::program {

/// A checkpoint to continue, and the file it comes from.
struct Resumable {
  std::filesystem::path path;
  Checkpoint checkpoint;
};

struct FoundRun {
  bool is_there = false;  ///< any result at all
  bool is_finished = false;
  Identity identity;    ///< as far as it is known; from summary.json alone a part
  double duration = 0;  ///< s, asked for
  std::uint64_t seed = 0, start = 0;
  bool frames = true;
  bool is_known = false;                ///< the last five are
  std::optional<Resumable> checkpoint;  ///< the latest that can be read
  std::string words;                    ///< "the finished run of settle, 0.2 s"
};

FoundRun find_run(const std::filesystem::path& out, double time_step);

/// What differs between that run and the one that is asked for: program, case and options, one line each; empty when
/// the bytes would be the same.
std::string differences(const FoundRun&, const CaseFacts&, SimulationView&, const Options&);
/// The same of program and case alone.
std::string differences(const FoundRun&, const CaseFacts&, SimulationView&);

/// The checkpoint that the options ask for: a given one, or the latest in the folder. Nothing when there is none and
/// the run has to begin at its beginning. A damaged or foreign one is refused with exit code 3, and so are options that
/// contradict it, with 2.
std::optional<Resumable> find_checkpoint(const Identity&, const Options&);

/// Advice for a refusal of the checkpoint at `path`: an older one in the folder that is good; empty when there is none.
std::string offer_older(const std::filesystem::path& path, const Identity&, const Options&);

/// Refuses options that contradict a run that is to be continued (exit code 2). `where`: its checkpoint or folder.
void check_options(const Options&, const std::string& where, std::uint64_t seed, bool frames, std::uint64_t start);

}  // namespace fixdem::program
