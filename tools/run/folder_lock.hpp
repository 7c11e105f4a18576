// One run at a time in a folder: a file `lock` in it that holds process and host of its owner.
//
// The owner holds the operating system's lock on the file, which ends with the process however that ends, so a file
// that a killed run has left behind is recognised: nobody holds it. Locks may not reach other hosts (network file
// systems), so a file that names another host is believed. Where there are no such locks, it is asked whether the
// process lives.
#pragma once

#include <filesystem>

namespace fixdem::program {

class FolderLock {
 public:
  /// Failure (exit code 6) when another run has the folder: names its process, and what to do.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
};

}  // namespace fixdem::program
