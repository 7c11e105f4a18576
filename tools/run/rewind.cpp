#include "rewind.hpp"

#include <algorithm>
#include <chrono>

namespace fixdem::program {
namespace {
constexpr double least_interval = 0.02;  // s
constexpr double intervals_per_copy = 200;
constexpr std::size_t maximum_copy = std::size_t{1} << 30;  // bytes
}  // namespace

void Rewind::keep(double seconds) {
  if (seconds < next_) return;
  const std::span<char> memory = view_.memory();
  if (memory.size() > maximum_copy) return;
  const auto begin = std::chrono::steady_clock::now();
  copy_.assign(memory.data(), memory.size());
  step_ = view_.step();
  const double taken = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  next_ = seconds + std::max(least_interval, intervals_per_copy * taken);
}

bool Rewind::put_back() {
  const std::span<char> memory = view_.memory();
  if (copy_.empty() || copy_.size() != memory.size()) return false;
  std::copy(copy_.begin(), copy_.end(), memory.begin());
  return true;
}

bool Rewind::go_back(const Status& fault) {
  // A fault that is found before a step leaves the state good that many steps have led to; one within a step does not.
  for (const long long good : {fault.step, fault.step - 1}) {
    if (good < step_) continue;
    if (!put_back()) return false;
    if (view_.run(good - step_).ok()) return true;
  }
  return false;
}

}  // namespace fixdem::program
