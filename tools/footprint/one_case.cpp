// A case from its start state, to be measured. Usage: one_case size|time|STEPS (measured.hpp)
#include FIXDEM_CASE_HEADER
#include FIXDEM_START_HEADER

#include "measured.hpp"

namespace {
using Case = fixdem::cases::FIXDEM_CASE;
fixdem::Simulation<Case> simulation;

bool start() {
  for (int id = 0; id < simulation.start_count; ++id) simulation.place(id, fixdem::embedded::start[id]);
  return simulation.start().ok();
}
}  // namespace

int main(int argc, char** argv) { return argc == 2 ? fixdem::footprint::measured(simulation, start, argv[1]) : 2; }
