// A state file or checkpoint whose checksum is right again after a change, so that the change itself must be noticed.
#pragma once

#include <xxhash.h>

#include <cstring>
#include <string>

namespace fixdem::tests {

/// What is too short to have a checksum stays as it is.
inline std::string with_checksum(std::string file) {
  constexpr std::size_t size = sizeof(XXH64_hash_t);
  if (file.size() < size) return file;
  const XXH64_hash_t sum = XXH64(file.data(), file.size() - size, 0);
  std::memcpy(file.data() + file.size() - size, &sum, size);
  return file;
}

}  // namespace fixdem::tests
