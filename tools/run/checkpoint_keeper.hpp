// Writes the checkpoints of a run and keeps the last two; finds the one to resume from.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "checkpoint.hpp"
#include "options.hpp"

namespace fixdem::program {

class CheckpointKeeper {
 public:
  /// `last`: the one that the run has been resumed from, or nothing.
  CheckpointKeeper(std::filesystem::path out, std::filesystem::path last)
      : out_(std::move(out)), last_(std::move(last)) {}

  /// Writes it durably; then all others but the one before are removed. A failure leaves those there are as they are.
  void write(Checkpoint&);
  /// Once the run is done.
  void remove_all() const;

  /// The last one written or resumed from; empty when there is none.
  const std::filesystem::path& last() const { return last_; }

 private:
  std::filesystem::path out_, last_;
};

/// A checkpoint to continue, and the file it comes from.
struct Resumable {
  std::filesystem::path path;
  Checkpoint checkpoint;
};

/// The checkpoint that the options ask for: a given one, or the latest in the folder. Nothing when there is none and
/// the run has to begin at its beginning. A damaged or foreign one is refused with exit code 3, and so are options that
/// contradict it, with 2.
std::optional<Resumable> find_checkpoint(const Identity&, const Options&);

/// Whether the folder holds the final state of this case, run to its end. Results of another run are refused (3).
bool is_done_already(const CaseFacts&, const Options&);

/// Advice for a refusal of the checkpoint at `path`: an older one in the folder that is good; empty when there is none.
std::string offer_older(const std::filesystem::path& path, const Identity&, const Options&);

}  // namespace fixdem::program
