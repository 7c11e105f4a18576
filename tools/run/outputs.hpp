// What a run writes while it goes: log.csv, frames and dump, how far each has come, and how they are continued.
#pragma once

#include <optional>

#include "case_facts.hpp"
#include "frames_vtp.hpp"
#include "log.hpp"
#include "options.hpp"
#include "output_file.hpp"
#include "snapshot.hpp"

namespace fixdem::program {

/// How far the outputs had come.
struct OutputPosition {
  FilePosition log;
  std::optional<FilePosition> dump;
  std::vector<WrittenFrame> frames;
  template <class Archive>
  void transfer(Archive& archive) {
    archive(log, dump, frames);
  }
};

/// Empty when the files in the folder still begin with what had been written; otherwise what differs in one of them.
std::string difference(const Options&, const OutputPosition&);

class Outputs {
 public:
  /// Begins them anew, or continues them behind a position. Those that are not what they were then are refused (exit
  /// code 3, naming which and how) before anything is changed.
  Outputs(const CaseFacts&, const Options&, const OutputPosition* continued);

  void log(const LogRow& row) { log_.write(row); }
  void frame(const Snapshot&);  ///< nothing when frames are not wanted
  bool writes_frames() const { return frames_.has_value(); }
  int frame_count() const { return frames_ ? frames_->count() : 0; }

  OutputPosition position() const;
  /// Empty when the files are what has been written; otherwise what somebody else has done to one of them.
  std::string damage() const;
  /// Everything so far survives a power cut.
  void flush();

 private:
  const CaseFacts& facts_;
  const Options& options_;
  LogFile log_;
  std::optional<FrameWriter> frames_;
  std::optional<AppendedFile> dump_;
};

}  // namespace fixdem::program
