// Looking at a state: every contact with its forces, and the figures of a log line.
//
// Nothing here is called in a step. Contacts are recomputed from positions by the formulas of contact_law.hpp, one lane
// wide, with a copy of the history that is not advanced: forces are those of the spring as it stands and the damping of
// the present velocities. With the leapfrog all is seen at the held positions of the forces; particle() synchronises,
// and so does the history of a contact with impulses.
#pragma once

#include "tiles.hpp"

namespace fixdem {

/// One contact, seen from its owner.
struct Contact {
  int owner;                   ///< input number
  int partner;                 ///< input number, or pipe_wall, start_end, far_end
  double overlap;              ///< m
  double normal[3];            ///< unit vector, owner to partner
  double normal_force;         ///< N, positive when repelling (-f_n of eq. 6)
  double tangential_force[3];  ///< N, on the owner
  double history[3];           ///< m, or N with the incremental forms
};

struct Observation {
  double kinetic_translation, kinetic_rotation;  ///< J
  int contacts, wall_contacts;
  double coordination_number;  ///< (2 pair contacts + wall contacts) / particles
  double max_overlap;          ///< m
  double max_speed;            ///< m/s
  double mean_axial_velocity;  ///< m/s
  double mean_height;          ///< of the centres above the pipe's bottom, m
};

/// Works are since the start; joules.
struct Energy {
  double kinetic, elastic, dissipated_damping, dissipated_sliding, gravity_work, gas_work;
  double elastic_tangential;  ///< the part of `elastic` that tangential springs hold
  double made_by_law;         ///< by the tangential law, whose stiffness follows the overlap; below zero: lost
};

namespace detail {

template <class Case>
struct Observed {
  Contact contact;
  double elastic;  ///< J, normal and tangential
  double elastic_tangential;
};

/// One contact from its geometry and relative motion.
template <class Case, bool is_wall>
Observed<Case> observe_contact(int owner, int partner, double overlap, const Vec3<double>& n,
                               const Motion<double>& motion, const HistoryNumbers<const Real<Case>>& kept) {
  using Law = ContactLaw<Case, is_wall>;
  constexpr double to_newton = 1 / Law::scale;
  const Springs<double> k = springs<Law, Case>(spring_base<Law, Case>(overlap));
  const Vec3<double> surface = add_cross(motion.velocity, motion.spin, n);
  const double normal_velocity = dot(motion.velocity, n);
  Observed<Case> seen{};
  Contact& c = seen.contact;
  c.owner = owner, c.partner = partner, c.overlap = overlap;
  c.normal[0] = n.x, c.normal[1] = n.y, c.normal[2] = n.z;
  c.normal_force = to_newton * fused(k.damping, normal_velocity, k.repulsion);
  constexpr double share = Derived<Case>::is_hertz ? 0.4 : 0.5;  // 2/5 K overlap^(5/2), or K overlap^2 / 2
  seen.elastic = to_newton * share * k.repulsion * overlap;
  if constexpr (Law::has_friction) {
    constexpr bool keeps_displacement = Case::tangential == TangentialLaw::displacement;
    const Vec3<double> spring = {kept[0], kept[1], kept[2]};
    const double to_force = keeps_displacement ? k.tangential_stiffness : 1;
    const Vec3<double> slip = add_scaled(surface, -normal_velocity, n);
    double eta = k.damping;
    if constexpr (Law::tangential_damping != Law::damping) eta *= Law::tangential_damping / Law::damping;
    Vec3<double> force = add_scaled(scale(-eta, slip), -to_force, spring);
    force = capped(force, dot(force, force), friction_limit<Law, Case>(c.normal_force / to_newton, k.repulsion));
    c.tangential_force[0] = to_newton * force.x;
    c.tangential_force[1] = to_newton * force.y;
    c.tangential_force[2] = to_newton * force.z;
    const double unit = keeps_displacement ? 1 : to_newton;
    Vec3<double> shown = spring;
    if constexpr (takes_impulses<Case>)  // half a step on, to the time that particle() shows and that a start takes
      if (kept[Law::state_function_place] > 0)
        shown = add_scaled(spring, 0.5 * Case::time_step * (keeps_displacement ? 1 : k.tangential_stiffness), slip);
    c.history[0] = unit * shown.x, c.history[1] = unit * shown.y, c.history[2] = unit * shown.z;
    const double square = dot(spring, spring);
    seen.elastic_tangential =
        0.5 * to_newton * (keeps_displacement ? k.tangential_stiffness * square : square / k.tangential_stiffness);
    seen.elastic += seen.elastic_tangential;
  }
  return seen;
}

template <class Case>
Motion<double> motion_of(const Particles<Case>& p, int i) {
  Motion<double> m{{p.motion[i][0], p.motion[i][1], p.motion[i][2]}, {}};
  if constexpr (Derived<Case>::has_rotation) m.spin = {p.motion[i][4], p.motion[i][5], p.motion[i][6]};
  return m;
}

/// Visits every contact with overlap: f(Observed).
template <class Case, class F>
void for_each_observed(const State<Case>& s, F&& f) {
  const Particles<Case>& p = s.particles;
  const Contacts<Case>& contacts = s.contacts;
  for_each_near_pair(contacts, [&](int range, int k, int i, int j) {
    Vec3<double> r = {p.position[j][0] - p.position[i][0], p.position[j][1] - p.position[i][1],
                      p.position[j][2] - p.position[i][2]};
    if constexpr (Derived<Case>::is_periodic)
      if (range == Capacity<Case>::chunks) r.z -= Case::pipe_length;
    const double distance = sqrt(dot(r, r));
    const double overlap = Case::diameter - distance;
    if (!(overlap > 0)) return;
    const Motion<double> a = motion_of(p, i), b = motion_of(p, j);
    const Motion<double> m = {{a.velocity.x - b.velocity.x, a.velocity.y - b.velocity.y, a.velocity.z - b.velocity.z},
                              {a.spin.x + b.spin.x, a.spin.y + b.spin.y, a.spin.z + b.spin.z}};
    f(observe_contact<Case, false>(p.id[i], p.id[j], overlap, scale(1 / distance, r), m,
                                   contacts.pairs.history_of(range, k)));
  });
  for_each_wall(contacts, [&](const auto& walls) {
    for_each_near_wall<Case>(walls, [&](int chunk, int k, int i) {
      Vec3<double> n;
      const double overlap = walls.surface.overlap(p.position[i], n);
      if (!(overlap > 0)) return;
      f(observe_contact<Case, true>(p.id[i], walls.surface.partner(n), overlap, n, motion_of(p, i),
                                    walls.history_of(chunk, k)));
    });
  });
}

template <class Case>
Vec3<double> force_on(const State<Case>& s, int wall) {
  Vec3<double> sum{};
  for_each_observed(s, [&](const Observed<Case>& o) {
    const Contact& c = o.contact;
    if (c.partner != wall) return;
    sum.x += c.normal_force * c.normal[0] - c.tangential_force[0];
    sum.y += c.normal_force * c.normal[1] - c.tangential_force[1];
    sum.z += c.normal_force * c.normal[2] - c.tangential_force[2];
  });
  return sum;
}

}  // namespace detail

template <class Case>
Observation observe(const State<Case>& s) {
  using D = Derived<Case>;
  Observation seen{};
  for (int i = 0; i < Case::particle_count; ++i) {
    const Motion<double> m = detail::motion_of(s.particles, i);
    const double square = dot(m.velocity, m.velocity);
    seen.kinetic_translation += 0.5 * D::mass * square;
    seen.kinetic_rotation += 0.5 * 0.4 * D::mass * dot(m.spin, m.spin);
    seen.max_speed = max(sqrt(square), seen.max_speed);
    seen.mean_axial_velocity += m.velocity.z / Case::particle_count;
    seen.mean_height += (s.particles.position[i][1] + D::pipe_radius) / Case::particle_count;
  }
  detail::for_each_observed(s, [&](const detail::Observed<Case>& o) {
    ++(o.contact.partner >= 0 ? seen.contacts : seen.wall_contacts);
    seen.max_overlap = max(o.contact.overlap, seen.max_overlap);
  });
  seen.coordination_number = (2.0 * seen.contacts + seen.wall_contacts) / Case::particle_count;
  return seen;
}

}  // namespace fixdem
