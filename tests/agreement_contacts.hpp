// Contacts of the kernel against those of the reference: what happens to them, and what their springs are in the end.
//
// The kernel shows a contact as it stands: springs as kept by the last step (with impulses grown for half a step more,
// to the time shown), dashpots of the present velocities, at the places of the forces. The reference keeps the springs
// of the last step; the rest is made from them here, by its formulas.
#pragma once

#include <algorithm>
#include <map>
#include <utility>

#include "reference/reference.hpp"
#include "scenes.hpp"

namespace fixdem::tests {

/// What happened to the contacts meanwhile: a comparison is worth little where nothing began, ended, slid or stuck, or
/// was held by rolling resistance or rolled on against it. `compared`: contacts whose springs were compared.
struct Events {
  int begun = 0, ended = 0, sliding = 0, sticking = 0, rolling = 0, held = 0, compared = 0;
};

/// Partners below zero are walls.
template <class Case>
auto coefficients_of(const reference::Reference<Case>& program, int owner, int partner) {
  return reference::contact_coefficients<Case, double>(program.kind(owner),
                                                       partner < 0 ? partner : program.kind(partner));
}

/// `c`: of the reference.
template <class Case>
void count_contact(const reference::Reference<Case>& program, const reference::Contact& c, Events& events) {
  const auto k = coefficients_of(program, c.owner, c.partner);
  const double elastic = k.normal_stiffness * std::pow(c.overlap, Case::normal == NormalLaw::hertz ? 1.5 : 1);
  const double limit =
      k.friction * (reference::friction_is_limited_by_elastic_force<Case>() ? elastic : std::abs(c.normal_force));
  (length(c.tangential_force) > limit * (1 - 1e-9) ? events.sliding : events.sticking) += 1;
  const double most = k.rolling_friction * elastic;
  if (most > 0) (length(c.rolling_force) > most * (1 - 1e-9) ? events.rolling : events.held) += 1;
}

/// A contact as it stands, in the reference.
template <class Case>
struct StandingContact {
  using Vector = reference::Vector<double>;
  double overlap;
  Vector n, slip, rolling;  ///< m/s

  StandingContact(const reference::Reference<Case>& program, int owner, int partner) {
    const bool is_pair = partner >= 0;
    const Body a(program.particle(owner)), b = is_pair ? Body(program.particle(partner)) : Body();
    const auto bodies =
        reference::bodies_of_contact<Case, double>(program.kind(owner), is_pair ? program.kind(partner) : partner);
    const double radius = bodies.i.radius, other_radius = bodies.j.radius;
    if (is_pair) {
      const Vector between(b.x[0] - a.x[0], b.x[1] - a.x[1], axial_difference<Case>(b.x[2], a.x[2]));
      overlap = radius + other_radius - between.norm(), n = between.normalized();
    } else if (partner == reference::pipe_wall) {
      const Vector across(a.x[0], a.x[1], 0);
      overlap = across.norm() - (Case::pipe_diameter / 2 - radius), n = across.normalized();
    } else {
      const bool is_lower = partner == reference::lower_end;
      overlap = is_lower ? radius - a.x[2] : a.x[2] - (Case::pipe_length - radius);
      n = Vector(0, 0, is_lower ? -1 : 1);
    }
    const Vector v = a.v - b.v;
    slip = v - v.dot(n) * n + (radius * a.w + other_radius * b.w).cross(n);
    rolling = bodies.reduced_radius * (a.w - b.w).cross(n);
  }

 private:
  struct Body {
    Vector x = Vector::Zero(), v = Vector::Zero(), w = Vector::Zero();
    Body() = default;
    explicit Body(const reference::Particle& p)
        : x(p.position[0], p.position[1], p.position[2]),
          v(p.velocity[0], p.velocity[1], p.velocity[2]),
          w(p.angular_velocity[0], p.angular_velocity[1], p.angular_velocity[2]) {
      if (Case::integrator != Integrator::euler) x += v * Case::time_step / 2;  // where forces are taken
    }
  };
};

/// The maximum difference of springs and rolling forces, in diameters (of the largest): forces over k_t at an overlap
/// of 0.001 d.
template <class Case, class Kernel>
double difference_of_contacts(const Kernel& fast, const reference::Reference<Case>& slow, Events& events) {
  using Vector = reference::Vector<double>;
  constexpr bool keeps_displacement = Case::tangential == TangentialLaw::displacement;
  constexpr double d = largest_diameter<Case>;
  std::map<std::pair<int, int>, reference::Contact> kept;
  slow.for_each_contact([&](const reference::Contact& c) { kept[{c.owner, c.partner}] = c; });
  double maximum = 0;
  fast.for_each_contact([&](const auto& c) {
    const bool is_pair = c.partner >= 0, is_swapped = is_pair && c.partner < c.owner;
    const int owner = is_swapped ? c.partner : c.owner, partner = is_swapped ? c.owner : c.partner;
    const double sign = is_swapped ? -1 : 1;  // of what slides; what rolls is the same from either side
    const auto k = coefficients_of(slow, owner, partner);
    const StandingContact<Case> now(slow, owner, partner);
    const auto found = kept.find({owner, partner});
    Vector sliding = Vector::Zero(), rolling = Vector::Zero();
    if (found != kept.end()) sliding = Vector(found->second.history), rolling = Vector(found->second.rolling_history);

    const bool is_hertz = Case::normal == NormalLaw::hertz;
    const double stiffness = k.tangential_stiffness * (is_hertz ? std::sqrt(std::max(now.overlap, 0.0)) : 1);
    const double eta = k.tangential_damping * (is_hertz ? std::pow(std::max(now.overlap, 0.0), 0.25) : 1);
    const double elastic = k.normal_stiffness * std::pow(std::max(now.overlap, 0.0), is_hertz ? 1.5 : 1);
    const Vector force = reference::no_longer_than<double>(
        -(keeps_displacement ? stiffness : 1) * rolling - eta * now.rolling, k.rolling_friction * elastic);
    if (Case::integrator == Integrator::impulse && found != kept.end()) {
      const double growth = Case::time_step / 2 * (keeps_displacement ? 1 : stiffness);
      sliding += growth * now.slip, rolling += growth * now.rolling;
    }
    if (k.friction == 0) sliding = Vector::Zero();
    if (k.rolling_friction == 0) rolling = Vector::Zero();

    const double newton = k.tangential_stiffness * (is_hertz ? std::sqrt(1e-3 * d) : 1) * d;
    const double unit = keeps_displacement ? d : newton;
    const double differences[] = {(sign * Vector(c.history) - sliding).norm() / unit,
                                  (Vector(c.rolling_history) - rolling).norm() / unit,
                                  (Vector(c.rolling_force) - force).norm() / newton};
    for (const double difference : differences) {
      CHECK(std::isfinite(difference));
      maximum = std::max(maximum, difference);
    }
    ++events.compared;
  });
  return maximum;
}

}  // namespace fixdem::tests
