// Kernel against reference with several sizes: integrators, forms, sliders, normal laws, walls, gas.
#include "sizes_scenes.hpp"

namespace fixdem::tests {
namespace {

using periodic = sized<two_sizes, short_pipe>;
using closed = sized<two_sizes, closed_pipe>;

template <class Base, TangentialLaw form, Slider kind, Integrator scheme>
struct with : Base {
  static constexpr TangentialLaw tangential = form;
  static constexpr Slider slider = kind;
  static constexpr Integrator integrator = scheme;
};
template <class Base>
struct elastic_limit : Base {
  static constexpr FrictionLimit friction_limit = FrictionLimit::elastic;
};
template <class Base>
struct own_walls : Base {
  static constexpr double wall_friction = 0.1, wall_restitution = 0.5;
};
template <class Base>
struct smooth : Base {
  static constexpr double friction = 0;
};
template <class Base>
struct linear : Base {
  static constexpr NormalLaw normal = NormalLaw::linear;
  static constexpr double normal_stiffness = 1e6, tangential_stiffness = 5e5;
};
template <class Base>
struct critical : linear<Base> {
  static constexpr Damping damping = Damping::critical;
  static constexpr double normal_stiffness = 2e5, tangential_stiffness = 1.3e5;
};

using enum TangentialLaw;
using enum Slider;
using enum Integrator;

TEST_CASE("agreement: two sizes at rest") {
  enter({periodic::name, seed()});
  const Events events = check_after<periodic>(random_spheres<periodic>(0.2, Random(seed())), 200000, "two sizes, bed");
  const Observation seen = kernel<periodic>().observe();
  double mass = 0;
  for (int i = 0; i < periodic::particle_count; ++i) mass += mass_of<periodic>(i);
  CHECK(seen.kinetic_translation < mass / 2 * 1e-4);  // root mean square speed below 1 cm/s
  CHECK(events.compared > periodic::particle_count);
  CHECK(events.sticking > events.sliding);
}

TEST_CASE("agreement: two sizes, euler") {
  check_sizes<periodic>("two sizes");
  check_sizes<with<closed, displacement, paper, euler>>("two sizes, paper, closed");
  check_sizes<with<periodic, rescale, exact, euler>>("two sizes, rescale, exact");
  check_sizes<sized<mixed_order, closed_pipe>>("two sizes, three densities, mixed order, closed");
}

TEST_CASE("agreement: two sizes, leapfrog") {
  check_sizes<with<periodic, force, clip, leapfrog>>("two sizes, leapfrog, force");
  check_sizes<elastic_limit<with<closed, rescale, exact, leapfrog>>>("two sizes, leapfrog, rescale, exact, closed");
}

TEST_CASE("agreement: two sizes, impulse") {
  check_sizes<with<closed, displacement, exact, impulse>>("two sizes, impulse, exact, closed");
  check_sizes<elastic_limit<with<periodic, force, clip, impulse>>>("two sizes, impulse, force, elastic limit");
  check_sizes<own_walls<with<closed, rescale, exact, impulse>>>("two sizes, impulse, rescale, own walls, closed");
}

TEST_CASE("agreement: two sizes with the linear law, and without friction") {
  check_sizes<linear<periodic>>("two sizes, linear");
  check_sizes<critical<with<closed, force, clip, leapfrog>>>("two sizes, linear, critical, leapfrog, force, closed");
  check_sizes<linear<with<periodic, rescale, clip, impulse>>>("two sizes, linear, impulse, rescale");
  check_sizes<smooth<closed>>("two sizes, frictionless, closed");
}

TEST_CASE("agreement: diameters as 10 to 5 to 2, and a distribution") {
  check_sizes<sized<three_sizes, narrow_pipe>>("three sizes", 10000);
  check_sizes<with<sized<three_sizes, narrow_pipe>, displacement, exact, impulse>>("three sizes, impulse", 10000);
  check_sizes<sized<many_sizes, short_pipe>>("many sizes");
}

}  // namespace
}  // namespace fixdem::tests
