// Impacts on a wall with friction and restitution of its own, against an event-driven solution of the equations of one
// contact (Dormand-Prince, long double, two tolerances 2e-9 apart); what the particles have among themselves must not
// matter.
#include <cmath>
#include <vector>

#include "impact_scene.hpp"
#include "mixed.hpp"
#include "recorded.hpp"

namespace fixdem::tests {
namespace {

struct Rebound {
  double degrees;
  double velocity_total, spin_total, velocity_elastic, spin_elastic;  ///< along the wall, m/s; rad/s
  double contact_time;                                                ///< us; whatever the friction
};

template <int hundredths, int tenths, FrictionLimit limit, Integrator scheme>
struct onto_wall : impact_scene {
  static constexpr double wall_friction = 0.01 * hundredths, wall_restitution = 0.1 * tenths;
  static constexpr FrictionLimit friction_limit = limit;
  static constexpr Integrator integrator = scheme;
  static constexpr Slider slider = scheme == Integrator::impulse ? Slider::exact : Slider::clip;
};

/// Of each sphere, s: between the places at which it enters and leaves the wall, straight between steps.
template <class Case>
std::vector<double> contact_times(Simulation<Case>& simulation, int count, long long steps) {
  const auto gap = [&](int k) { return simulation.particle(k).position[2] - Case::diameter / 2; };
  std::vector<double> last, times(static_cast<std::size_t>(count), 0.0);
  for (int k = 0; k < count; ++k) last.push_back(gap(k));
  for (long long step = 1; step <= steps; ++step) {
    run(simulation, 1);
    for (int k = 0; k < count; ++k) {
      const auto i = static_cast<std::size_t>(k);
      const double now = gap(k);
      if ((now < 0) != (last[i] < 0)) {
        const double crossing = Case::time_step * (static_cast<double>(step - 1) + last[i] / (last[i] - now));
        times[i] += now < 0 ? -crossing : crossing;
      }
      last[i] = now;
    }
  }
  return times;
}

/// All angles at once, each sphere for itself. `tolerance`: m/s; of the contact time a hundred times that, us.
template <class Case>
void check_rebounds(const Rebound* rebounds, int count, double tolerance, const Table& table = unrecorded) {
  enter({Case::name, seed()});
  static Simulation<Case> simulation;
  const double d = Case::diameter, pi = Derived<Case>::pi;
  Spheres spheres = oblique_impacts<Case>(Random(seed()));
  for (int k = 0; k < count; ++k) {
    Sphere& s = spheres[static_cast<std::size_t>(k)];
    s = {};
    const double angle = rebounds[k].degrees * pi / 180;
    s.velocity[0] = std::sin(angle), s.velocity[2] = -std::cos(angle);
    s.position[0] = (k - 10) * 4 * d, s.position[2] = d / 2 + 1e-6;
  }
  place_all(simulation, spheres);
  start(simulation);
  const auto times = contact_times(simulation, count, static_cast<long long>(3e-4 / Case::time_step));
  WorstFigures worst(table, "mu = " + in_words(Case::wall_friction) + ", e = " + in_words(Case::wall_restitution));
  for (int k = 0; k < count; ++k) {
    const Rebound& expected = rebounds[k];
    const std::string angle = in_words(expected.degrees) + " degrees";
    const Particle after = simulation.particle(k);
    constexpr bool is_elastic = Case::friction_limit == FrictionLimit::elastic;
    const double velocity = is_elastic ? expected.velocity_elastic : expected.velocity_total;
    const double spin = is_elastic ? expected.spin_elastic : expected.spin_total;
    const double rebound = Case::wall_restitution * std::cos(expected.degrees * pi / 180);
    worst.check(angle, {"normal velocity", "m/s"}, rebound, after.velocity[2], tolerance);
    worst.check(angle, {"tangential velocity", "m/s"}, velocity, after.velocity[0], tolerance);
    worst.check(angle, {"angular velocity", "rad/s"}, spin, after.angular_velocity[1], tolerance / (d / 2));
    worst.check(angle, {"contact time", "us"}, expected.contact_time, 1e6 * times[static_cast<std::size_t>(k)],
                tolerance * 1e2);
  }
}

template <int hundredths, int tenths, int count>
void check_wall(const Rebound (&rebounds)[count]) {
  using enum FrictionLimit;
  using enum Integrator;
  check_rebounds<onto_wall<hundredths, tenths, total, impulse>>(rebounds, count, 2e-4);
  check_rebounds<onto_wall<hundredths, tenths, elastic, impulse>>(rebounds, count, 2e-4,
                                                                  {"own-walls", "reference integration"});
  check_rebounds<in_mixed_precision<onto_wall<hundredths, tenths, total, impulse>>>(rebounds, count, 3e-4);
  check_rebounds<in_mixed_precision<onto_wall<hundredths, tenths, elastic, impulse>>>(rebounds, count, 3e-4);
  check_rebounds<onto_wall<hundredths, tenths, total, euler>>(rebounds, count, 1e-3);
  check_rebounds<onto_wall<hundredths, tenths, elastic, euler>>(rebounds, count, 1e-3);
}

TEST_CASE("a wall of its own: rebounds from 5 to 75 degrees") {
  check_wall<15, 6>({{5, 0.0637529633, 11.70138974, 0.0625257461, 12.31499830, 87.5445},
                     {15, 0.1943211436, 32.24895074, 0.1963345796, 31.24223277, 88.0864},
                     {30, 0.3506829797, 74.65851015, 0.3476035572, 76.19822139, 90.0309},
                     {45, 0.5305513008, 88.27774020, 0.5374011537, 84.85281374, 93.7564},
                     {60, 0.7411818263, 62.42178873, 0.7460254038, 60.00000000, 100.4856},
                     {75, 0.9013020353, 32.31189550, 0.9038092555, 31.05828541, 114.6301}});
  check_wall<50, 8>({{5, 0.0623628671, 12.39643782, 0.0582793651, 14.43818882, 84.3136},
                     {30, 0.4025578374, 48.72108132, 0.4012748212, 49.36258938, 86.7082},
                     {45, 0.5572959429, 74.90541913, 0.5590007013, 74.05303996, 90.2962},
                     {75, 0.7308924235, 117.51670141, 0.7329886857, 116.46857030, 110.3995}});
}

}  // namespace
}  // namespace fixdem::tests
