#include "watch.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace fixdem::program {
namespace {

constexpr auto pause = std::chrono::milliseconds(100);
constexpr int narrowest = 40, widest = 160;
constexpr double piece = 20;  // of a line, in pipe diameters
constexpr int most_pieces = 4;
constexpr double moving = 0.1;  // m/s

bool is_set(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr && *value != '\0';
}

}  // namespace

std::optional<Watch> Watch::on_terminal(const CaseFacts& facts, double duration) {
  const char* terminal = std::getenv("TERM");
  if (isatty(STDOUT_FILENO) == 0 || terminal == nullptr || std::strcmp(terminal, "dumb") == 0) return std::nullopt;
  winsize size{};
  const bool known = ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return Watch(facts, duration, std::clamp(known ? size.ws_col - 2 : 78, narrowest, widest), !is_set("NO_COLOR"));
}

Watch::Watch(const CaseFacts& facts, double duration, int columns, bool colour)
    : facts_(facts), duration_(duration), colour_(colour) {
  const double wanted = facts.pipe_length / (piece * facts.pipe_diameter);
  const int pieces = facts.line.is_open ? std::clamp(static_cast<int>(std::ceil(wanted)), 1, most_pieces) : 1;
  for (int k = 0; k < pieces; ++k)
    views_.emplace_back(facts, columns, k * facts.pipe_length / pieces, facts.pipe_length / pieces);
}

bool Watch::is_due() const { return lines_on_screen_ == 0 || std::chrono::steady_clock::now() - last_ >= pause; }

std::string Watch::picture(const Snapshot& snapshot, const LogRow& row) {
  const std::string rule(static_cast<std::size_t>(views_.front().columns()), '-');
  std::string text =
      fmt::format("{}   {:.4f} s of {:g} s   step {}\n+{}+\n", facts_.name, row.time, duration_, row.step, rule);
  for (SideView& view : views_) {
    view.draw(snapshot);
    for (int r = 0; r < view.rows(); ++r) {
      text += '|';
      bool coloured = false;
      for (int c = 0; c < view.columns(); ++c) {
        const bool moves = colour_ && std::fabs(view.axial_velocity(r, c)) > moving;
        if (moves != coloured) text += moves ? "\033[36m" : "\033[0m";
        coloured = moves;
        text += view.letter(r, c);
      }
      text += coloured ? "\033[0m|\n" : "|\n";
    }
    text += fmt::format("+{}+\n", rule);
  }
  const Observation& o = row.observation;
  text += fmt::format("kinetic energy {:.3e} J   contacts {:.2f} a particle   fastest {:.3f} m/s\n",
                      o.kinetic_translation + o.kinetic_rotation, o.coordination_number, o.max_speed);
  text += fmt::format("deepest overlap {:.1e} radii   mean axial velocity {:+.3f} m/s\n",
                      o.max_overlap / facts_.smallest_radius(), o.mean_axial_velocity);
  if (facts_.line.is_open) {
    const LineTotals& t = row.line.totals;
    text += fmt::format("{} particles present, {} fed, {} left, {:.3g} kg wait\n", t.present, t.fed, t.left, t.backlog);
  }
  if (facts_.has_gas) {
    text += fmt::format("pressure drop {:.0f} Pa   ", row.plug.pressure_drop);
    text += row.plug.found ? fmt::format("plug: front at {:.3f} m, {:.3f} m long\n", row.plug.front, row.plug.length)
                           : std::string("no plug\n");
  }
  return text;
}

void Watch::show(const Snapshot& snapshot, const LogRow& row) {
  const std::string text = picture(snapshot, row);
  std::string out = lines_on_screen_ > 0 ? fmt::format("\033[{}A", lines_on_screen_) : std::string();
  lines_on_screen_ = 0;
  for (std::size_t begin = 0, end; begin < text.size(); begin = end + 1) {
    end = text.find('\n', begin);
    out += "\033[K" + text.substr(begin, end - begin) + "\n";
    ++lines_on_screen_;
  }
  std::fputs(out.c_str(), stdout);
  std::fflush(stdout);
  last_ = std::chrono::steady_clock::now();
}

}  // namespace fixdem::program
