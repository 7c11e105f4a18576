#include "binary_file.hpp"

#include <xxhash.h>

#include <cerrno>
#include <fstream>
#include <iterator>

namespace fixdem::program {
namespace {
constexpr std::uint32_t byte_order_mark = 0x01020304, swapped_mark = 0x04030201;
}  // namespace

void BinaryWriter::begin(std::string_view magic, std::uint32_t version) {
  bytes(magic.data(), magic.size());
  put(byte_order_mark);
  put(version);
}

void BinaryWriter::seal() { put(std::uint64_t{XXH64(text_.data(), text_.size(), 0)}); }

std::uint32_t BinaryReader::begin(std::string_view magic, const char* what, std::uint32_t oldest,
                                  std::uint32_t newest) {
  if (rest_.substr(0, magic.size()) != magic) refuse("is no {} of fixdem (wrong first bytes)", what);
  take(magic.size());
  const auto mark = get<std::uint32_t>();
  if (mark == swapped_mark) refuse("was written on a machine of the other byte order");
  if (mark != byte_order_mark) refuse("is damaged: byte order mark {:08x} instead of {:08x}", mark, byte_order_mark);
  const auto found = get<std::uint32_t>();
  if (found < oldest || found > newest)
    refuse("has version {}, this program reads version{}", found,
           oldest == newest ? fmt::format(" {}", newest) : fmt::format("s {} to {}", oldest, newest));
  return found;
}

void BinaryReader::check_seal(std::string_view file) {
  constexpr std::size_t size = sizeof(std::uint64_t);
  if (rest_.size() < size) refuse("is cut short: {} bytes in all", file.size());
  std::uint64_t stored;
  std::memcpy(&stored, file.data() + file.size() - size, size);
  const std::uint64_t sum = XXH64(file.data(), file.size() - size, 0);
  if (sum != stored) refuse("is damaged or cut short: checksum {:016x}, the file says {:016x}", sum, stored);
  rest_.remove_suffix(size);
}

std::string read_file(const std::filesystem::path& path, const char* what) {
  const auto refuse = [&](const char* why) {
    throw Failure(exit_input_output, fmt::format("cannot read the {} {}: {}", what, path.string(), why));
  };
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) refuse(std::strerror(EISDIR));  // reading one would throw
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  const auto size = std::filesystem::file_size(path, error);
  std::string bytes(file && !error ? size : 0, '\0');  // at once: a line has 700 MB
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  if (!file.is_open() || file.bad()) refuse(errno != 0 ? std::strerror(errno) : "not a readable file");
  return bytes;
}

}  // namespace fixdem::program
