// Runs the scenes of scenes.hpp and prints one line for each: its name, and a hash of every particle's position,
// velocity and angular velocity and of the energy ledger after the last step.
//
// Without arguments. Exit code: 0, or 1 when a scene stopped with a fault. `make identical` compiles this program for
// several instruction sets, and for a board without operating system, and compares what they print.
#include "kernel/fixdem.hpp"
#include "scenes.hpp"
#include "tools/embedded/console.hpp"
#include "tools/embedded/state_hash.hpp"

namespace {

using namespace fixdem::tests::identical;
using fixdem::console::put;

template <class Case>
bool run(const char* name) {
  static fixdem::Simulation<Case> simulation;
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
