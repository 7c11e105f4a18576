// Scenes that must come out the same to the last bit, however the kernel is compiled: small, agitated, and between them
// with every law, integrator, precision and kind of wall, with and without gas and friction; lines lie flat, on a slope
// and upright.
//
// Nothing here needs a library, not even the mathematics library, so that the scenes also run where there is none.
#pragma once

#include "cases/plug_u24.hpp"
#include "cases/settle.hpp"
#include "kernel/particles.hpp"
#include "tests/mixed.hpp"

namespace fixdem::tests::identical {

/// Particles on a jittered lattice that fits the pipe, with velocities and spins, the same for every width.
template <class Simulation>
void place_agitated(Simulation& simulation) {
  using Case = typename Simulation::case_type;
  unsigned long long bits = 0x9e3779b97f4a7c15ULL;
  const auto uniform = [&] {
    bits ^= bits << 13, bits ^= bits >> 7, bits ^= bits << 17;
    return static_cast<double>(bits >> 11) * 0x1p-52 - 1;  // -1 .. 1
  };
  const double d = Case::diameter;
  for (int id = 0; id < Simulation::start_count; ++id) {
    const int layer = id / 4, corner = id % 4;
    Particle p{};
    p.position[0] = (corner % 2 == 0 ? -0.6 : 0.6) * d + 0.05 * d * uniform();
    p.position[1] = (corner / 2 == 0 ? -0.6 : 0.6) * d + 0.05 * d * uniform();
    p.position[2] = (layer + 0.6) * 1.1 * d;
    for (int c = 0; c < 3; ++c) p.velocity[c] = uniform();
    if (Derived<Case>::has_rotation)
      for (int c = 0; c < 3; ++c) p.angular_velocity[c] = 100 * uniform();
    simulation.place(id, p);
  }
}

struct gas : cases::plug_u24 {
  static constexpr int particle_count = 240;
};
struct smooth : gas {
  static constexpr double friction = 0;
};
struct leapfrog : gas {
  static constexpr auto integrator = Integrator::leapfrog;
  static constexpr auto tangential = TangentialLaw::rescale;
};
struct paper : cases::settle {
  static constexpr int particle_count = 20;
  static constexpr auto slider = Slider::paper;
  static constexpr auto tangential = TangentialLaw::force;
};
struct linear : paper {
  static constexpr auto normal = NormalLaw::linear;
  static constexpr auto damping = Damping::critical;
  static constexpr double normal_stiffness = 1e5, tangential_stiffness = 3e4;
};

struct impulse : gas {
  static constexpr auto integrator = Integrator::impulse;
  static constexpr auto slider = Slider::exact;
};

/// Walls of their own, and rolling resistance of pairs and walls; friction of walls alone, and of spheres alone.
struct rolling : gas {
  static constexpr double wall_friction = 0.5, wall_restitution = 0.6;
  static constexpr double rolling_friction = 0.1, wall_rolling_friction = 0.2;
};
struct rolling_impulse : rolling {
  static constexpr auto integrator = Integrator::impulse;
  static constexpr auto slider = Slider::exact;
  static constexpr auto friction_limit = FrictionLimit::elastic;
};
struct rolling_leapfrog : leapfrog {
  static constexpr double rolling_friction = 0.1;
};
struct rolling_on_walls : gas {
  static constexpr double friction = 0, wall_friction = 0.4, wall_rolling_friction = 0.1;
};
struct slippery_walls : impulse {
  static constexpr double wall_friction = 0, rolling_friction = 0.1;
};

/// The same with several sizes: all that grains and walls can be.
template <class Scene>
struct in_two_sizes : Scene {
  static constexpr double largest_diameter = Scene::diameter, smallest_diameter = 0.6 * Scene::diameter;
  static constexpr double reference_density = Scene::density;
  static constexpr double mean_volume = (1 + 2 * 0.6 * 0.6 * 0.6) / 3 * Derived<Scene>::volume;
  static constexpr int species_count = 2, neighbour_capacity = 28;
  static constexpr SizeRun sizes[] = {{80, largest_diameter, Scene::density, 0},
                                      {160, smallest_diameter, 1.5 * Scene::density, 1}};
};
struct two_sizes : in_two_sizes<rolling> {};
struct two_sizes_impulse : in_two_sizes<rolling_impulse> {};
struct two_sizes_smooth : in_two_sizes<smooth> {};

/// Open lines: the last layers leave, and as many particles are fed as find room beside the first.
template <class Scene>
struct opened : Scene {
  static constexpr auto ends = Ends::open;
  static constexpr int start_count = 100, particle_count = 160, slice_count = 27;
  static constexpr double pipe_length = 0.271;
  static constexpr TimeValue feed_rate[] = {{0, 1}, {0.001, 5}, {0.003, 2}};
  static constexpr double feed_start = 0.0002, feed_length = 0.1, feed_velocity = 0.5;
  static constexpr unsigned long long feed_seed = 3;
  static constexpr int feed_interval = 90, first_fed_kind = 60;
};
struct line : opened<gas> {};
struct line_on_slope : opened<rolling_impulse> {
  static constexpr double gravity[3] = {-4, -6, -5};
};
struct line_leapfrog : opened<leapfrog> {
  static constexpr double gravity[3] = {0, 0, -9.81};
};
struct line_of_two_sizes : opened<two_sizes> {};

struct mixed_gas : in_mixed_precision<gas> {};
struct mixed_smooth : in_mixed_precision<smooth> {};
struct mixed_leapfrog : in_mixed_precision<leapfrog> {};
struct mixed_paper : in_mixed_precision<paper> {};
struct mixed_rolling : in_mixed_precision<rolling> {};
struct mixed_two_sizes : in_mixed_precision<two_sizes> {};
struct mixed_line : in_mixed_precision<line_of_two_sizes> {};

inline constexpr long long steps = 2000;

/// Calls visit.template operator()<Case>(name) for each scene, in the order of tests/golden/scenes.txt.
template <class Visit>
constexpr void for_each_scene(Visit visit) {
  visit.template operator()<gas>("gas");
  visit.template operator()<smooth>("smooth");
  visit.template operator()<leapfrog>("leapfrog");
  visit.template operator()<paper>("paper");
  visit.template operator()<linear>("linear");
  visit.template operator()<impulse>("impulse");
  visit.template operator()<mixed_gas>("mixed gas");
  visit.template operator()<mixed_smooth>("mixed smooth");
  visit.template operator()<mixed_leapfrog>("mixed leapfrog");
  visit.template operator()<mixed_paper>("mixed paper");
  visit.template operator()<rolling>("rolling");
  visit.template operator()<rolling_impulse>("rolling impulse");
  visit.template operator()<rolling_leapfrog>("rolling leapfrog");
  visit.template operator()<rolling_on_walls>("rolling on walls");
  visit.template operator()<slippery_walls>("slippery walls");
  visit.template operator()<mixed_rolling>("mixed rolling");
  visit.template operator()<two_sizes>("two sizes");
  visit.template operator()<two_sizes_impulse>("two sizes impulse");
  visit.template operator()<two_sizes_smooth>("two sizes smooth");
  visit.template operator()<mixed_two_sizes>("mixed two sizes");
  visit.template operator()<line>("line");
  visit.template operator()<line_on_slope>("line on slope");
  visit.template operator()<line_leapfrog>("line leapfrog");
  visit.template operator()<line_of_two_sizes>("line of two sizes");
  visit.template operator()<mixed_line>("mixed line");
}

}  // namespace fixdem::tests::identical
