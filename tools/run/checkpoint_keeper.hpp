// Writes the checkpoints of a run and keeps the last two, or only the one of its end.
#pragma once

#include <filesystem>

#include "checkpoint.hpp"

namespace fixdem::program {

class CheckpointKeeper {
 public:
  /// `last`: the one that the run has been resumed from, or nothing.
  CheckpointKeeper(std::filesystem::path out, std::filesystem::path last)
      : out_(std::move(out)), last_(std::move(last)) {}

  /// Writes it durably; then all others but the one before are removed. A failure leaves those there are as they are.
  void write(Checkpoint&);
  /// Once the run is done: all but `kept`, which may be empty; the latest last.
  void remove_all_but(const std::filesystem::path& kept) const;

  /// The last one written or resumed from; empty when there is none.
  const std::filesystem::path& last() const { return last_; }

 private:
  std::filesystem::path out_, last_;
};

}  // namespace fixdem::program
