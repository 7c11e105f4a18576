// The impacts whose outcome is known exactly: head-on pairs, head-on and oblique impacts on a flat wall.
//
// Every kind is repeated at `repeats` speeds around 1 m/s, each with another phase of the first contact within the
// step: a single speed and phase can hit or miss a resonance of step and contact time by a factor of five. Speeds and
// phases are two additive sequences, so they fill their square evenly. No gravity, no gas, no other contacts; an
// impact without gravity does not depend on when it begins, so the exact outcome belongs to the speed alone.
#pragma once

#include <cmath>
#include <numbers>

namespace fixdem::frontier {

/// Angle from the normal, degrees; kind 0 is the head-on pair, whose speed is the relative one.
inline constexpr double impact_angles[] = {0, 0, 5, 20, 35, 50, 65, 80};
inline constexpr int impact_kinds = sizeof impact_angles / sizeof impact_angles[0];
inline constexpr int repeats = 24;
inline constexpr int impacts = impact_kinds * repeats;

struct Impact {
  bool is_pair;
  double angle;               ///< degrees
  double speed;               ///< m/s
  double normal, tangential;  ///< parts of the speed before the impact
  double phase;               ///< of the first contact within the step, 0 to 1
};

inline Impact impact(int number) {
  const int kind = number / repeats, k = number % repeats;
  const auto fraction = [](double x) { return x - std::floor(x); };
  Impact i{};
  i.is_pair = kind == 0;
  i.angle = impact_angles[kind];
  i.speed = 0.7 * std::pow(2.0, fraction(0.5 + k * 0.7548776662466927));
  i.phase = fraction(0.5 + k * 0.5698402909980532);
  const double theta = i.angle * std::numbers::pi / 180;
  i.normal = i.speed * std::cos(theta), i.tangential = i.angle > 0 ? i.speed * std::sin(theta) : 0;
  return i;
}

}  // namespace fixdem::frontier
