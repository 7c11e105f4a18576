// Kernel against reference: the same state to both, the same number of steps, and the maximum difference.
//
// The two round differently, and a granular bed amplifies a difference e-fold in about 1.2 ms (in a dense bed) to 4 ms:
// over the 2 ms of 1000 steps, rounding at 1e-17 m grows to some 1e-14 m and more where spheres collide hard. Positions
// must agree to 1e-11 diameters (1e-13 m here). A velocity difference belongs to a position difference over the time
// scale of a contact, 1/(5e4 per s) at the least; a spin difference to a velocity difference over the radius. Springs
// of contacts differ as positions do, and those that slide a little more. The gas takes a relative error of up to 100
// times that from the heights of its slices. With several sizes diameters are the largest; the contacts of the smallest
// are shorter, as diameters are, and its spin differs more.
//
// In mixed precision every collision rounds the change of velocity: 2^-24 of 1 m/s is 6e-8 m/s, and over 2 ms 1e-8
// diameters, before anything amplifies it. Whichever one quantity of a contact is in float, the others in double, the
// error is of that size, so an agitated scene cannot agree better than to some 1e-8 d; a settled bed, where
// velocities are some mm/s, agrees to 1e-10 d. A wrong formula shows at 1e-4 d and more. The ledger sums 1e4 and more
// contact powers in double, each right to some 1e-7: to 1e-6 of the largest term.
//
// Lines are compared from their start on, for longer and in longer steps, for as many as possible to enter and leave.
// Contacts turn by 1e-3 in such a step, and what the two ledgers call sliding differs by some 1e-3 of its square.
#pragma once

#include <cstdlib>
#include <iomanip>
#include <iostream>
#include <map>
#include <set>
#include <utility>

#include "agreement_contacts.hpp"
#include "kernel/fixdem.hpp"
#include "scenes.hpp"

namespace fixdem::tests {

template <class Case>
inline constexpr long long agreement_steps = !is_line<Case>   ? 1000
                                             : is_mixed<Case> ? 2000
                                                              : 3000;
template <class Case>
inline constexpr double position_tolerance = is_mixed<Case> ? 1e-10 : 1e-11;  // diameters
template <class Case>
inline constexpr double agitated_tolerance = is_mixed<Case> ? 3e-7 : 1e-11;  // the same, of agitated scenes
template <class Case>
inline constexpr double mean_square_tolerance = is_mixed<Case> ? 0.1 : 1;  // of the tolerance, root mean square
template <class Case>
inline constexpr double energy_tolerance = is_mixed<Case>  ? 1e-6
                                           : is_line<Case> ? 1e-8
                                                           : 1e-9;  // of the largest term

inline constexpr double leaving_tolerance = 1e-2;  // of springs cut at the outlet: the one has moved, the other not yet

template <class Case>
Simulation<Case>& kernel() {
  static Simulation<Case> simulation;
  return simulation;
}

/// The kernel with its particles by serial number, as the reference has them: in a line it uses numbers again.
template <class Case>
class BySerial {
 public:
  explicit BySerial(const Simulation<Case>& simulation) : simulation_(simulation) {
    for (int id = 0; id < Case::particle_count; ++id)
      if (simulation.is_present(id)) id_[serial(id)] = id;
  }
  int present() const { return static_cast<int>(id_.size()); }
  bool is_present(int serial) const { return id_.count(serial) > 0; }
  int id(int serial) const { return id_.at(serial); }
  Particle particle(int serial) const { return simulation_.particle(id(serial)); }
  template <class F>
  void for_each_contact(F&& visit) const {
    simulation_.for_each_contact([&](Contact c) {
      c.owner = serial(c.owner);
      if (c.partner >= 0) c.partner = serial(c.partner);
      visit(c);
    });
  }

 private:
  int serial(int id) const { return static_cast<int>(simulation_.serial(id)); }

  const Simulation<Case>& simulation_;
  std::map<int, int> id_;
};

template <class Case>
std::set<std::pair<int, int>> contact_keys(const reference::Reference<Case>& program) {
  std::set<std::pair<int, int>> keys;
  program.for_each_contact([&](const auto& c) { keys.insert({c.owner, c.partner}); });
  return keys;
}

/// The books of a line.
template <class Case>
void check_totals(const LineTotals& fast, const reference::LineTotals& slow) {
  CHECK(fast.at_start + fast.fed == fast.present + fast.left);
  CHECK(fast.at_start == slow.at_start);
  CHECK(fast.fed == slow.fed);
  CHECK(fast.left == slow.left);
  CHECK(fast.present == slow.present);
  const double rounding = 1e-12 * (slow.asked + slow.accepted + slow.left_mass);
  CHECK(std::abs(fast.asked - slow.asked) <= rounding);
  CHECK(std::abs(fast.accepted - slow.accepted) <= rounding);
  CHECK(std::abs(fast.left_mass - slow.left_mass) <= rounding);
  CHECK(std::abs(fast.backlog - slow.backlog) <= rounding);
  CHECK(fast.blocked_time == doctest::Approx(slow.blocked_time).epsilon(1e-12));
}

/// Runs both from `state`, checks every particle and the energy ledger, and tells what the contacts did.
template <class Case>
Events check_agreement(const HandOver& state, const char* what, double tolerance = position_tolerance<Case>) {
  constexpr double diameter = largest_diameter<Case>, ratio = diameter / smallest_diameter<Case>;
  const double velocity_tolerance = tolerance * 5e4 * ratio;     // diameters per second
  const double spin_tolerance = 2 * velocity_tolerance * ratio;  // rad/s

  enter({Case::name, seed()});
  Simulation<Case>& fast = kernel<Case>();
  static reference::Reference<Case> slow;
  start_from(fast, state);
  start_from(slow, state);

  Events events;
  double springs = 0;
  std::set<std::pair<int, int>> before;
  for (int piece = 0; piece < 100; ++piece) {
    run(slow, agreement_steps<Case> / 100);
    const auto now = contact_keys(slow);
    if (piece > 0) {
      for (const auto& key : now) events.begun += before.count(key) == 0;
      for (const auto& key : before) events.ended += now.count(key) == 0;
    }
    before = now;
    slow.for_each_contact([&](const auto& c) { count_contact(slow, c, events); });
    if (piece % 10 != 9) continue;
    run(fast, agreement_steps<Case> / 10);
    if constexpr (is_line<Case>) check_totals<Case>(fast.line(), slow.line());
    springs = std::max(springs, difference_of_contacts<Case>(BySerial<Case>(fast), slow, events));
  }

  double position = 0, squares = 0, velocity = 0, spin = 0;
  const BySerial<Case> seen(fast);
  for (int i = 0; i < slow.count(); ++i) {
    REQUIRE(seen.is_present(i) == slow.is_present(i));
    if (!seen.is_present(i)) continue;
    if (has_sizes<Case>) REQUIRE(fast.kind(seen.id(i)) == slow.kind(i));
    const auto a = seen.particle(i);
    const auto b = slow.particle(i);
    const double dx[3] = {a.position[0] - b.position[0], a.position[1] - b.position[1],
                          axial_difference<Case>(a.position[2], b.position[2])};
    position = std::max(position, length(dx) / diameter);
    squares += dot(dx, dx) / (diameter * diameter);
    for (int k = 0; k < 3; ++k) {
      velocity = std::max(velocity, std::abs(a.velocity[k] - b.velocity[k]) / diameter);
      spin = std::max(spin, std::abs(a.angular_velocity[k] - b.angular_velocity[k]));
      // A maximum would overlook what is no number.
      CHECK(std::isfinite(dx[k] + a.velocity[k] - b.velocity[k] + a.angular_velocity[k] - b.angular_velocity[k]));
    }
  }
  INFO(std::string(what), ": ", events.begun, " contacts begun, ", events.ended, " ended");
  CHECK(position < tolerance);
  const double mean_square = std::sqrt(squares / seen.present());
  CHECK(mean_square < mean_square_tolerance<Case> * tolerance);
  CHECK(velocity < velocity_tolerance);
  CHECK(spin < spin_tolerance);
  CHECK(springs < 4 * tolerance);
  if (std::getenv("FIXDEM_FIGURES") != nullptr) {
    std::cerr << std::scientific << std::setprecision(1) << "  " << position << " d (root mean square " << mean_square
              << "), " << velocity << " d/s, " << spin << " rad/s, springs " << springs << " d (" << events.compared
              << "); begun " << events.begun << ", ended " << events.ended << ", sliding " << events.sliding
              << ", sticking " << events.sticking << ", rolling " << events.rolling << ", held " << events.held << ": "
              << what << "\n";
  }

  if constexpr (Case::energy_ledger) {
    const auto a = fast.energy();
    const auto b = slow.energy();
    const double scale = b.kinetic + std::abs(b.dissipated_damping) + std::abs(b.dissipated_sliding) +
                         std::abs(b.dissipated_rolling) + std::abs(b.gravity_work) + std::abs(b.gas_work);
    // Gravity's work is a difference of sums of heights, which round to 1e-16 of themselves; in mixed precision a bed
    // at rest, which does no other work, lies higher or lower by what its positions differ.
    const double height = is_mixed<Case> ? tolerance * diameter : 1e-14 * Case::pipe_diameter;
    double mass = 0;
    for (int i = 0; i < slow.count(); ++i) mass += mass_of<Case>(slow.kind(i));
    const double rounding = height * mass * 10;
    const double energy_error = energy_tolerance<Case> * scale + rounding;
    CHECK(std::abs(a.kinetic - b.kinetic) <= energy_error);
    CHECK(std::abs(a.dissipated_damping - b.dissipated_damping) <= energy_error);
    CHECK(std::abs(a.dissipated_sliding - b.dissipated_sliding) <= energy_error);
    CHECK(std::abs(a.dissipated_rolling - b.dissipated_rolling) <= energy_error);
    CHECK(std::abs(a.made_by_law - b.made_by_law) <= energy_error);
    CHECK(std::abs(a.gravity_work - b.gravity_work) <= energy_error);
    CHECK(std::abs(a.gas_work - b.gas_work) <= energy_error);
    if constexpr (is_line<Case>) {
      CHECK(a.entered == doctest::Approx(b.entered).epsilon(1e-12));
      CHECK(a.left_with == doctest::Approx(b.left_with).epsilon(leaving_tolerance));
    }
  }
  if constexpr (Case::has_gas) {
    for (int s = 0; s < Case::slice_count; ++s) {
      const auto& flow = slow.slices()[s];
      CAPTURE(s);
      CHECK(fast.bed_area(s) == doctest::Approx(flow.bed_area).epsilon(100 * tolerance));
      CHECK(fast.pressure_gradient(s) == doctest::Approx(flow.pressure_gradient).epsilon(100 * tolerance));
    }
  }
  return events;
}

/// The kernel runs the scene for a while, then both go on from there.
template <class Case>
Events check_after(const Spheres& spheres, long long steps, const char* what,
                   double tolerance = position_tolerance<Case>) {
  enter({Case::name, seed()});
  place_all(kernel<Case>(), spheres);
  start(kernel<Case>());
  run(kernel<Case>(), steps);
  return check_agreement<Case>(hand_over_from(kernel<Case>(), Case::particle_count), what, tolerance);
}

}  // namespace fixdem::tests
