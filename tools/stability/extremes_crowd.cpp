// Extreme numbers and places: one particle, a stack of 50, as many neighbours as there is room for and one more, a
// contact that lasts one step, and a pipe of 80 000 diameters.
#include "extreme_scene.hpp"

namespace fixdem::stability {
namespace {

constexpr double d = Small::diameter;

struct one : Small {
  static constexpr int particle_count = 1;
  static constexpr double gravity[3] = {0, -9.81, 0};
};

Row one_falls() {
  std::vector<Particle> particles(1);
  particles[0].position[2] = 10 * d;
  return run_scene<one>(particles, 100000, false, 500);
}

struct stack : Small {
  static constexpr int particle_count = 50;
  static constexpr Ends ends = Ends::closed;
  static constexpr double pipe_length = 60 * d;
  static constexpr double gravity[3] = {0, 0, -9.81};
};

/// Fifty on top of one another, laid down touching; they sag and come to rest.
Row stacked() {
  std::vector<Particle> particles(50);
  for (int k = 0; k < 50; ++k) particles[static_cast<std::size_t>(k)].position[2] = (k + 0.5) * d;
  return run_scene<stack>(particles, 100000, false, 500);
}

struct crowd : Small {
  static constexpr int particle_count = 6;
};

/// One in the middle of others that touch it.
Row neighbours(int count) {
  std::vector<Particle> particles(6);
  particles[0].position[2] = 10 * d;
  const double places[5][3] = {{d, 0, 0}, {-d, 0, 0}, {0, d, 0}, {0, -d, 0}, {0, 0, d}};
  for (int k = 0; k < 5; ++k)
    for (int c = 0; c < 3; ++c)
      particles[static_cast<std::size_t>(k + 1)].position[c] =
          (k < count ? 1 : 1.5 + 0.2 * k) * places[k][c] + (c == 2 ? 10 * d : 0);
  return run_scene<crowd>(particles, 2000, false, 50);
}

template <int steps>
struct coarse : Resolved<Small, steps> {};

/// Head on at 1 m/s with a step of a contact time and of a third of it.
template <class Case>
Row short_contact() {
  std::vector<Particle> particles(3);
  const double gap = 0.5 * Case::time_step;
  particles[0].position[2] = 10 * d - (d + gap) / 2, particles[1].position[2] = 10 * d + (d + gap) / 2;
  particles[0].velocity[2] = 0.5, particles[1].velocity[2] = -0.5;
  return run_scene<Case>(particles, 40, true, 1);
}

struct long_pipe : Resolved<Small> {
  static constexpr double pipe_length = 80000 * d;
};

/// A collision near the far end of a pipe of 80 000 diameters, and the third particle across the ends with none.
Row far_away() {
  std::vector<Particle> particles(3);
  const double gap = 0.3 * long_pipe::time_step, place = long_pipe::pipe_length - 5 * d;
  particles[0].position[2] = place - (d + gap) / 2, particles[1].position[2] = place + (d + gap) / 2;
  particles[0].velocity[2] = 0.5, particles[1].velocity[2] = -0.5;
  particles[2].position[2] = 2 * d;
  return run_scene<long_pipe>(particles, 400, true, 5);
}

std::vector<Scene> scenes() {
  return {
      {"one particle, falling onto the wall", one_falls},
      {"a stack of 50", stacked},
      {"as many neighbours as there is room for (4)", [] { return neighbours(4); }},
      {"one neighbour more than there is room for", [] { return neighbours(5); }},
      {"a contact that lasts one step", short_contact<coarse<1>>},
      {"a contact that lasts three steps", short_contact<coarse<3>>},
      {fmt::format("a pipe of {:g} m, collision at its far end", long_pipe::pipe_length), far_away},
  };
}

}  // namespace
}  // namespace fixdem::stability

int main(int argc, char** argv) { return fixdem::stability::main_of(fixdem::stability::scenes(), argc, argv); }
