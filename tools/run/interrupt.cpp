#include "interrupt.hpp"

#include <csignal>
#include <initializer_list>

namespace fixdem::program {
namespace {
volatile std::sig_atomic_t received = 0;
extern "C" void remember(int signal) { received = signal; }
}  // namespace

void catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = remember;
  sigemptyset(&action.sa_mask);
  for (int signal : {SIGINT, SIGTERM, SIGXCPU}) {
    action.sa_flags = SA_RESTART | (signal == SIGXCPU ? 0 : static_cast<int>(SA_RESETHAND));
    struct sigaction inherited {};
    sigaction(signal, nullptr, &inherited);
    // A shell starts background jobs with SIGINT ignored; that is its decision to make.
    if (inherited.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
  }
  std::signal(SIGPIPE, SIG_IGN);
}

int interrupt_signal() { return received; }

}  // namespace fixdem::program
