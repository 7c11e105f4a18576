#include "output_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>
#include <vector>

#include "disk.hpp"
#include "failure.hpp"

namespace fixdem::program {
namespace {

[[noreturn]] void fail(const char* what, const std::filesystem::path& path, int error) {
  throw Failure(exit_input_output, fmt::format("cannot {} {}: {}", what, path.string(), std::strerror(error)));
}

/// Writes all bytes; returns 0 or the error number.
int write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = disk::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return written < 0 ? errno : ENOSPC;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

void flush(const std::filesystem::path& path, int flags) {
  const int descriptor = ::open(path.empty() ? "." : path.c_str(), flags | O_RDONLY | O_CLOEXEC);
  if (descriptor < 0 && errno == EACCES && (flags & O_DIRECTORY) != 0) return;  // may be written to, not read
  if (descriptor < 0) fail("flush", path, errno);
  const int error = disk::fsync(descriptor) != 0 ? errno : 0;
  ::close(descriptor);
  // Some file systems cannot flush a folder, and say so.
  if (error != 0 && error != EINVAL) fail("flush", path, error);
}

/// A new file for writing. What lies there goes first, so that a link is replaced, never written through.
int create(const std::filesystem::path& path) {
  if (::unlink(path.c_str()) != 0 && errno != ENOENT) return -1;
  return ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
}

/// Adds the first `size` bytes of a file to a hash; returns how many there are.
std::uint64_t hash_front(const std::filesystem::path& path, std::uint64_t size, RunningHash& hash) {
  std::ifstream file(path, std::ios::binary);
  std::vector<char> block(1 << 16);
  std::uint64_t done = 0;
  while (done < size && file) {
    file.read(block.data(), static_cast<std::streamsize>(std::min<std::uint64_t>(block.size(), size - done)));
    hash.add(block.data(), static_cast<std::size_t>(file.gcount()));
    done += static_cast<std::uint64_t>(file.gcount());
  }
  return done;
}

}  // namespace

void write_file(const std::filesystem::path& path, std::string_view bytes, Durability durability) {
  std::filesystem::path temporary = path;
  temporary += ".part";
  const int descriptor = create(temporary);
  if (descriptor < 0) fail("write", temporary, errno);
  int error = write_all(descriptor, bytes);
  if (error == 0 && durability == Durability::durable && disk::fsync(descriptor) != 0) error = errno;
  if (::close(descriptor) != 0 && error == 0) error = errno;
  if (error == 0 && disk::rename(temporary.c_str(), path.c_str()) != 0) error = errno;
  if (error != 0) {
    ::unlink(temporary.c_str());
    fail("write", path, error);
  }
  if (durability == Durability::durable) flush_folder(path.parent_path());
}

std::string difference(const std::filesystem::path& path, const FilePosition& position) {
  RunningHash hash;
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return path.string() + " is missing";
  const std::uint64_t found = hash_front(path, position.size, hash);
  if (found < position.size)
    return fmt::format("{} is cut short: it has {} bytes, and had {}", path.string(), found, position.size);
  if (hash.value() != position.hash)
    return fmt::format("{} has been changed in its first {} bytes", path.string(), position.size);
  return "";
}

AppendedFile::AppendedFile(const std::filesystem::path& path, const FilePosition& position)
    : path_(path),
      descriptor_(position.size == 0 ? create(path) : ::open(path.c_str(), O_WRONLY | O_CLOEXEC)),
      size_(position.size) {
  if (descriptor_ < 0) fail("write", path, errno);
  if (size_ == 0) return;
  const auto end = static_cast<off_t>(size_);
  if (::ftruncate(descriptor_, end) != 0 || ::lseek(descriptor_, end, SEEK_SET) != end) {
    const int error = errno;
    ::close(descriptor_);
    fail("continue", path, error);
  }
  hash_front(path, size_, hash_);
}

AppendedFile::~AppendedFile() { ::close(descriptor_); }

void AppendedFile::append(std::string_view record) {
  struct stat status {};
  if (::fstat(descriptor_, &status) != 0) fail("write", path_, errno);
  if (status.st_nlink == 0) fail("write", path_, ENOENT);  // deleted meanwhile
  if (const auto size = static_cast<std::uint64_t>(status.st_size); size != size_)
    throw Failure(exit_input_output,
                  fmt::format("{} has been changed by somebody else while the run writes it: it has {} "
                              "bytes, and had {}",
                              path_.string(), size, size_));
  if (const int error = write_all(descriptor_, record); error != 0) {
    // Back to the last whole record; that this works too is not worth a second message.
    if (::ftruncate(descriptor_, static_cast<off_t>(size_)) != 0) ::lseek(descriptor_, 0, SEEK_END);
    fail("write", path_, error);
  }
  size_ += record.size();
  hash_.add(record);
}

FilePosition AppendedFile::position() const { return {size_, hash_.value()}; }

void AppendedFile::flush() {
  if (disk::fsync(descriptor_) != 0) fail("flush", path_, errno);
}

void flush_file(const std::filesystem::path& path) { flush(path, 0); }
void flush_folder(const std::filesystem::path& path) { flush(path, O_DIRECTORY); }

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) fail("make the folder", folder, error.value());
}

}  // namespace fixdem::program
