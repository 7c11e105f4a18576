// Any bytes as a state file or a checkpoint.
#include "targets.hpp"
#include "tests/with_checksum.hpp"
#include "tools/run/checkpoint.hpp"
#include "tools/run/failure.hpp"
#include "tools/run/state_file.hpp"

namespace fixdem::tests {
namespace {

/// Without its first byte, which says whether the checksum is to be put right.
std::string file_of(std::string_view bytes) {
  const std::string file(bytes.substr(1));
  return bytes[0] % 2 != 0 ? with_checksum(file) : file;
}

/// `read_again` reads what it is given and returns it as it would be written.
template <class ReadAgain>
std::string check(std::string_view bytes, ReadAgain read_again) {
  if (bytes.empty()) return "";
  const std::string file = file_of(bytes);
  try {
    const std::string written = read_again(file);
    if (read_again(written) != written) return "it does not read as it was written";
    if (written.size() != file.size()) return "it is written in another size than it was read";
    return "";
  } catch (const program::Failure& failure) {
    return failure.code() == program::exit_bad_input ? ""
                                                     : std::string("refused with another exit code: ") + failure.what();
  }
}

}  // namespace

std::string fuzz_state(std::string_view bytes) {
  return check(bytes,
               [](std::string_view file) { return program::encode_state(program::decode_state(file, "fuzz.fixdem")); });
}

std::string fuzz_checkpoint(std::string_view bytes) {
  return check(bytes, [](std::string_view file) {
    program::Checkpoint checkpoint = program::decode_checkpoint(file, "fuzz.fixdem");
    return program::encode_checkpoint(checkpoint);
  });
}

}  // namespace fixdem::tests
