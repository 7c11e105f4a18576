// Temporary file and rename; the temporary carries the process number, so that two runs at once do not collide.
#include "output_file.hpp"

#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

namespace fixdem::casegen {
namespace {

namespace fs = std::filesystem;

bool has_content(const std::string& path, const std::string& content) {
  std::ifstream stream(path, std::ios::binary);
  return stream && std::string(std::istreambuf_iterator<char>(stream), {}) == content;
}

}  // namespace

bool write_if_changed(const std::string& path, const std::string& content) {
  if (has_content(path, content)) return false;
  const fs::path folder = fs::path(path).parent_path();
  if (!folder.empty()) fs::create_directories(folder);
  const std::string temporary = path + "." + std::to_string(getpid()) + ".tmp";
  errno = 0;
  std::ofstream stream(temporary, std::ios::binary);
  stream << content << std::flush;
  stream.close();
  std::error_code status;
  if (!stream) {
    const int reason = errno != 0 ? errno : EIO;
    fs::remove(temporary, status);
    throw std::system_error(reason, std::generic_category(), path);
  }
  fs::rename(temporary, path, status);
  if (status) {
    std::error_code ignored;
    fs::remove(temporary, ignored);
    throw std::system_error(status, path);
  }
  return true;
}

}  // namespace fixdem::casegen
