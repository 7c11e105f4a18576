// Any bytes as a state file.
#include <xxhash.h>

#include <cstring>

#include "targets.hpp"
#include "tools/run/failure.hpp"
#include "tools/run/state_file.hpp"

namespace fixdem::tests {

std::string fuzz_state(std::string_view bytes) {
  if (bytes.empty()) return "";
  const bool put_right = bytes[0] % 2 != 0;
  std::string file(bytes.substr(1));
  constexpr std::size_t sum_size = sizeof(XXH64_hash_t);
  if (put_right && file.size() >= sum_size) {
    const XXH64_hash_t sum = XXH64(file.data(), file.size() - sum_size, 0);
    std::memcpy(file.data() + file.size() - sum_size, &sum, sum_size);
  }
  try {
    const std::string again = program::encode_state(program::decode_state(file, "fuzz.fixdem"));
    if (program::encode_state(program::decode_state(again, "written.fixdem")) != again)
      return "it does not read as it was written";
    if (again.size() != file.size()) return "it is written in another size than it was read";
    return "";
  } catch (const program::Failure& failure) {
    return failure.code() == program::exit_bad_input ? ""
                                                     : std::string("refused with another exit code: ") + failure.what();
  }
}

}  // namespace fixdem::tests
