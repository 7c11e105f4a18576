#include "folder_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <sstream>
#include <string>
#include <string_view>

#include "disk.hpp"
#include "failure.hpp"

namespace fixdem::program {
namespace {

struct Owner {
  long process = 0;
  std::string host;
};

std::string this_host() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 && name[0] != '\0' ? std::string(name.data()) : "unknown";
}

/// Nobody when the file is empty or cut short: its owner was killed while writing it.
Owner read_owner(int descriptor, const std::filesystem::path& path) {
  std::array<char, 512> text{};
  if (::pread(descriptor, text.data(), text.size() - 1, 0) <= 0) return {};
  constexpr std::string_view beginning = "process ";
  const std::string_view found = text.data();
  if (found.substr(0, beginning.size()) != beginning.substr(0, found.size())) {
    ::close(descriptor);
    throw Failure(exit_input_output, fmt::format("{} is no lock of fixdem: it holds something else\n  move it away, or "
                                                 "choose another --out",
                                                 path.string()));
  }
  std::istringstream words(text.data());
  Owner owner;
  std::string word;
  if (!(words >> word >> owner.process >> word >> word >> owner.host)) return {};
  return owner;
}

/// Whether the file at the path is still the one that is open: its last owner removes it.
bool is_same_file(int descriptor, const std::filesystem::path& path) {
  struct stat open {
  }, there{};
  return ::fstat(descriptor, &open) == 0 && ::stat(path.c_str(), &there) == 0 && open.st_ino == there.st_ino &&
         open.st_dev == there.st_dev;
}

[[noreturn]] void refuse(const std::filesystem::path& path, const Owner& owner) {
  const std::string who =
      owner.process != 0 ? fmt::format("process {} on {}", owner.process, owner.host) : "another run";
  throw Failure(exit_input_output,
                fmt::format("the folder {} is in use by {}\n  wait for it, choose another --out, or, if it no longer "
                            "runs, remove {}",
                            path.parent_path().string(), who, path.string()));
}

}  // namespace

FolderLock::FolderLock(const std::filesystem::path& folder) : path_(folder / "lock") {
  const auto fail = [this](int error) {
    if (descriptor_ >= 0) ::close(descriptor_);
    throw Failure(exit_input_output, fmt::format("cannot lock {}: {}", path_.string(), std::strerror(error)));
  };
  do {
    if (descriptor_ >= 0) ::close(descriptor_);
    descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (descriptor_ < 0 && errno == ELOOP)
      throw Failure(exit_input_output,
                    fmt::format("cannot lock {}: it is a symbolic link, and what it points to would be overwritten\n"
                                "  remove it, or choose another --out",
                                path_.string()));
    if (descriptor_ < 0) fail(errno);
    const bool is_locked = ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0;
    const int error = errno;
    const Owner owner = read_owner(descriptor_, path_);
    const bool is_elsewhere = owner.process != 0 && owner.host != this_host();
    const bool has_no_locks = !is_locked && error != EWOULDBLOCK;
    const bool lives =
        has_no_locks && owner.process > 0 && (::kill(static_cast<pid_t>(owner.process), 0) == 0 || errno == EPERM);
    if ((!is_locked && !has_no_locks) || is_elsewhere || lives) {
      ::close(descriptor_);
      refuse(path_, owner);
    }
  } while (!is_same_file(descriptor_, path_));

  const std::string text = fmt::format("process {} on host {}\n", ::getpid(), this_host());
  if (::ftruncate(descriptor_, 0) != 0) fail(errno);
  if (disk::write(descriptor_, text.data(), text.size()) < 0) fail(errno);
}

FolderLock::~FolderLock() {
  ::unlink(path_.c_str());  // while it is held, so that nobody else's is removed
  ::close(descriptor_);
}

}  // namespace fixdem::program
