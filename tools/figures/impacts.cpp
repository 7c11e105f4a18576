// Single impacts on a flat wall by the kernel, for Figs. 3 and 4: the scene of collide_wall with other restitutions.
//
// Prints comma-separated lines: `impact,alpha,restitution asked for,restitution found` for each, and for each of its
// moments `path,alpha,overlap,velocity`, both scaled as in eq. (30): overlap by (5 m v0^2 / 4 K)^(2/5), the maximum
// one without damping, and velocity by that before the impact, positive into the wall. The time step is a tenth of the
// case's, so that the lines are smooth. alpha is eq. (26)'s: damping over sqrt(m K).
#include <fmt/format.h>

#include <cmath>

#include "cases/collide_wall.hpp"
#include "kernel/fixdem.hpp"

namespace {

using namespace fixdem;

constexpr double restitutions[] = {1, 0.95, 0.9, 0.8, 0.7, 0.5, 0.3, 0.2, 0.1, 0.05};

template <int number>
struct Impact : cases::collide_wall {
  static constexpr double restitution = restitutions[number];
  static constexpr double time_step = cases::collide_wall::time_step / 10;
};

/// Returns whether the particle came back.
template <class Case>
bool collide() {
  static Simulation<Case> simulation;
  constexpr double r = Case::diameter / 2, speed = 1;  // m, m/s
  const double m = Derived<Case>::mass, K = Derived<Case>::stiffness_wall;
  const double alpha = Derived<Case>::damping_wall / std::sqrt(m * K);
  const double deepest = std::pow(5 * m * speed * speed / (4 * K), 0.4);
  simulation.place(0, {{0, 0, r + 0.5 * speed * Case::time_step}, {0, 0, -speed}, {}});
  Status status = simulation.start();
  fmt::print("path,{:.6g},0,1\n", alpha);
  for (int step = 0; status.ok() && step < 20000; ++step) {
    status = simulation.run(1);
    const Particle p = simulation.particle(0);
    const double overlap = r - p.position[2], velocity = -p.velocity[2];
    if (overlap <= 0 && velocity < 0) {
      fmt::print("impact,{:.6g},{:.6g},{:.6g}\n", alpha, Case::restitution, -velocity / speed);
      return true;
    }
    fmt::print("path,{:.6g},{:.6g},{:.6g}\n", alpha, overlap / deepest, velocity / speed);
  }
  return false;
}

template <int... number>
bool collide_all(std::integer_sequence<int, number...>) {
  return (collide<Impact<number>>() && ...);
}

}  // namespace

int main() { return collide_all(std::make_integer_sequence<int, std::size(restitutions)>{}) ? 0 : 1; }
