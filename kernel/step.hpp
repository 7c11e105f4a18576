// The order of one time step.
//
// Contact rows from the present positions, chunk after chunk along the pipe; each chunk then sums its rows and moves.
// A chunk may move before the next one computes its contacts: no contact of a later chunk looks back. The step ends
// with the checks, and a fault is final: the state is that after the faulty step, for the report.
#pragma once

#include "floaters.hpp"
#include "motion.hpp"
#include "renewal.hpp"
#include "wall_contacts.hpp"

namespace fixdem {

/// A particle that travels further than this in one step, in radii, could pass through another one unseen.
inline constexpr double greatest_way_per_step = 0.5;

template <class Case>
struct State {
  Particles<Case> particles;
  Contacts<Case> contacts;
  NearList<Case> near_list;
  [[no_unique_address]] KeptHistory<Case> kept;
  [[no_unique_address]] GasSlices<Case> gas;
  Watch watch;
  Status status;
  long long step;
};

namespace detail {

/// First particle whose own values show what the sums over all revealed.
template <class Case>
Status find_culprit(const State<Case>& s, Fault fault, double limit) {
  const auto& p = s.particles;
  Status worst{fault, s.step, -1, 0, limit};
  for (int i = 0; i < Case::particle_count; ++i) {
    const double* v = p.motion[i];
    double square = 0;
    for (int c = 0; c < Particles<Case>::motion_width; ++c) square += v[c] * v[c];
    if (fault == Fault::non_finite) {
      if (!(square - square == 0)) return {fault, s.step, p.id[i], square, limit};
      continue;
    }
    const double way = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) * Case::time_step / Derived<Case>::radius;
    if (worst.particle < 0 || way > worst.value) worst.particle = p.id[i], worst.value = way;
  }
  return worst;
}

}  // namespace detail

/// Checks after a step: finite, not too fast, not too deep. The overlap is that at the beginning of the step; whose it
/// is is left to be named by the caller (observe.hpp).
template <class Case>
Status check_step(const State<Case>& s) {
  const double radius = Derived<Case>::radius;
  const double overlap = s.watch.greatest_overlap() / radius;
  if (!(overlap <= Case::max_overlap)) return {Fault::overlap, s.step, -1, overlap, Case::max_overlap};
  const double sum = Watch::sum(s.watch.square_sum);
  if (!(sum - sum == 0)) return detail::find_culprit(s, Fault::non_finite, 0);
  if (s.watch.speed_bound() * Case::time_step > greatest_way_per_step * radius) {
    const Status fastest = detail::find_culprit(s, Fault::too_fast, greatest_way_per_step);
    if (fastest.value > greatest_way_per_step) return fastest;
  }
  return {};
}

/// One time step. `W`: lanes per register.
template <class Case, int W>
void step(State<Case>& s) {
  using Cap = Capacity<Case>;
  if (s.near_list.expired())
    s.status = renew<Case, W>(s.contacts, s.near_list, s.particles, s.kept, s.watch.speed_bound(), 1);
  if constexpr (Case::has_gas) {
    if (s.status.ok() && s.step % Case::gas_floater_interval == 0) find_floaters(s.gas, s.particles, s.contacts);
    if (s.status.ok() && s.step % Case::gas_update_interval == 0) s.status = update_slices<Case, W>(s.gas, s.particles);
  }
  if (!s.status.ok()) {
    s.status.step = s.step;
    return;
  }

  s.watch.begin_step();
  const auto pairs = [&](int range, int row) {
    if (s.contacts.pairs.sparse[range])
      pair_contacts<Case, W, true>(s.contacts, s.particles, range, row, s.watch);
    else
      pair_contacts<Case, W, false>(s.contacts, s.particles, range, row, s.watch);
  };
  if constexpr (Derived<Case>::is_periodic) pairs(Cap::chunks, Rows<Case>::wrap_first);
  for (int chunk = 0; chunk < Cap::chunks; ++chunk) {
    int row = Rows<Case>::first(chunk);
    pairs(chunk, row);
    row += 8 * (s.contacts.pairs.first[chunk + 1] - s.contacts.pairs.first[chunk]);
    if constexpr (Case::has_wall) {
      wall_contacts<Case, W, PipeSurface<Case>>(s.contacts.pipe, s.particles, s.contacts.rows, chunk, row, s.watch);
      row += 8 * (s.contacts.pipe.first[chunk + 1] - s.contacts.pipe.first[chunk]);
    }
    if constexpr (Derived<Case>::has_ends)
      wall_contacts<Case, W, EndSurfaces<Case>>(s.contacts.ends, s.particles, s.contacts.rows, chunk, row, s.watch);
    move<Case, W>(s.contacts, s.particles, chunk, s.watch);
  }
  ++s.step;
  s.near_list.spend(s.watch.speed_bound() * Case::time_step);
  s.status = check_step(s);
}

}  // namespace fixdem
