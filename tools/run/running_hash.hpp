// XXH64 of bytes that come piece by piece.
#pragma once

#include <xxhash.h>

#include <cstdint>
#include <memory>
#include <string_view>

namespace fixdem::program {

class RunningHash {
 public:
  RunningHash() { XXH64_reset(state_.get(), 0); }
  void add(const void* bytes, std::size_t size) { XXH64_update(state_.get(), bytes, size); }
  void add(std::string_view bytes) { add(bytes.data(), bytes.size()); }
  std::uint64_t value() const { return XXH64_digest(state_.get()); }

 private:
  struct Free {
    void operator()(XXH64_state_t* state) const { XXH64_freeState(state); }
  };
  std::unique_ptr<XXH64_state_t, Free> state_{XXH64_createState()};
};

}  // namespace fixdem::program
