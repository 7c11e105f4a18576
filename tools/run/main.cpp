// The one translation unit that is compiled for every case: the kernel for that case, in static storage (home.hpp).
//
// Compiled with -DFIXDEM_CASE=plug_u24 -DFIXDEM_CASE_HEADER='"cases/plug_u24.hpp"' and linked with the library made of
// the other files of this folder. Keep its includes few: it is what a user waits for after changing a case.
#include FIXDEM_CASE_HEADER

#include "case_adapter.hpp"
#include "case_facts.hpp"
#include "driver.hpp"
#include "home.hpp"
#include "kernel/fixdem.hpp"

namespace {
#ifdef FIXDEM_PRECISION  // the same case in another precision, for comparison
struct Case : fixdem::cases::FIXDEM_CASE {
  static constexpr auto precision = fixdem::Precision::FIXDEM_PRECISION;
};
#else
using Case = fixdem::cases::FIXDEM_CASE;
#endif
fixdem::program::Home<fixdem::Simulation<Case>> home;  // about a megabyte: never on the stack
}  // namespace

int main(int argc, char** argv) {
  static fixdem::program::CaseAdapter<Case> view(home.simulation());
  return fixdem::program::run_program(view, fixdem::program::case_facts<Case>(), argc, argv);
}
