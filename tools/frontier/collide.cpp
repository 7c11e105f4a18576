// All impacts of impacts.hpp by the kernel, at every time step the program was compiled for (setting.hpp).
//
// One simulation holds all of them, far apart from each other. Output, a line for each time step and impact:
//   collide,factor,number,normal,tangential,surface_spin,contact_time,maximum_overlap,axial_phase
// in m/s, s and m, as exact.cpp prints them. Before and after a contact the motion is uniform, so the moments of first
// and last touch follow from the first and the last state. Maximum overlap: top of the parabola through the deepest
// step and its neighbours. A run that the kernel stops gives `stopped,factor,fault` and no more of this time step.
#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <vector>

#include "impacts.hpp"
#include "kernel/fixdem.hpp"
#include "setting.hpp"

namespace {

using namespace fixdem;

constexpr int particles = frontier::impacts + frontier::repeats;  // pairs come first: numbers 2k and 2k + 1

/// A wide closed box without pipe, so that all lie in one chunk.
template <class Setting>
struct Box : Setting {
  static constexpr int particle_count = particles;
  static constexpr bool has_wall = false, has_gas = false, energy_ledger = false;
  static constexpr Ends ends = Ends::closed;
  static constexpr double pipe_diameter = 100 * Setting::diameter, pipe_length = 100 * Setting::diameter;
  static constexpr double gravity[3] = {0, 0, 0};
  static constexpr int slice_count = 1, tile_steps = 1;
};

int first_particle(int number) { return number < frontier::repeats ? 2 * number : number + frontier::repeats; }

/// Overlap at each of the last three steps, and the maximum found.
struct Peak {
  std::array<double, 3> last{};
  double maximum = 0;
  void add(double overlap) {
    last = {last[1], last[2], overlap};
    const auto& [a, b, c] = last;
    if (b <= 0 || b < a || b < c) return;
    const double bend = a - 2 * b + c;
    const double top = bend < 0 && a > 0 && c > 0 ? b - (c - a) * (c - a) / (8 * bend) : b;
    if (top > maximum) maximum = top;
  }
};

template <class Case>
class Collisions {
  static constexpr double r = Case::diameter / 2;

 public:
  void print() {
    for (int n = 0; n < frontier::impacts; ++n) place(n);
    Status status = simulation_.start();
    const long long limit = 40 + static_cast<long long>(20 * longest_contact() / Case::time_step);
    int open = frontier::impacts;
    for (long long step = 0; status.ok() && open > 0 && step < limit; ++step) {
      status = simulation_.run(1);
      open = 0;
      for (int n = 0; n < frontier::impacts; ++n) {
        const double gap = separation(n), speed = parting_speed(n);
        peaks_[static_cast<std::size_t>(n)].add(-gap);
        if (!(gap > 0 && speed > 0)) ++open;
      }
    }
    if (!status.ok() || open > 0) {
      fmt::print("stopped,{},{}\n", Case::factor, status.ok() ? "contacts do not end" : describe(status.fault));
      return;
    }
    for (int n = 0; n < frontier::impacts; ++n) {
      const auto impact = frontier::impact(n);
      const Particle p = simulation_.particle(first_particle(n));
      const double begin = gap_at_start(n) / impact.normal;
      const double end = simulation_.time() - separation(n) / parting_speed(n);
      fmt::print("collide,{},{},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}\n", Case::factor, n, parting_speed(n),
                 p.velocity[0], -r * p.angular_velocity[1], end - begin, peaks_[static_cast<std::size_t>(n)].maximum);
    }
  }

 private:
  /// Hertz' contact time at a tenth of 1 m/s, a generous bound.
  static double longest_contact() {
    const double K = Derived<Case>::stiffness_pair, m = Derived<Case>::mass / 2;
    const double overlap = Derived<Case>::is_hertz ? std::pow(5 * m / (4 * K), 0.4) : std::sqrt(m / K);
    return 5 * overlap;
  }
  static double gap_at_start(int n) {
    const auto impact = frontier::impact(n);
    return impact.normal * Case::time_step * (1 + impact.phase);
  }
  void place(int n) {
    const auto impact = frontier::impact(n);
    const double gap = gap_at_start(n), x = (n - frontier::impacts / 2) * 4 * Case::diameter;
    const int first = first_particle(n);
    if (impact.is_pair) {
      const double middle = Case::pipe_length / 2, half = r + gap / 2;
      simulation_.place(first, {{x, 0, middle - half}, {0, 0, impact.normal / 2}, {}});
      simulation_.place(first + 1, {{x, 0, middle + half}, {0, 0, -impact.normal / 2}, {}});
    } else {
      simulation_.place(first, {{x, 0, r + gap}, {impact.tangential, 0, -impact.normal}, {}});
    }
  }
  double separation(int n) const {
    const int first = first_particle(n);
    const double z = simulation_.particle(first).position[2];
    return n < frontier::repeats ? simulation_.particle(first + 1).position[2] - z - 2 * r : z - r;
  }
  double parting_speed(int n) const {
    const int first = first_particle(n);
    const double v = simulation_.particle(first).velocity[2];
    return n < frontier::repeats ? simulation_.particle(first + 1).velocity[2] - v : v;
  }

  Simulation<Case> simulation_;
  std::array<Peak, frontier::impacts> peaks_{};
};

}  // namespace

int main() {
  frontier::for_each_setting([]<class Setting>() {
    static Collisions<Box<Setting>> collisions;
    collisions.print();
  });
}
