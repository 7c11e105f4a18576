// Looking at a state: the figures of a log line.
//
// Nothing here is called in a step. How contacts are seen: observe_contact.hpp.
#pragma once

#include "tiles.hpp"

namespace fixdem {

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
  double elastic_tangential;  ///< the part of `elastic` that tangential and rolling springs hold
  double made_by_law;         ///< by the tangential law, whose stiffness follows the overlap; below zero: lost
  double dissipated_rolling;  ///< by dashpot and slider of rolling resistance
  double entered;             ///< with particles that were fed: kinetic
  double left_with;           ///< particles that left: kinetic, and elastic of the contacts that were cut
};

namespace detail {

template <class Case>
Vec3<double> force_on(const State<Case>& s, int wall) {
  Vec3<double> sum{};
  for_each_observed(s.contacts, s.particles, [&](const Observed<Case>& o) {
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
LineTotals line_totals(const State<Case>& s) {
  const Passage &entered = s.line.entered, left = s.line.all_left();
  const long long at_start = Case::start_count;
  return {at_start,
          entered.count,
          left.count,
          at_start + entered.count - left.count,
          s.line.asked,
          entered.mass,
          left.mass,
          s.line.backlog(),
          static_cast<double>(s.line.blocked_events * Case::feed_interval) * Case::time_step};
}

template <class Case>
Observation observe(const State<Case>& s) {
  using D = Derived<Case>;
  Observation seen{};
  int present = Case::particle_count;
  if constexpr (is_line<Case>) present = line_totals(s).present > 0 ? static_cast<int>(line_totals(s).present) : 1;
  for (int i = 0; i < s.particles.rows(); ++i) {
    if (!s.particles.is_present(i)) continue;
    const Motion<double> m = detail::motion_of(s.particles, i);
    const double square = dot(m.velocity, m.velocity);
    const double mass = D::reference_mass * share_of_mass(s.particles, i);
    seen.kinetic_translation += 0.5 * mass * square;
    seen.kinetic_rotation += 0.5 * 0.4 * mass * dot(m.spin, m.spin);
    seen.max_speed = max(sqrt(square), seen.max_speed);
    seen.mean_axial_velocity += m.velocity.z / present;
    seen.mean_height += (height_of<Case>(s.particles.position[i]) + D::pipe_radius) / present;
  }
  detail::for_each_observed(s.contacts, s.particles, [&](const detail::Observed<Case>& o) {
    ++(o.contact.partner >= 0 ? seen.contacts : seen.wall_contacts);
    seen.max_overlap = max(o.contact.overlap, seen.max_overlap);
  });
  seen.coordination_number = (2.0 * seen.contacts + seen.wall_contacts) / present;
  return seen;
}

/// All but the work of gravity, which needs the places at the start.
template <class Case>
Energy energy_without_gravity(const State<Case>& s) {
  using D = Derived<Case>;
  const Observation o = observe(s);
  Energy e{};
  e.kinetic = o.kinetic_translation + o.kinetic_rotation;
  detail::for_each_observed(s.contacts, s.particles, [&](const detail::Observed<Case>& seen) {
    e.elastic += seen.elastic;
    e.elastic_tangential += seen.elastic_tangential;
  });
  if constexpr (Case::energy_ledger) {
    for (const StepMonitor<Case>& monitor : s.monitor) {
      const auto work = [&](LedgerEntry entry) {
        return D::reference_mass / Case::time_step * sum_of(monitor.ledger.entry[entry]);
      };
      e.dissipated_damping += D::reference_mass * sum_of(monitor.ledger.entry[damping_power]);
      e.dissipated_sliding += work(sliding_work);
      e.made_by_law += work(law_work);
      if constexpr (D::has_rolling) e.dissipated_rolling += work(rolling_work);
      e.gas_work += D::reference_mass * sum_of(monitor.ledger.gas_work);
    }
  }
  return e;
}

}  // namespace fixdem
