#include "interrupt.hpp"

#include <fcntl.h>
#include <time.h>
#include <unistd.h>

#include <csignal>
#include <initializer_list>

namespace fixdem::program {
namespace {

volatile std::sig_atomic_t received = 0, times = 0, first_at = 0;

constexpr int patient_signals = 2, patient_seconds = 5;

extern "C" void remember(int signal) {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  const auto seconds = static_cast<std::sig_atomic_t>(now.tv_sec);
  if (received == 0) {
    received = signal;
    first_at = seconds;
  }
  if (signal == SIGXCPU) return;
  times = times + 1;
  if (times <= patient_signals || seconds - first_at < patient_seconds) return;
  std::signal(signal, SIG_DFL);
  std::raise(signal);  // delivered when this handler returns
}

}  // namespace

void prepare_process() {
  int descriptor = 0;
  do descriptor = ::open("/dev/null", O_RDWR);
  while (descriptor >= 0 && descriptor <= 2);
  if (descriptor > 2) ::close(descriptor);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

void catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = remember;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  for (int signal : {SIGINT, SIGTERM, SIGHUP, SIGXCPU}) {
    struct sigaction inherited {};
    sigaction(signal, nullptr, &inherited);
    // A shell starts background jobs with SIGINT ignored, and nohup what it runs with SIGHUP; that is their decision.
    if (inherited.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
  }
}

int interrupt_signal() { return received; }

}  // namespace fixdem::program
