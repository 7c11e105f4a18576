// Files for ParaView that come one after another, with the list that gives their times: frames/frame_NNNNNN.vtp and
// frames.pvd, contacts/contact_NNNNNN.vtp and contacts.pvd. Each appears whole or not at all.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "output_file.hpp"

namespace fixdem::program {

/// One that has been written.
struct WrittenFrame {
  double time = 0;
  FilePosition file;
  template <class Archive>
  void transfer(Archive& archive) {
    archive(time, file);
  }
};

class VtpSeries {
 public:
  /// Begins with those that are there already. `name`: "frame", "contact".
  VtpSeries(std::filesystem::path folder, const char* name, std::vector<WrittenFrame> written = {});
  void write(double time, const std::string& bytes);
  int count() const { return static_cast<int>(written_.size()); }
  const std::vector<WrittenFrame>& written() const { return written_; }
  /// What has been written since the last call survives a power cut.
  void flush();

 private:
  void list() const;

  std::filesystem::path folder_;
  const char* name_;
  std::vector<WrittenFrame> written_;
  int flushed_;
};

}  // namespace fixdem::program
