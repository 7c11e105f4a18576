// libFuzzer's entry for one target, named by -DFIXDEM_FUZZ_TARGET=fuzz_case: what the target complains about is
// printed, and the input is kept by libFuzzer because the program aborts.
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "targets.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string complaint =
      fixdem::tests::FIXDEM_FUZZ_TARGET(std::string_view(reinterpret_cast<const char*>(data), size));
  if (complaint.empty()) return 0;
  std::fprintf(stderr, "%s\n", complaint.c_str());
  std::abort();
}
