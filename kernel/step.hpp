// The order of one time step.
//
// Contact rows from the present positions, chunk after chunk along the pipe; each chunk then sums its rows and moves.
// A chunk may move before the next one computes its contacts: no contact of a later chunk looks back. A range whose
// near list no longer holds is listed anew just before. Every chunk ends its step with the checks; the first fault, by
// step and then along the pipe, is final: the state is that after the faulty step, for the report.
#pragma once

#include "floaters.hpp"
#include "motion.hpp"
#include "pair_contacts.hpp"
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
  ListingScratch<Case> scratch;
  [[no_unique_address]] KeptHistory<Case> kept;
  [[no_unique_address]] GasSlices<Case> gas;
  Watch<Case> watch[NearList<Case>::ranges];
  Status status;
  long long step;
  double deepest;                ///< overlap since the start, m
  long long histories_given_at;  ///< step at which they came from outside: they may lie across the plane of contact
};

namespace detail {

/// Keeps the earliest fault; `step`: steps completed, the faulty one included, at which it would have stopped the run.
template <class Case>
void note(State<Case>& s, Status fault, long long step) {
  fault.step = step;
  if (!fault.ok() && (s.status.ok() || step < s.status.step)) s.status = fault;
}

/// First particle of a chunk whose own values show what the sums over all revealed.
template <class Case>
Status find_culprit(const State<Case>& s, int chunk, Fault fault, double limit) {
  const auto& p = s.particles;
  Status worst{fault, -1, 0, 0, limit};
  const int base = chunk * Capacity<Case>::chunk_size;
  for (int i = base; i < base + particles_in<Case>(chunk); ++i) {
    const double* v = p.motion[i];
    double square = 0;
    for (int c = 0; c < Particles<Case>::motion_width; ++c) square += v[c] * v[c];
    if (fault == Fault::non_finite) {
      if (!(square - square == 0)) return {fault, p.id[i], 0, square, limit};
      continue;
    }
    const double way = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) * Case::time_step / Derived<Case>::radius;
    if (worst.particle < 0 || way > worst.value) worst.particle = p.id[i], worst.value = way;
  }
  return worst;
}

}  // namespace detail

/// Overlap of a range at the beginning of the step; whose it is is left to be named by the caller (observe.hpp).
template <class Case>
Status check_overlap(State<Case>& s, int range) {
  const double deepest = greatest_of(s.watch[range].overlap), overlap = deepest / Derived<Case>::radius;
  if (deepest > s.deepest) s.deepest = deepest;
  if (!(overlap <= Case::max_overlap)) return {Fault::overlap, -1, 0, overlap, Case::max_overlap};
  return {};
}

/// Checks of a chunk that has just moved: not too deep, finite, not too fast, still in order.
template <class Case>
Status check_chunk(State<Case>& s, int chunk, long long step) {
  const double radius = Derived<Case>::radius;
  if (const Status deep = check_overlap(s, chunk); !deep.ok()) return deep;
  const double sum = sum_of(s.watch[chunk].square_sum);
  if (!(sum - sum == 0)) return detail::find_culprit(s, chunk, Fault::non_finite, 0);
  if (s.near_list.speed[chunk] * Case::time_step > greatest_way_per_step * radius) {
    const Status fastest = detail::find_culprit(s, chunk, Fault::too_fast, greatest_way_per_step);
    if (fastest.value > greatest_way_per_step) return fastest;
  }
  constexpr double slack = order_slack * Case::diameter;
  if (2 * s.near_list.way[chunk] > slack && !s.near_list.in_haste && (step + 1) % order_interval != 0)
    return {Fault::order_lost, detail::find_culprit(s, chunk, Fault::too_fast, 0).particle, 0,
            s.near_list.way[chunk] / Case::diameter, order_slack / 2};
  return {};
}

/// Force rows of one range into the ring of the step; its near list is seen to first.
template <class Case, int W>
void write_rows(State<Case>& s, int range, Real<Case>* ring, long long step) {
  using Cap = Capacity<Case>;
  constexpr int width = Contacts<Case>::row_width;
  if (s.near_list.is_broken(range)) {
    const Status status = list_again<Case, W>(s.contacts, s.near_list, s.particles, s.scratch, range);
    if (!status.ok()) detail::note(s, status, step + 1);
  }
  Watch<Case>& watch = s.watch[range];
  watch.begin_step();
  Real<Case>* rows = ring + (range == Cap::chunks ? Rows<Case>::wrap_first : Rows<Case>::first(range)) * width;
  const bool are_still = step > s.histories_given_at && s.near_list.is_still(range);
  pair_contacts<Case, W>(s.contacts.pairs, s.particles, range, are_still, rows, watch);
  if (range == Cap::chunks) {
    if (const Status deep = check_overlap(s, range); !deep.ok()) detail::note(s, deep, step + 1);
    return;
  }
  if constexpr (Case::has_wall)
    wall_contacts<Case, W, PipeSurface<Case>>(s.contacts.pipe, s.particles, range, are_still,
                                              ring + first_pipe_row(s.contacts, range) * width, watch);
  if constexpr (Derived<Case>::has_ends)
    wall_contacts<Case, W, EndSurfaces<Case>>(s.contacts.ends, s.particles, range, are_still,
                                              ring + first_end_row(s.contacts, range) * width, watch);
}

/// Sums the rows of a chunk, moves its particles, and checks them.
template <class Case, int W>
void move_chunk(State<Case>& s, int chunk, const Real<Case>* ring, long long step) {
  if (s.contacts.slots_are_stale[chunk]) {
    const Status status = list_slots(s.contacts, s.near_list, s.particles, s.scratch, chunk);
    if (!status.ok()) detail::note(s, status, step + 1);
  }
  Watch<Case>& watch = s.watch[chunk];
  move<Case, W>(s.contacts, s.particles, chunk, ring, watch);
  s.near_list.speed[chunk] = watch.speed_bound();
  s.near_list.way[chunk] += s.near_list.speed[chunk] * Case::time_step;
  if (const Status status = check_chunk(s, chunk, step); !status.ok()) detail::note(s, status, step + 1);
}

/// What comes before a step: the order along the pipe, and the gas, when they are due.
template <class Case, int W>
void begin_step(State<Case>& s) {
  Status status;
  const bool is_due = s.near_list.order_is_due(s.step);
  if (is_due) status = renew<Case, W>(s.contacts, s.near_list, s.particles, s.kept, s.scratch, 1);
  s.near_list.choose_pace(s.step);
  if constexpr (Case::has_gas) {
    if (status.ok() && s.step % Case::gas_floater_interval == 0) find_floaters(s.gas, s.particles, s.contacts);
    if (status.ok() && s.step % Case::gas_update_interval == 0) status = update_slices<Case, W>(s.gas, s.particles);
  }
  if (!status.ok()) detail::note(s, status, s.step);
}

/// One time step of the whole pipe. `W`: lanes per register.
template <class Case, int W>
void step(State<Case>& s) {
  Real<Case>* ring = s.contacts.rows[0];
  if constexpr (Derived<Case>::is_periodic) write_rows<Case, W>(s, Capacity<Case>::chunks, ring, s.step);
  for (int chunk = 0; chunk < Capacity<Case>::chunks; ++chunk) {
    write_rows<Case, W>(s, chunk, ring, s.step);
    move_chunk<Case, W>(s, chunk, ring, s.step);
  }
  ++s.step;
}

}  // namespace fixdem
