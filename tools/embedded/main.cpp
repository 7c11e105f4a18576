// Runs one case from its start state and prints a hash of the state every tenth of the way: the same program with an
// operating system and on a bare board, to be compared line by line.
//
// Compiled with -DFIXDEM_CASE, -DFIXDEM_CASE_HEADER and -DFIXDEM_START_HEADER (start_state.cpp writes that one).
// Argument: number of steps; without one, the case's duration. Lines that begin with # are not to be compared.
// Exit code: 0 done, 1 the run stopped with a fault, 2 wrong usage.
#include FIXDEM_CASE_HEADER
#include FIXDEM_START_HEADER

#include "console.hpp"
#include "state_hash.hpp"

namespace {

using Case = fixdem::cases::FIXDEM_CASE;
using fixdem::console::put;
fixdem::Simulation<Case> simulation;

constexpr long long whole_run = static_cast<long long>(Case::duration / Case::time_step + 0.5);

/// -1 when it is no number of steps.
long long number(const char* text) {
  long long value = 0;
  for (; *text >= '0' && *text <= '9' && value < whole_run * 1000; ++text) value = 10 * value + (*text - '0');
  return *text == '\0' ? value : -1;
}

bool begin() {
  for (int id = 0; id < simulation.start_count; ++id) simulation.place(id, fixdem::embedded::start[id]);
  if (!simulation.start().ok()) return false;
  for (int k = 0; k < fixdem::embedded::history_count; ++k) {
    const auto& h = fixdem::embedded::histories[k];
    simulation.restore_history(h.owner, h.partner, h.value, h.rolling);
  }
  return true;
}

bool run_to(long long step) {
  const bool ok = simulation.run(step - simulation.step()).ok();
  put("step ");
  put(static_cast<unsigned long long>(simulation.step()));
  put(" state ");
  fixdem::console::put_hash(fixdem::state_hash(simulation));
  put("\n");
  if (!ok) put("stopped: "), put(fixdem::describe(simulation.status().fault)), put("\n");
  return ok;
}

}  // namespace

int main(int argc, char** argv) {
  const long long steps = argc > 1 ? number(argv[1]) : whole_run;
  if (steps < 0) {
    put("usage: the number of steps, a whole number\n");
    return 2;
  }
  put(Case::name), put(": ");
  put(static_cast<unsigned long long>(simulation.start_count)), put(" particles, ");
  put(static_cast<unsigned long long>(steps)), put(" of "), put(static_cast<unsigned long long>(whole_run)),
      put(" steps\n");
  if (!begin()) {
    put("cannot start\n");
    return 1;
  }
  put("# simulation: "), put(sizeof simulation), put(" bytes, ");
  put(sizeof simulation / Case::particle_count), put(" per particle\n");
  for (int tenth = 1; tenth <= 10; ++tenth)
    if (!run_to(steps * tenth / 10)) return 1;
  return 0;
}
