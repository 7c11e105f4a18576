// Runs the scenes of scenes.hpp and prints one line for each: its name, and a hash of every particle's position,
// velocity and angular velocity and of the energy ledger after the last step.
//
// Without arguments. Exit code: 0, or 1 when a scene stopped with a fault. `make identical` compiles this program for
// several instruction sets and compares what they print.
#include <cstdint>
#include <cstdio>
#include <cstring>

#include "kernel/fixdem.hpp"
#include "scenes.hpp"

namespace {

using namespace fixdem::tests::identical;

/// FNV-1a, 64 bits, over the bytes of everything added.
class Hash {
 public:
  template <class T>
  void add(const T& value) {
    unsigned char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    for (const unsigned char byte : bytes) value_ = (value_ ^ byte) * 0x100000001b3u;
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

template <class Case>
bool run(const char* name) {
  static fixdem::Simulation<Case> simulation;
  place_agitated(simulation);
  if (!simulation.start().ok() || !simulation.run(steps).ok()) {
    std::printf("%s stopped with a fault\n", name);
    return false;
  }
  Hash hash;
  for (int id = 0; id < Case::particle_count; ++id) hash.add(simulation.particle(id));
  hash.add(simulation.energy());
  std::printf("%s %016llx\n", name, static_cast<unsigned long long>(hash.value()));
  return true;
}

}  // namespace

int main() {
  bool ok = run<gas>("gas");
  ok = run<smooth>("smooth") && ok;
  ok = run<leapfrog>("leapfrog") && ok;
  ok = run<paper>("paper") && ok;
  ok = run<linear>("linear") && ok;
  ok = run<impulse>("impulse") && ok;
  ok = run<mixed_gas>("mixed gas") && ok;
  ok = run<mixed_smooth>("mixed smooth") && ok;
  ok = run<mixed_leapfrog>("mixed leapfrog") && ok;
  ok = run<mixed_paper>("mixed paper") && ok;
  return ok ? 0 : 1;
}
