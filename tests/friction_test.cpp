// Coulomb's bound, |f_t| <= mu |f_n| in every contact and step, for every form of the spring and both sliders.
//
// Forces are read off the motion: of a sphere with a single contact, force times step over mass is its change of
// velocity, and torque is what its spin changes by. The kernel's own report of forces is not asked.
#include <cmath>

#include "impact_scene.hpp"

namespace fixdem::tests {
namespace {

template <TangentialLaw form, Slider kind, Integrator scheme>
struct scene : impact_scene {
  static constexpr TangentialLaw tangential = form;
  static constexpr Slider slider = kind;
  static constexpr Integrator integrator = scheme;
};

struct Count {
  int sliding = 0, sticking = 0;
};

/// `n`: normal, `dv`: change of velocity, `dw`: change of spin in one step. A velocity of 4 m/s is a multiple of 9e-16
/// m/s, so a change is known to 2e-15 and its tangential part to a few times that.
template <class Case>
void check_bound(const double n[3], const double dv[3], const double dw[3], Count& count) {
  constexpr double rounding = 2e-14;  // m/s
  const double normal = dot(dv, n);
  double tangential[3], torque[3];
  for (int c = 0; c < 3; ++c) tangential[c] = dv[c] - normal * n[c];
  if (length(dv) < rounding) return;
  const double limit = Case::friction * std::abs(normal);
  CHECK(length(tangential) <= limit * (1 + 1e-9) + rounding);
  if (limit > 1e6 * rounding) (length(tangential) > limit * (1 - 1e-6) ? count.sliding : count.sticking) += 1;
  // Eq. (14): I dw = r n x f_t dt, or r dw (2/5) = n x dv.
  const double arm[3] = {n[1] * dv[2] - n[2] * dv[1], n[2] * dv[0] - n[0] * dv[2], n[0] * dv[1] - n[1] * dv[0]};
  for (int c = 0; c < 3; ++c) torque[c] = 0.4 * Case::diameter / 2 * dw[c] - arm[c];
  CHECK(length(torque) <= 1e-9 * limit + rounding);
}

template <class Case>
void check_friction() {
  enter({Case::name, seed()});
  static Simulation<Case> simulation;
  place_all(simulation, oblique_impacts<Case>(Random(seed())));
  start(simulation);
  Count walls, pairs;
  Spheres before = all_particles(simulation, Case::particle_count);
  for (int n = 0; n < 2500; ++n) {
    run(simulation, 1);
    const Spheres now = all_particles(simulation, Case::particle_count);
    for (int i = 0; i < Case::particle_count; i += i < wall_impacts ? 1 : 2) {
      double normal[3] = {0, 0, -1}, dv[3], dw[3];
      for (int c = 0; c < 3; ++c) {
        dv[c] = now[i].velocity[c] - before[i].velocity[c];
        dw[c] = now[i].angular_velocity[c] - before[i].angular_velocity[c];
      }
      if (i >= wall_impacts) {
        double half_step = 0;  // the leapfrog's forces belong to places half a step ahead
        if (holds_positions_ahead<Case>) half_step = Case::time_step / 2;
        for (int c = 0; c < 3; ++c) {
          normal[c] = before[i + 1].position[c] - before[i].position[c] +
                      half_step * (before[i + 1].velocity[c] - before[i].velocity[c]);
        }
        const double distance = length(normal);
        for (double& component : normal) component /= distance;
      }
      check_bound<Case>(normal, dv, dw, i < wall_impacts ? walls : pairs);
    }
    before = now;
  }
  for (const Count& count : {walls, pairs}) {
    CHECK(count.sliding > 300);
    CHECK(count.sticking > 300);
  }
}

TEST_CASE("friction: never beyond Coulomb's bound") {
  check_friction<scene<TangentialLaw::displacement, Slider::clip, Integrator::euler>>();
  check_friction<scene<TangentialLaw::displacement, Slider::paper, Integrator::leapfrog>>();
  check_friction<scene<TangentialLaw::force, Slider::clip, Integrator::leapfrog>>();
  check_friction<scene<TangentialLaw::force, Slider::paper, Integrator::euler>>();
  check_friction<scene<TangentialLaw::rescale, Slider::clip, Integrator::euler>>();
  check_friction<scene<TangentialLaw::rescale, Slider::paper, Integrator::euler>>();
  check_friction<scene<TangentialLaw::displacement, Slider::exact, Integrator::impulse>>();
}

}  // namespace
}  // namespace fixdem::tests
