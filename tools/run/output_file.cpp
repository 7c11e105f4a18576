#include "output_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>
#include <system_error>
#include <vector>

#include "failure.hpp"

namespace fixdem::program {
namespace {

[[noreturn]] void fail(const char* what, const std::filesystem::path& path, int error) {
  throw Failure(exit_input_output, fmt::format("cannot {} {}: {}", what, path.string(), std::strerror(error)));
}

/// Writes all bytes; returns 0 or the error number.
int write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return written < 0 ? errno : ENOSPC;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

/// Makes a rename itself survive a power cut.
void flush_folder(const std::filesystem::path& folder) {
  const int descriptor = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

/// frame_000123.vtp, as FrameWriter names them
bool is_frame(const std::string& name) {
  constexpr std::string_view begin = "frame_", end = ".vtp";
  if (name.size() < begin.size() + 6 + end.size() || !name.starts_with(begin) || !name.ends_with(end)) return false;
  return name.find_first_not_of("0123456789", begin.size()) == name.size() - end.size();
}

}  // namespace

void write_file(const std::filesystem::path& path, std::string_view bytes, Durability durability) {
  std::filesystem::path temporary = path;
  temporary += ".part";
  const int descriptor = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor < 0) fail("write", temporary, errno);
  int error = write_all(descriptor, bytes);
  if (error == 0 && durability == Durability::durable && ::fsync(descriptor) != 0) error = errno;
  if (::close(descriptor) != 0 && error == 0) error = errno;
  if (error == 0 && ::rename(temporary.c_str(), path.c_str()) != 0) error = errno;
  if (error != 0) {
    ::unlink(temporary.c_str());
    fail("write", path, error);
  }
  if (durability == Durability::durable) flush_folder(path.parent_path());
}

AppendedFile::AppendedFile(const std::filesystem::path& path)
    : path_(path), descriptor_(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)) {
  if (descriptor_ < 0) fail("write", path, errno);
}

AppendedFile::~AppendedFile() { ::close(descriptor_); }

void AppendedFile::append(std::string_view record) {
  if (const int error = write_all(descriptor_, record); error != 0) {
    // Back to the last whole record; that this works too is not worth a second message.
    if (::ftruncate(descriptor_, size_) != 0) ::lseek(descriptor_, 0, SEEK_END);
    fail("write", path_, error);
  }
  size_ += static_cast<long long>(record.size());
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) fail("make the folder", folder, error.value());
}

void prepare_folder(const std::filesystem::path& out) {
  make_folder(out);
  std::error_code error;
  std::vector<std::filesystem::path> stale;
  for (const char* name : {"final.fixdem", "summary.json", "frames.pvd", "log.csv", "dump.lammpstrj"})
    stale.push_back(out / name);
  const std::filesystem::path frames = out / "frames";
  if (std::filesystem::exists(frames, error)) {
    for (const auto& entry : std::filesystem::directory_iterator(frames, error))
      if (is_frame(entry.path().filename().string())) stale.push_back(entry.path());
    if (error) fail("read the folder", frames, error.value());
  }
  for (const auto& path : stale) {
    std::filesystem::remove(path, error);
    if (error) fail("replace", path, error.value());
  }
  std::filesystem::remove(frames, error);  // if nothing else is in it; a run that writes frames makes it again
}

}  // namespace fixdem::program
