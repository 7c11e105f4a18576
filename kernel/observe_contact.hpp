// One contact as it is now, with its forces.
//
// Recomputed from positions by the formulas of contact_law.hpp, one lane wide, with a copy of the history that is not
// advanced: forces are those of the spring as it stands and the damping of the present velocities. With the leapfrog
// all is seen at the held positions of the forces; with impulses histories are shown at the time that particle() shows.
#pragma once

#include "kept_history.hpp"

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
  double rolling_force[3];     ///< q, N, on the owner: torque R* n x q; zero without rolling resistance
  double rolling_history[3];   ///< as history
};

namespace detail {

template <class Case>
struct Observed {
  Contact contact;
  double elastic;  ///< J, normal and tangential
  double elastic_tangential;
};

/// With impulses springs are shown half a step on, at the time that particle() shows and that a start takes.
template <class Law, class Case>
bool is_ahead(const HistoryNumbers<const Real<Case>>& kept) {
  if constexpr (takes_impulses<Case>) return kept[Law::state_function_place] > 0;
  return false;
}

/// A spring and its dashpot, capped at the limit (scaled), and what the spring holds. `velocity`: of slip or rolling;
/// `ahead`: s.
template <class Law, class Case>
void observe_spring(const Vec3<double>& spring, const Vec3<double>& velocity, double stiffness, double eta,
                    double ahead, double limit, double (&force)[3], double (&history)[3], Observed<Case>& seen) {
  constexpr bool keeps_displacement = Case::tangential == TangentialLaw::displacement;
  constexpr double to_newton = 1 / Law::scale, unit = keeps_displacement ? 1 : to_newton;
  Vec3<double> total = add_scaled(scale(-eta, velocity), keeps_displacement ? -stiffness : -1, spring);
  total = scale(to_newton, capped(total, dot(total, total), limit));
  force[0] = total.x, force[1] = total.y, force[2] = total.z;
  Vec3<double> shown = spring;
  if (ahead > 0) shown = add_scaled(spring, ahead * (keeps_displacement ? 1 : stiffness), velocity);
  history[0] = unit * shown.x, history[1] = unit * shown.y, history[2] = unit * shown.z;
  const double square = dot(spring, spring);
  const double energy = 0.5 * to_newton * (keeps_displacement ? stiffness * square : square / stiffness);
  seen.elastic_tangential += energy;
  seen.elastic += energy;
}

/// One contact from its geometry and relative motion.
template <class Case, bool is_wall>
Observed<Case> observe_contact(int owner, int partner, double overlap, const Vec3<double>& n,
                               const Motion<double>& motion, const HistoryNumbers<const Real<Case>>& kept) {
  using Law = ContactLaw<Case, is_wall>;
  constexpr double to_newton = 1 / Law::scale;
  const ContactBodies<Law, Case, double> bodies(motion);
  const Springs<double> k = springs<Law, Case>(spring_base<Law, Case>(overlap, bodies), bodies);
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
    double eta = k.damping;
    if constexpr (Law::tangential_damping != Law::damping) eta *= Law::tangential_damping / Law::damping;
    const double ahead = is_ahead<Law, Case>(kept) ? 0.5 * Case::time_step : 0;
    const Vec3<double> slip = add_scaled(surface, -normal_velocity, n);
    observe_spring<Law, Case>({kept[0], kept[1], kept[2]}, slip, k.tangential_stiffness, eta, ahead,
                              friction_limit<Law, Case>(c.normal_force / to_newton, k.repulsion), c.tangential_force,
                              c.history, seen);
    if constexpr (Law::has_rolling) {
      constexpr int at = Law::rolling_place;
      observe_spring<Law, Case>({kept[at], kept[at + 1], kept[at + 2]}, cross(n, motion.rolling),
                                k.tangential_stiffness, eta, ahead, Law::rolling_friction * k.repulsion,
                                c.rolling_force, c.rolling_history, seen);
    }
  }
  return seen;
}

/// Of one particle: also its motion relative to a wall.
template <class Case>
Motion<double> motion_of(const Particles<Case>& p, int i) {
  Motion<double> m{{p.motion[i][0], p.motion[i][1], p.motion[i][2]}, {}};
  if constexpr (Derived<Case>::has_rotation) m.spin = {p.motion[i][4], p.motion[i][5], p.motion[i][6]};
  m.rolling = scale(-1.0, m.spin);
  if constexpr (has_sizes<Case>) {
    m.inverse_mass = m.owner_inverse_mass = p.motion[i][3];
    m.inverse_radius = m.owner_inverse_radius = p.motion[i][7];
  }
  return m;
}

/// Relative motion of two particles (rows.hpp).
template <class Case>
Motion<double> motion_of_pair(const Particles<Case>& p, int i, int j) {
  const Motion<double> a = motion_of(p, i), b = motion_of(p, j);
  Motion<double> m = a;  // the owner's own values stay
  m.velocity = {a.velocity.x - b.velocity.x, a.velocity.y - b.velocity.y, a.velocity.z - b.velocity.z};
  m.spin = {a.spin.x + b.spin.x, a.spin.y + b.spin.y, a.spin.z + b.spin.z};
  m.inverse_mass += b.inverse_mass, m.inverse_radius += b.inverse_radius;
  const double own = has_sizes<Case> ? a.inverse_radius / m.inverse_radius : 0.5;
  m.rolling = subtract_scaled(scale(1 - own, b.spin), own, a.spin);
  return m;
}

/// Visits the contacts with overlap of a range of pairs: f(Observed).
template <class Case, class F>
void for_each_observed_pair_in(const Contacts<Case>& contacts, const Particles<Case>& p, int range, F&& f) {
  for_each_near_pair_in(contacts, range, [&](int, int k, int i, int j) {
    Vec3<double> r = {p.position[j][0] - p.position[i][0], p.position[j][1] - p.position[i][1],
                      p.position[j][2] - p.position[i][2]};
    if constexpr (Derived<Case>::is_periodic)
      if (range == Capacity<Case>::chunks) r.z -= Case::pipe_length;
    const double distance = sqrt(dot(r, r));
    const double overlap = radius_at<Case>(p.position[i]) + radius_at<Case>(p.position[j]) - distance;
    if (!(overlap > 0)) return;
    f(observe_contact<Case, false>(p.id[i], p.id[j], overlap, scale(1 / distance, r), motion_of_pair(p, i, j),
                                   contacts.pairs.history_of(range, k)));
  });
}

/// Those with the walls of one kind of a chunk.
template <class Case, class Walls, class F>
void for_each_observed_wall_in(const Walls& walls, const Particles<Case>& p, int chunk, F&& f) {
  for_each_near_wall_in<Case>(walls, chunk, [&](int, int k, int i) {
    Vec3<double> n;
    const double overlap = walls.surface.overlap(p.position[i], n);
    if (!(overlap > 0)) return;
    f(observe_contact<Case, true>(p.id[i], walls.surface.partner(n), overlap, n, motion_of(p, i),
                                  walls.history_of(chunk, k)));
  });
}

/// Visits every contact with overlap: f(Observed).
template <class Case, class F>
void for_each_observed(const Contacts<Case>& contacts, const Particles<Case>& p, F&& f) {
  for (int range = 0; range < PairBatches<Case>::ranges; ++range) for_each_observed_pair_in(contacts, p, range, f);
  for_each_wall(contacts, [&](const auto& walls) {
    for (int chunk = 0; chunk < Capacity<Case>::chunks; ++chunk) for_each_observed_wall_in(walls, p, chunk, f);
  });
}

}  // namespace detail

}  // namespace fixdem
