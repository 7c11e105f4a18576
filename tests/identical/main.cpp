// Runs the scenes of scenes.hpp and prints one line for each: its name, and a hash of every particle's position,
// velocity and angular velocity and of the energy ledger after the last step.
//
// Without arguments. Exit code: 0, or 1 when a scene stopped with a fault. `make identical` compiles this program for
// several instruction sets, and for a board without operating system; each must print tests/golden/scenes.txt.
#include <cstddef>
#include <new>

#include "kernel/fixdem.hpp"
#include "scenes.hpp"
#include "tools/embedded/console.hpp"
#include "tools/embedded/state_hash.hpp"

namespace {

using namespace fixdem::tests::identical;
using fixdem::console::put;

constexpr std::size_t largest = [] {
  std::size_t size = 0;
  for_each_scene([&]<class Case>(const char*) {
    size = sizeof(fixdem::Simulation<Case>) > size ? sizeof(fixdem::Simulation<Case>) : size;
  });
  return size;
}();
/// One scene at a time: the board has 4 MB, and all of them take 6.
alignas(64) unsigned char memory[largest];

template <class Case>
bool run(const char* name) {
  auto& simulation = *new (memory) fixdem::Simulation<Case>();  // all zero, as in static storage
  put(name);
  place_agitated(simulation);
  if (!simulation.start().ok() || !simulation.run(steps).ok()) {
    put(" stopped with a fault\n");
    return false;
  }
  put(" ");
  fixdem::console::put_hash(fixdem::state_hash(simulation));
  put("\n");
  return true;
}

}  // namespace

int main(int, char**) {
  bool ok = true;
  for_each_scene([&]<class Case>(const char* name) { ok = run<Case>(name) && ok; });
  return ok ? 0 : 1;
}
