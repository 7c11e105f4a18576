// Random numbers that are the same on every machine and with every compiler.
//
// std::mt19937_64 is defined bit by bit by the standard; its distributions are not, so the conversion to a double is
// our own: the upper 53 bits, scaled by a power of two, which is exact.
#pragma once

#include <random>

namespace fixdem::program {

class RandomNumbers {
 public:
  explicit RandomNumbers(unsigned long long seed) : engine_(seed) {}

  /// Uniform in [0, 1).
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  /// Uniform in [low, high).
  double between(double low, double high) { return low + (high - low) * unit(); }

 private:
  std::mt19937_64 engine_;
};

}  // namespace fixdem::program
