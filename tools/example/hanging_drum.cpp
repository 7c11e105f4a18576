// Co-simulation in another program's loop: a drum of 150 particles hangs from a spring and a damper.
//
// Every ten steps the drum is moved by spring, damper, its weight and the force that the particles exert on its walls;
// they, in turn, feel gravity less the acceleration of the drum. In the end it hangs still, and the spring carries drum
// and particles. No library: a compiler, the kernel and one generated header (make header CASE=settle > settle.hpp).
#include <cmath>
#include <cstdio>
#include <initializer_list>

#include "cases/settle.hpp"
#include "kernel/fixdem.hpp"

struct Drum : fixdem::cases::settle {
  static constexpr bool is_coupled = true;  // gravity is set while it runs
};
static fixdem::Simulation<Drum> content;  // all of its memory; about 300 kB

int main() {
  const double d = Drum::diameter, weight_of_particles = Drum::particle_count * fixdem::Derived<Drum>::mass * 9.81;
  for (int id = 0; id < Drum::particle_count; ++id) {  // six layers of 5 x 5 along the axis
    const double x = id % 5 - 2, y = id / 5 % 5 - 2, layer = id / 25;
    content.place(id, {{1.03 * d * x, 1.03 * d * y, (0.6 + 1.05 * layer) * d}, {0, 0, 0}, {0, 0, 0}});
  }
  if (!content.start().ok()) return 1;

  const double mass = 0.2, stiffness = 400, damping = 10;  // kg, N/m, N s/m
  const int steps = 10;
  const double interval = steps * Drum::time_step;
  double height = 0, velocity = 0;  // of the drum above the spring's own length, m and m/s
  for (int exchange = 0; exchange < 30000; ++exchange) {
    double force = -stiffness * height - damping * velocity - 9.81 * mass;
    for (int wall : {fixdem::pipe_wall, fixdem::start_end, fixdem::far_end}) force += content.force_on(wall).y;
    const double acceleration = force / mass;
    velocity += acceleration * interval;
    height += velocity * interval;
    content.set_gravity({0, -9.81 - acceleration, 0});
    if (const fixdem::Status status = content.run(steps); !status.ok()) {
      std::printf("stopped at step %lld: %s, %g\n", status.step, fixdem::describe(status.fault), status.value);
      return 1;
    }
    if (exchange % 5000 == 0) std::printf("%.1f s: drum at %+.2f mm\n", content.time(), 1e3 * height);
  }
  const double carried = -stiffness * height, weight = weight_of_particles + 9.81 * mass;
  std::printf("the spring carries %.5f N; drum and particles weigh %.5f N\n", carried, weight);
  return std::abs(carried - weight) < 1e-3 * weight ? 0 : 1;
}
