#include "progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <utility>

namespace fixdem::program {
namespace {

std::string time_left(double seconds) {
  if (seconds < 60) return fmt::format("{:.0f} s", seconds);
  if (seconds < 3600)
    return fmt::format("{:.0f} min {:02.0f} s", static_cast<int>(seconds / 60) * 1.0,
                       static_cast<double>(static_cast<int>(seconds) % 60));
  return fmt::format("{:.1f} h", seconds / 3600);
}

/// Whether stderr can be written is nobody's concern, so unlike fmt::print this never throws.
template <class... Values>
void say(fmt::format_string<Values...> format, Values&&... values) {
  std::fputs(fmt::format(format, std::forward<Values>(values)...).c_str(), stderr);
}

}  // namespace

Progress::Progress(const CaseFacts& facts, long long first_step, long long total_steps, bool quiet)
    : name_(facts.name),
      time_step_(facts.time_step),
      first_(first_step),
      total_(total_steps),
      begin_(std::chrono::steady_clock::now()) {
  if (quiet || total_ <= 0) return;
  const char* terminal = std::getenv("TERM");
  const bool clever = isatty(STDERR_FILENO) != 0 && terminal != nullptr && std::strcmp(terminal, "dumb") != 0;
  style_ = clever ? Style::bar : Style::plain;
  const char* no_color = std::getenv("NO_COLOR");
  colour_ = clever && (no_color == nullptr || *no_color == '\0');
}

void Progress::update(long long steps, double particle_steps, double kernel_seconds) {
  if (style_ == Style::none) return;
  const double part = static_cast<double>(steps) / static_cast<double>(total_);
  const int tenth = static_cast<int>(10 * part);
  if (style_ == Style::plain && tenth == last_tenth_) return;
  last_tenth_ = tenth;
  const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  const double rate = kernel_seconds > 0 ? 1e-6 * particle_steps / kernel_seconds : 0;
  const long long done = steps - first_;
  const std::string left =
      done > 0 ? time_left(elapsed * static_cast<double>(total_ - steps) / static_cast<double>(done)) : "?";
  const double time = static_cast<double>(steps) * time_step_;
  if (style_ == Style::plain) {
    say("{}: {:3.0f} %, {:.4g} s simulated, {} left, {:.4g} million particle-steps/s\n", name_, 100 * part, time, left,
        rate);
    return;
  }
  constexpr int width = 24;
  const int filled = std::clamp(static_cast<int>(width * part), 0, width);
  const std::string bar(static_cast<std::size_t>(filled), '='), rest(static_cast<std::size_t>(width - filled), ' ');
  say("\r\033[K{} [{}{}{}{}] {:3.0f} %  {} left  {:.4g} M particle-steps/s", name_, colour_ ? "\033[32m" : "", bar,
      colour_ ? "\033[0m" : "", rest, 100 * part, left, rate);
  std::fflush(stderr);
  on_screen_ = true;
}

void Progress::clear() {
  if (!on_screen_) return;
  std::fputs("\r\033[K", stderr);
  std::fflush(stderr);
  on_screen_ = false;
}

}  // namespace fixdem::program
