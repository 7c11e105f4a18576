// What a run writes while it goes: log.csv, frames and dump, the force network, the files of a line; how far each has
// come, and how they are continued.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "case_facts.hpp"
#include "log.hpp"
#include "options.hpp"
#include "output_file.hpp"
#include "snapshot.hpp"
#include "vtp_arrays.hpp"
#include "vtp_series.hpp"

namespace fixdem::program {

/// A file that grows, by its name in the folder.
struct NamedPosition {
  std::string name;
  FilePosition file;
  template <class Archive>
  void transfer(Archive& archive) {
    archive(name, file);
  }
};

/// How far the outputs had come.
struct OutputPosition {
  std::vector<NamedPosition> grown;
  std::vector<WrittenFrame> frames, contacts;
  template <class Archive>
  void transfer(Archive& archive) {
    archive(grown, frames, contacts);
  }
};

/// Empty when the files in the folder still begin with what had been written; otherwise what differs in one of them.
std::string difference(const Options&, const OutputPosition&);

class Outputs {
 public:
  /// Begins them anew, or continues them behind a position. Those that are not what they were then are refused (exit
  /// code 3, naming which and how) before anything is changed.
  Outputs(const CaseFacts&, const Options&, const OutputPosition* continued);

  void log(const LogRow& row) { append("log.csv", log_line(facts_, row)); }
  void frame(const Snapshot&);     ///< nothing when frames are not wanted
  void contacts(const Snapshot&);  ///< likewise
  /// To a file that the case has.
  void append(const std::string& name, std::string_view record) { grown_.at(name).append(record); }
  bool writes_frames() const { return frames_.has_value(); }
  int frame_count() const { return frames_ ? frames_->count() : 0; }

  OutputPosition position() const;
  /// Empty when the files are what has been written; otherwise what somebody else has done to one of them.
  std::string damage() const;
  /// Everything so far survives a power cut.
  void flush();

 private:
  VtpData data() const { return facts_.text_frames ? VtpData::text : VtpData::appended; }

  const CaseFacts& facts_;
  const Options& options_;
  std::map<std::string, AppendedFile> grown_;
  std::optional<VtpSeries> frames_, contacts_;
};

}  // namespace fixdem::program
