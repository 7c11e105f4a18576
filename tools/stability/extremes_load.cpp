// Extreme scenes that the case's own material and time step are put through: speeds, overlaps, places.
#include "extreme_scene.hpp"

namespace fixdem::stability {
namespace {

constexpr double d = Small::diameter, r = d / 2, middle = Small::pipe_length / 2, wall = Small::pipe_diameter / 2;

/// Three particles: two about to touch on the axis, one in the way of nobody.
std::vector<Particle> two_and_one(double gap) {
  std::vector<Particle> particles(3);
  particles[0].position[2] = middle - (d + gap) / 2;
  particles[1].position[2] = middle + (d + gap) / 2;
  particles[2].position[2] = middle - 6 * d;
  return particles;
}

Row impact(double speed) {
  auto particles = two_and_one(0.3 * speed * Small::time_step);
  particles[0].velocity[2] = speed / 2, particles[1].velocity[2] = -speed / 2;
  const program::CaseFacts facts = program::case_facts<Small>();
  const auto steps = static_cast<long long>(4 * program::contact_time(facts, speed) / Small::time_step) + 20;
  return run_scene<Small>(particles, steps, true, std::max(1LL, steps / 40));
}

Row overlap(double radii) { return run_scene<Small>(two_and_one(-radii * r), 2000, false, 5); }

Row coincident() {
  auto particles = two_and_one(0);
  particles[1] = particles[0];
  return run_scene<Small>(particles, 100, false, 5);
}

Row at_wall(double beyond_in_radii) {
  auto particles = two_and_one(d);
  particles[2].position[0] = wall - r + beyond_in_radii * r;
  return run_scene<Small>(particles, 2000, false, 5);
}

/// Overlap of one unit in the last place, motion of denormal size.
Row denormal() {
  auto particles = two_and_one(0);
  particles[1].position[2] = particles[0].position[2] + std::nextafter(d, 0.0);
  for (Particle& p : particles)
    for (int c = 0; c < 3; ++c)
      p.velocity[c] = 1e-310, p.angular_velocity[c] = Derived<Small>::has_rotation ? -3e-312 : 0;
  return run_scene<Small>(particles, 2000, false, 50);
}

Row not_a_number(double value) {
  auto particles = two_and_one(d);
  particles[1].velocity[1] = value;
  return run_scene<Small>(particles, 10, false, 5);
}

std::vector<Scene> scenes() {
  std::vector<Scene> list;
  for (const double speed : {1e-9, 1e-6, 1e-3, 0.1, 1.0, 10.0, 100.0, 300.0, 3000.0, 1e5})
    list.push_back({fmt::format("impact at {:g} m/s", speed), [speed] { return impact(speed); }});
  const double way = 1.1 * r / Small::time_step;
  list.push_back(
      {fmt::format("impact at {:.3g} m/s, more than a radius per step", 2 * way), [way] { return impact(2 * way); }});
  for (const double radii : {1e-12, 1e-9, 1e-6, 1e-3, 0.1, 0.4, 0.6, 0.9})
    list.push_back({fmt::format("overlap at the start of {:g} radii", radii), [radii] { return overlap(radii); }});
  list.push_back({"coincident centres", coincident});
  list.push_back({"beyond the wall by 0.4 radii", [] { return at_wall(0.4); }});
  list.push_back({"beyond the wall by 0.9 radii", [] { return at_wall(0.9); }});
  list.push_back({"centre outside the wall", [] { return at_wall(1.5); }});
  list.push_back({"overlap of one unit in the last place, motion of denormal size", denormal});
  list.push_back({"a velocity that is no number", [] { return not_a_number(NAN); }});
  list.push_back({"an infinite velocity", [] { return not_a_number(INFINITY); }});
  list.push_back({"a velocity of 1e300 m/s", [] { return not_a_number(1e300); }});
  return list;
}

}  // namespace
}  // namespace fixdem::stability

int main(int argc, char** argv) { return fixdem::stability::main_of(fixdem::stability::scenes(), argc, argv); }
