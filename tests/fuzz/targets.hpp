// What hostile bytes are thrown at: the readers of cases, state files and checkpoints, and the kernel itself.
//
// Each target takes any bytes and returns what is wrong, or nothing. Memory errors and undefined behaviour are for the
// sanitizers that `make fuzz` compiles it with. The same functions replay tests/corpus/ in `make test`
// (corpus_test.cpp).
#pragma once

#include <string>
#include <string_view>

namespace fixdem::tests {

/// A case file: it is refused with a place and a message, or it gives a header, the same one each time.
std::string fuzz_case(std::string_view bytes);

/// A state file: it is refused with exit code 3, or it reads as something that is written as a file which reads the
/// same. The checksum is put right first when the first byte of the input is odd, so that what lies behind it is
/// reached.
std::string fuzz_state(std::string_view bytes);

/// The same for a checkpoint.
std::string fuzz_checkpoint(std::string_view bytes);

/// Particles in any state, degenerate ones included: all lanes, one lane and the reference program step by step.
std::string fuzz_particles(std::string_view bytes);

}  // namespace fixdem::tests
