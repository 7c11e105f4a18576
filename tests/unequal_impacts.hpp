// Impacts of unequal spheres, written once for the kernel and for the reference: i moves, j rests, and at first touch
// the normal from i to j is +z.
//
// Head on they rebound in closed form. Oblique figures are of an event-driven solution of the equations of one contact
// (Dormand-Prince, long double, two tolerances 2e-9 apart): unequal_figures.hpp, turning_impacts.hpp.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "listed_sizes.hpp"
#include "recorded.hpp"
#include "support.hpp"

namespace fixdem::tests {

/// Nothing but the particles: no wall, no gravity.
template <int tenths, FrictionLimit limit, Integrator scheme, int step_in_ns>
struct free_space : short_pipe {
  static constexpr double restitution = 0.1 * tenths;
  static constexpr FrictionLimit friction_limit = limit;
  static constexpr Integrator integrator = scheme;
  static constexpr Slider slider = scheme == Integrator::impulse ? Slider::exact : Slider::clip;
  static constexpr double time_step = step_in_ns * 1e-9;
  static constexpr bool has_wall = false;
  static constexpr Ends ends = Ends::closed;
  static constexpr double gravity[3] = {0, 0, 0};
};

inline constexpr int impact_kinds = 5, impact_angles[] = {0, 20, 45, 70};  // degrees from the normal

/// Four impacts of each kind, one for each angle: i, then j.
struct unequal_pairs {
  static constexpr const char* name = "unequal pairs";
  static constexpr int species_count = 4;
  static constexpr const char* species_names[] = {"10 mm", "5 mm", "2 mm", "heavy 10 mm"};
  static constexpr SizeRun sizes[] = {
      {4, 0.010, 1000, 0}, {4, 0.005, 1000, 1}, {4, 0.005, 1000, 1}, {4, 0.010, 1000, 0}, {4, 0.010, 1000, 0},
      {4, 0.002, 1000, 2}, {4, 0.002, 1000, 2}, {4, 0.010, 1000, 0}, {4, 0.010, 1000, 0}, {4, 0.010, 10000, 3}};
};
template <int tenths, FrictionLimit limit, Integrator scheme, int step_in_ns>
struct unequal : sized<unequal_pairs, free_space<tenths, limit, scheme, step_in_ns>> {
  static constexpr double pipe_length = 0.7;
  static constexpr int slice_count = 70, neighbour_capacity = 130;
};

/// After an impact: velocities along x and z, spins about y, duration, maximum overlap, share of the energy left, work
/// that rolling resistance has taken (J).
struct Parting {
  double x_i, z_i, w_i, x_j, z_j, w_j, time, overlap, energy, rolling_work;
};

/// A pair: numbers, and what it does before it meets.
struct Meeting {
  int i, j;
  double x, z, w_i, w_j;  ///< velocity of i, spins
};

/// All meetings in one run, `pitch` (m) apart along z, each 1 us before it touches, for a time of `seconds`. What
/// rolling resistance takes is told from the motion alone: with f_t = m dv/dt, its torque on i is I dw/dt - r f_t.
template <class Case, class Solver>
std::vector<Parting> partings(Solver& solver, const std::vector<Meeting>& meetings, double pitch, double seconds) {
  enter({Case::name, 0});
  constexpr double before = 1e-6;
  const auto energy = [](int id, double x, double z, double w) {
    const double r = radius_of<Case>(id);
    return mass_of<Case>(id) * ((x * x + z * z) / 2 + 0.2 * r * r * w * w);
  };
  const auto touch = [](const Meeting& m) { return radius_of<Case>(m.i) + radius_of<Case>(m.j); };
  double z = 0.5 * pitch;
  for (const Meeting& m : meetings) {
    solver.place(m.i, {{-m.x * before, 0, z - touch(m) - m.z * before}, {m.x, 0, m.z}, {0, m.w_i, 0}});
    solver.place(m.j, {{0, 0, z}, {0, 0, 0}, {0, m.w_j, 0}});
    z += pitch;
  }
  start(solver);
  std::vector<Parting> found(meetings.size());
  std::vector<double> last(meetings.size(), -1e-12), touched(meetings.size());
  using Particle = decltype(solver.particle(0));
  std::vector<std::array<Particle, 2>> then;
  for (const Meeting& m : meetings) then.push_back({solver.particle(m.i), solver.particle(m.j)});
  for (long long step = 0; static_cast<double>(step) * Case::time_step < seconds; ++step) {
    run(solver, 1);
    for (std::size_t k = 0; k < meetings.size(); ++k) {
      const auto a = solver.particle(meetings[k].i), b = solver.particle(meetings[k].j);
      const double between[3] = {b.position[0] - a.position[0], 0, b.position[2] - a.position[2]};
      const double overlap = touch(meetings[k]) - length(between);
      const double crossing = Case::time_step * (static_cast<double>(step + 1) - overlap / (overlap - last[k]));
      if (last[k] <= 0 && overlap > 0) touched[k] = crossing;  // by the secant
      if (last[k] > 0 && overlap <= 0) found[k].time = crossing - touched[k];
      found[k].overlap = std::max(found[k].overlap, overlap);
      last[k] = overlap;
      const double r = radius_of<Case>(meetings[k].i), mass = mass_of<Case>(meetings[k].i);
      const double w = a.angular_velocity[1], last_w = then[k][0].angular_velocity[1];
      const double torque = mass * (0.4 * r * r * (w - last_w) - r * (a.velocity[0] - then[k][0].velocity[0]));
      found[k].rolling_work -= torque * (w + last_w - b.angular_velocity[1] - then[k][1].angular_velocity[1]) / 2;
      then[k] = {a, b};
    }
  }
  for (std::size_t k = 0; k < meetings.size(); ++k) {
    const Meeting& m = meetings[k];
    const auto a = solver.particle(m.i), b = solver.particle(m.j);
    Parting& p = found[k];
    REQUIRE(last[k] < 0);
    p.x_i = a.velocity[0], p.z_i = a.velocity[2], p.w_i = a.angular_velocity[1];
    p.x_j = b.velocity[0], p.z_j = b.velocity[2], p.w_j = b.angular_velocity[1];
    p.energy = (energy(m.i, p.x_i, p.z_i, p.w_i) + energy(m.j, p.x_j, p.z_j, p.w_j)) /
               (energy(m.i, m.x, m.z, m.w_i) + energy(m.j, 0, 0, m.w_j));
  }
  return found;
}

/// What is allowed: m/s, head on and oblique, at the surface for spins; of the contact time; of the maximum overlap;
/// of the energy.
struct ImpactBounds {
  double head_on, velocity, time, overlap, energy;
};

/// Contact time (us) and maximum overlap (um) head on, of a kind of impact.
struct HeadOnFigures {
  int kind;
  double time, overlap;
};
/// Of a kind of impact at an angle; time in us.
struct ObliqueFigures {
  int kind, angle;
  double x_i, z_i, w_i, x_j, z_j, w_j, time, energy;
};
/// At one restitution, for both limits of friction.
struct UnequalFigures {
  std::vector<HeadOnFigures> head_on;
  std::vector<ObliqueFigures> total, elastic;
};

inline constexpr const char* kind_names[] = {"10 mm on 5 mm", "5 mm on 10 mm", "10 mm on 2 mm", "2 mm on 10 mm",
                                             "10 mm on 10 mm of ten times the density"};

/// Of all impacts of a case; the worst of each quantity is recorded.
template <class Case>
struct UnequalChecks {
  WorstFigures oblique, head_on;  // recorded in the order in which they go: head on first

  explicit UnequalChecks(const Table& table)
      : oblique(table, "oblique, e = " + in_words(Case::restitution)),
        head_on(table, "head on, e = " + in_words(Case::restitution)) {}

  void check(const Parting& p, const HeadOnFigures& expected, const ImpactBounds& bounds) {
    const int i = 8 * expected.kind, j = i + 4;
    const double m_i = mass_of<Case>(i), m_j = mass_of<Case>(j), taken = (1 + Case::restitution) / (m_i + m_j);
    const std::string kind = kind_names[expected.kind];
    head_on.check(kind, {"velocity of i", "m/s"}, 1 - taken * m_j, p.z_i, bounds.head_on);
    head_on.check(kind, {"velocity of j", "m/s"}, taken * m_i, p.z_j, bounds.head_on);
    head_on.check(kind, {"contact time", "us"}, expected.time, p.time * 1e6, bounds.time * expected.time);
    head_on.check(kind, {"maximum overlap", "um"}, expected.overlap, p.overlap * 1e6,
                  bounds.overlap * expected.overlap);
    CAPTURE(expected.kind);
    CHECK(p.x_i == 0);
    CHECK(p.w_j == 0);
  }

  void check(const Parting& p, const ObliqueFigures& expected, const ImpactBounds& bounds) {
    const int i = 8 * expected.kind, j = i + 4;
    const std::string which = kind_names[expected.kind] + (", " + in_words(expected.angle)) + " degrees";
    const double v = bounds.velocity;
    oblique.check(which, {"tangential velocity of i", "m/s"}, expected.x_i, p.x_i, v);
    oblique.check(which, {"normal velocity of i", "m/s"}, expected.z_i, p.z_i, v);
    oblique.check(which, {"angular velocity of i", "rad/s"}, expected.w_i, p.w_i, v / radius_of<Case>(i));
    oblique.check(which, {"tangential velocity of j", "m/s"}, expected.x_j, p.x_j, v);
    oblique.check(which, {"normal velocity of j", "m/s"}, expected.z_j, p.z_j, v);
    oblique.check(which, {"angular velocity of j", "rad/s"}, expected.w_j, p.w_j, v / radius_of<Case>(j));
    oblique.check(which, {"contact time", "us"}, expected.time, p.time * 1e6, bounds.time * expected.time);
    oblique.check(which, {"share of the energy left", ""}, expected.energy, p.energy, bounds.energy);
  }
};

/// Runs all impacts of a restitution and limit, and checks those whose figures are given.
template <template <class> class Solver, class Case>
void check_unequal(const UnequalFigures& figures, const ImpactBounds& bounds, const Table& table = unrecorded) {
  constexpr double degree = 3.14159265358979323846 / 180;
  static Solver<Case> solver;
  std::vector<Meeting> meetings;
  for (int kind = 0; kind < impact_kinds; ++kind)
    for (int k = 0; k < 4; ++k) {
      const double angle = impact_angles[k] * degree;
      const Meeting straight{8 * kind + k, 8 * kind + 4 + k, 0, 1, 0, 0};
      const Meeting slanting{8 * kind + k, 8 * kind + 4 + k, std::sin(angle), std::cos(angle), 50, -100};
      meetings.push_back(k == 0 ? straight : slanting);
    }
  const std::vector<Parting> found = partings<Case>(solver, meetings, 0.03, 1.25e-4);
  UnequalChecks<Case> checks(table);
  for (const HeadOnFigures& f : figures.head_on) checks.check(found[4 * f.kind], f, bounds);
  for (const ObliqueFigures& f : Case::friction_limit == FrictionLimit::total ? figures.total : figures.elastic) {
    const auto at = std::find(std::begin(impact_angles), std::end(impact_angles), f.angle);
    checks.check(found[4 * f.kind + (at - std::begin(impact_angles))], f, bounds);
  }
}

}  // namespace fixdem::tests
