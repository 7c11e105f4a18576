// A simulation between two fields of known bytes, to see that nothing is written outside it.
#pragma once

#include "kernel/fixdem.hpp"

namespace fixdem::tests {

template <class Case>
struct Guarded {
  static constexpr int guard_size = 8192;
  alignas(64) unsigned char before[guard_size];
  Simulation<Case> simulation;
  alignas(64) unsigned char after[guard_size];

  void arm() {
    for (int k = 0; k < guard_size; ++k) before[k] = after[k] = static_cast<unsigned char>(37 * k + 11);
  }
  bool intact() const {
    for (int k = 0; k < guard_size; ++k) {
      const auto expected = static_cast<unsigned char>(37 * k + 11);
      if (before[k] != expected || after[k] != expected) return false;
    }
    return true;
  }
};

template <class Case>
Guarded<Case>& guarded() {
  static Guarded<Case> object;
  object.arm();
  return object;
}

}  // namespace fixdem::tests
