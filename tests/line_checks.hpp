// What must hold of an open line at any moment, and its energy.
#pragma once

#include <cstring>
#include <set>

#include "kernel/fixdem.hpp"
#include "line_scenes.hpp"

namespace fixdem::tests {

template <class Case>
void start_line(Simulation<Case>& line, double speed = 0.5, double drift = 1) {
  enter({Case::name, seed()});
  place_all(line, spheres_of_line<Case>(speed, drift, Random(seed())));
  start(line);
}

template <class Case>
void run_until(Simulation<Case>& line, double time) {
  run(line, std::lround(time / Case::time_step) - line.step());
}

/// Watches who comes and goes, in every step.
template <class Case>
class Attendance {
 public:
  explicit Attendance(const Simulation<Case>& line) : line_(line) {}

  /// Whether whole numbers balance, and serial numbers count up and are never used again.
  bool is_right() {
    const LineTotals t = line_.line();
    std::set<long long> now;
    int numbers = 0;
    for (int id = 0; id < Case::particle_count; ++id) {
      if (!line_.is_present(id)) continue;
      ++numbers;
      now.insert(line_.serial(id));
    }
    bool is_right = static_cast<int>(now.size()) == numbers && numbers == t.present && line_.present() == t.present &&
                    t.at_start == Case::start_count && t.at_start + t.fed == t.present + t.left;
    for (const long long serial : here_) left_ += now.count(serial) == 0;
    for (const long long serial : now)
      if (here_.count(serial) == 0) is_right = serial == entered_++ && is_right;
    here_ = now;
    return is_right && entered_ == t.at_start + t.fed && left_ == t.left;
  }

 private:
  const Simulation<Case>& line_;
  std::set<long long> here_;
  long long entered_ = 0, left_ = 0;
};

/// What the ledger does not account for, J.
inline double imbalance(const Energy& start, const Energy& now) {
  const double dissipated = now.dissipated_damping + now.dissipated_sliding + now.dissipated_rolling;
  return now.kinetic + now.elastic + dissipated - (start.kinetic + start.elastic) -
         (now.gravity_work + now.gas_work + now.made_by_law + now.entered - now.left_with);
}

/// Whether two lines are the same to the last bit; they may be computed otherwise.
template <class One, class Other>
bool same_line(const One& a, const Other& b) {
  for (int id = 0; id < One::count; ++id) {
    if (a.is_present(id) != b.is_present(id)) return false;
    if (!a.is_present(id)) continue;
    const Particle p = a.particle(id), q = b.particle(id);
    if (a.serial(id) != b.serial(id) || a.kind(id) != b.kind(id) || std::memcmp(&p, &q, sizeof p) != 0) return false;
  }
  const Energy e = a.energy(), f = b.energy();
  const LineTotals s = a.line(), t = b.line();
  return std::memcmp(&e, &f, sizeof e) == 0 && std::memcmp(&s, &t, sizeof s) == 0;
}

}  // namespace fixdem::tests
