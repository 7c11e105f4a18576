// Writing files so that nobody ever reads half of one.
//
// Whole files go to a temporary name in the same folder and are renamed when complete; `durable` ones are flushed to
// the disk first. Files that grow (log.csv, dump.lammpstrj) are appended to in whole records, and a record that does
// not fit on the disk is cut off again. Every error is a Failure with exit code 6 that names the file and the reason.
#pragma once

#include <filesystem>
#include <string_view>

namespace fixdem::program {

enum class Durability { fast, durable };

void write_file(const std::filesystem::path&, std::string_view bytes, Durability);

/// A file that grows by whole records.
class AppendedFile {
 public:
  explicit AppendedFile(const std::filesystem::path&);
  ~AppendedFile();
  AppendedFile(const AppendedFile&) = delete;
  AppendedFile& operator=(const AppendedFile&) = delete;

  void append(std::string_view record);

 private:
  std::filesystem::path path_;
  int descriptor_;
  long long size_ = 0;
};

void make_folder(const std::filesystem::path&);

/// Makes the folder and takes away the results of an earlier run, so that what lies there afterwards belongs together.
/// Nothing else in the folder is touched.
void prepare_folder(const std::filesystem::path& out);

}  // namespace fixdem::program
