// Writing files so that nobody ever reads half of one.
//
// Whole files go to a temporary name in the same folder and are renamed when complete; `durable` ones are flushed to
// the disk first, and the folder after. Files that grow (log.csv, dump.lammpstrj) are appended to in whole records, and
// a record that does not fit on the disk is cut off again. How far such a file has come is its size and the XXH64 of
// its bytes; from there it can be continued, and what was written after is cut off. Every error is a Failure with exit
// code 6 that names the file and the reason.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "running_hash.hpp"

namespace fixdem::program {

enum class Durability { fast, durable };

void write_file(const std::filesystem::path&, std::string_view bytes, Durability);

/// How far a file had been written.
struct FilePosition {
  std::uint64_t size = 0, hash = 0;
  template <class Archive>
  void transfer(Archive& archive) {
    archive(size, hash);
  }
};

/// Empty when the file still begins with what had been written; otherwise what differs: "log.csv has 10 bytes ...".
std::string difference(const std::filesystem::path&, const FilePosition&);

/// A file that grows by whole records.
class AppendedFile {
 public:
  /// Begins it, or continues it behind a position that has been checked.
  explicit AppendedFile(const std::filesystem::path&, const FilePosition& = {});
  ~AppendedFile();
  AppendedFile(const AppendedFile&) = delete;
  AppendedFile& operator=(const AppendedFile&) = delete;

  void append(std::string_view record);
  FilePosition position() const;
  void flush();

 private:
  std::filesystem::path path_;
  int descriptor_;
  std::uint64_t size_ = 0;
  RunningHash hash_;
};

/// Makes what has been written to a file or folder survive a power cut.
void flush_file(const std::filesystem::path&);
void flush_folder(const std::filesystem::path&);

void make_folder(const std::filesystem::path&);

}  // namespace fixdem::program
