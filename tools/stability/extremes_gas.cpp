// Extreme gas, of a case that has gas: velocities, viscosities, and slices that are empty, full or hold one particle.
//
// Nineteen particles fill one slice of the pipe in a hexagonal layer (void fraction at its lower limit), one lies alone
// on the bottom, one diameter away from all others (upper limit), and all other slices are empty.
#include "extreme_scene.hpp"

namespace fixdem::stability {
namespace {

struct layer : Own {
  static constexpr int particle_count = 20, slice_count = 20;
  static constexpr bool energy_ledger = true;
  static constexpr Ends ends = Ends::periodic;
  static constexpr double gravity[3] = {0, -9.81, 0};  // the case's own may be one for a single particle
  static constexpr double pipe_diameter = 5.02 * Own::diameter, pipe_length = 20 * Own::diameter;
};
template <int velocity>
struct blown : layer {
  static constexpr double gas_velocity = velocity;
};
struct thin_gas : layer {
  static constexpr double gas_viscosity = 1e-12;
};
struct thick_gas : layer {
  static constexpr double gas_viscosity = 1e3;
};

template <class Case>
Row blow() {
  constexpr double d = Case::diameter;
  std::vector<Particle> particles;
  for (int row = -2; row <= 2; ++row) {
    const int count = 5 - std::abs(row);
    for (int k = 0; k < count; ++k) {
      Particle p{};
      p.position[0] = 0.8660254 * 1.001 * d * row;
      p.position[1] = 1.001 * d * (k - 0.5 * (count - 1));
      p.position[2] = 4.5 * d;
      particles.push_back(p);
    }
  }
  Particle alone{};
  alone.position[1] = -(Case::pipe_diameter - d) / 2 - 1e-6 * d;
  alone.position[2] = 12.5 * d;
  particles.push_back(alone);
  Row row = run_scene<Case>(particles, 20000, false, 100);
  return row;
}

std::vector<Scene> scenes() {
  return {
      {"gas as in the case: an empty slice, a full one, one with one particle", blow<layer>},
      {"gas velocity 0", blow<blown<0>>},
      {"gas reversed, -5 m/s", blow<blown<-5>>},
      {"gas at 1000 m/s", blow<blown<1000>>},
      {"kinematic viscosity 1e-12 m2/s", blow<thin_gas>},
      {"kinematic viscosity 1e3 m2/s", blow<thick_gas>},
  };
}

}  // namespace
}  // namespace fixdem::stability

int main(int argc, char** argv) { return fixdem::stability::main_of(fixdem::stability::scenes(), argc, argv); }
