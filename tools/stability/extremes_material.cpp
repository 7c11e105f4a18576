// Extreme materials: a head-on collision and one with the wall at 1 m/s, at a step that resolves them, and for the
// stiffest and lightest at the case's own step as well. FIXDEM_GROUP chooses a third of them, so that they compile at
// once.
#include "extreme_scene.hpp"

namespace fixdem::stability {
namespace {

/// 0 and 1 head on along the axis; 2 onto the wall at 45 degrees.
template <class Case>
Row collide() {
  constexpr double d = Case::diameter, speed = 1;
  constexpr double gap = 0.3 * speed * Case::time_step;
  std::vector<Particle> particles(3);
  particles[0].position[2] = Case::pipe_length / 2 - (d + gap) / 2;
  particles[1].position[2] = Case::pipe_length / 2 + (d + gap) / 2;
  particles[0].velocity[2] = speed / 2, particles[1].velocity[2] = -speed / 2;
  particles[2].position[0] = Case::pipe_diameter / 2 - d / 2 - gap;
  particles[2].position[2] = Case::pipe_length / 2 - 6 * d;
  particles[2].velocity[0] = particles[2].velocity[2] = speed / 1.4142135623730951;
  // Strong damping makes a contact last several times as long.
  const auto steps = static_cast<long long>(12 * contact_time<Case>() / Case::time_step) + 50;
  return run_scene<Case>(particles, steps, true, std::max(1LL, steps / 200));
}

#if FIXDEM_GROUP == 1
template <int exponent>
struct modulus : Small {
  static constexpr double youngs_modulus = exponential(exponent * logarithm(10.0));
  static constexpr double wall_youngs_modulus = youngs_modulus;
};
struct poisson_0 : Small {
  static constexpr double poisson_ratio = 0, wall_poisson_ratio = 0;
};
struct poisson_half : Small {
  static constexpr double poisson_ratio = 0.5, wall_poisson_ratio = 0.5;
};

std::vector<Scene> scenes() {
  return {
      {"E = 1e5 Pa", collide<Resolved<modulus<5>>>},          {"E = 1e12 Pa", collide<Resolved<modulus<12>>>},
      {"E = 1e12 Pa, the case's step", collide<modulus<12>>}, {"E = 1e16 Pa, the case's step", collide<modulus<16>>},
      {"Poisson's ratio 0", collide<Resolved<poisson_0>>},    {"Poisson's ratio 0.5", collide<Resolved<poisson_half>>},
  };
}
#elif FIXDEM_GROUP == 2
template <int percent>
struct restitution_of : Small {
  static constexpr double restitution = percent / 100.0, wall_restitution = restitution;
};
struct friction_0 : Small {
  static constexpr double friction = 0, wall_friction = 0;
  static constexpr double rolling_friction = 0, wall_rolling_friction = 0;
  static constexpr FrictionLimit friction_limit = FrictionLimit::total;
};
struct friction_small : Small {
  static constexpr double friction = 1e-6, wall_friction = friction;
};
struct friction_10 : Small {
  static constexpr double friction = 10, wall_friction = friction;
};

std::vector<Scene> scenes() {
  return {
      {"restitution 0.01", collide<Resolved<restitution_of<1>, 2000>>},
      {"restitution 0.1", collide<Resolved<restitution_of<10>, 1000>>},
      {"restitution 1", collide<Resolved<restitution_of<100>>>},
      {"friction 0", collide<Resolved<friction_0>>},
      {"friction 1e-6", collide<Resolved<friction_small>>},
      {"friction 10", collide<Resolved<friction_10>>},
  };
}
#else
struct density_1 : Small {
  static constexpr double density = 1;
};
struct density_20000 : Small {
  static constexpr double density = 2e4;
};
struct micrometre : Small {
  static constexpr double diameter = 1e-6, pipe_diameter = 5e-6, pipe_length = 20e-6;
};
struct metre : Small {
  static constexpr double diameter = 1, pipe_diameter = 5, pipe_length = 20;
};

std::vector<Scene> scenes() {
  return {
      {"density 1 kg/m3", collide<Resolved<density_1>>},
      {"density 1 kg/m3, the case's step", collide<density_1>},
      {"density 2e4 kg/m3", collide<Resolved<density_20000>>},
      {"diameter 1e-6 m", collide<Resolved<micrometre>>},
      {"diameter 1e-6 m, the case's step", collide<micrometre>},
      {"diameter 1 m", collide<Resolved<metre>>},
  };
}
#endif

}  // namespace
}  // namespace fixdem::stability

int main(int argc, char** argv) { return fixdem::stability::main_of(fixdem::stability::scenes(), argc, argv); }
