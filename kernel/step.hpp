// The order of one time step.
//
// Contacts from the present positions, chunk after chunk along the pipe; each chunk then sums what they give its
// particles and moves. A chunk may move before the next one computes its contacts: no contact of a later chunk looks
// back. A range whose
// near list no longer holds is listed again just before. Every chunk ends its step with the checks; the first fault, by
// step and then along the pipe, is final: the state is that after the faulty step, for the report.
#pragma once

#include "floaters.hpp"
#include "motion.hpp"
#include "pair_contacts.hpp"
#include "renewal.hpp"
#include "wall_contacts.hpp"

namespace fixdem {

/// A particle that travels further than this in one step, in radii, could pass through another one unseen.
inline constexpr double maximum_travel_per_step = 0.5;

/// Histories while contacts are listed again, or in the same place the particles as they have been placed, until the
/// start.
template <class Case>
union KeptOrPlaced {
  KeptHistory<Case> kept;
  Particle placed[Case::particle_count];
};

template <class Case>
struct State {
  Particles<Case> particles;
  Contacts<Case> contacts;
  NearList<Case> near_list;
  ListingScratch<Case> scratch;
  KeptOrPlaced<Case> before;
  [[no_unique_address]] GasSlices<Case> gas;
  [[no_unique_address]] Line<Case> line;
  StepMonitor<Case> monitor[NearList<Case>::ranges];
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
  for (int i = base; i < base + particles_in(p, chunk); ++i) {
    const double* v = p.motion[i];
    double square = 0;
    for (int c = 0; c < Particles<Case>::motion_width; ++c) square += v[c] * v[c];
    if (fault == Fault::non_finite) {
      if (!(square - square == 0)) return {fault, p.id[i], 0, square, limit};
      continue;
    }
    const double travel =
        sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) * Case::time_step / Derived<Case>::smallest_radius;
    if (worst.particle < 0 || travel > worst.value) worst.particle = p.id[i], worst.value = travel;
  }
  return worst;
}

}  // namespace detail

/// Overlap of a range at the beginning of the step; whose it is is left to be named by the caller (observe.hpp).
template <class Case>
Status check_overlap(State<Case>& s, int range) {
  const double deepest = maximum_of(s.monitor[range].overlap), overlap = deepest / Derived<Case>::smallest_radius;
  if (deepest > s.deepest) s.deepest = deepest;
  if (!(overlap <= Case::max_overlap)) return {Fault::overlap, -1, 0, overlap, Case::max_overlap};
  return {};
}

/// Checks of a chunk that has just moved: not too deep, finite, not too fast, still in order.
template <class Case>
Status check_chunk(State<Case>& s, int chunk, long long step) {
  const double radius = Derived<Case>::smallest_radius;
  if (const Status deep = check_overlap(s, chunk); !deep.ok()) return deep;
  const double sum = sum_of(s.monitor[chunk].square_sum);
  if (!(sum - sum == 0)) return detail::find_culprit(s, chunk, Fault::non_finite, 0);
  if (s.near_list.velocities[chunk].speed() * Case::time_step > maximum_travel_per_step * radius) {
    const Status fastest = detail::find_culprit(s, chunk, Fault::too_fast, maximum_travel_per_step);
    if (fastest.value > maximum_travel_per_step) return fastest;
  }
  if (s.near_list.travel[chunk] > s.near_list.outer.allowed_travel() && step + 1 < s.near_list.next_decision)
    return {Fault::order_lost, detail::find_culprit(s, chunk, Fault::too_fast, 0).particle, 0,
            s.near_list.travel[chunk] / smallest_diameter<Case>,
            s.near_list.outer.allowed_travel() / smallest_diameter<Case>};
  return {};
}

/// Lists again what no longer holds of a range, and begins its step.
template <class Case, int W>
void begin_range(State<Case>& s, int range, long long step) {
  const double travel = s.near_list.velocities_of(range).spread() * Case::time_step;
  const Status listed = keep_listed<Case, W>(s.contacts, s.near_list, s.particles, s.before.kept, range, travel);
  if (!listed.ok()) detail::note(s, listed, step + 1);
  s.monitor[range].begin_step();
}

/// Force rows of the dense contacts of a range, into the ring of the step.
template <class Case, int W>
void compute_dense(State<Case>& s, int range, Real<Case>* ring, long long step) {
  Contacts<Case>& contacts = s.contacts;
  const auto row = [&](int number) { return ring + number * Contacts<Case>::row_width; };
  const bool wraps = range == Capacity<Case>::chunks;
  StepMonitor<Case>& monitor = s.monitor[range];
  const auto are_still = [&] {
    return step > s.histories_given_at && s.near_list.is_still(s.near_list.velocities_of(range));
  };
  if (!contacts.pairs.sparse[range]) {
    Real<Case>* const first = row(wraps ? Rows<Case>::wrap_first : contacts.first_row(range));
    dense_pairs<Case, W>(contacts.pairs, s.particles, range, are_still(), first, contacts.torque_at(first), monitor);
  }
  if (wraps) return;
  for_each_wall_row<Case>(contacts, range, [&](auto& walls, int first_row) {
    if (!walls.sparse[range]) dense_walls<Case, W>(walls, s.particles, range, are_still(), row(first_row), monitor);
  });
}

/// Sparse contacts of the ranges from `begin` to `end`, into the sums of their particles, or into `later` if that is
/// not null.
template <class Case, int W>
void compute_sparse(State<Case>& s, int begin, int end, const RowsForLater<Case>* later = nullptr) {
  Contacts<Case>& contacts = s.contacts;
  if (later != nullptr) *later->count = 0;
  sparse_pairs<Case, W>(contacts, s.particles, begin, end, s.monitor, later);
  if (begin == Capacity<Case>::chunks) return;
  for_each_wall(contacts, [&](auto& walls) {
    sparse_walls<Case, W>(walls, contacts, s.particles, begin, end, s.monitor, later);
  });
}

/// All contacts of a range.
template <class Case, int W>
void compute_range(State<Case>& s, int range, Real<Case>* ring, long long step,
                   const RowsForLater<Case>* later = nullptr) {
  begin_range<Case, W>(s, range, step);
  compute_sparse<Case, W>(s, range, range + 1, later);
  compute_dense<Case, W>(s, range, ring, step);
}

/// Contacts across the periodic ends, in step `ahead` of a tile. Sparse ones wait until their particles move, so they
/// come last in every sum.
template <class Case, int W>
void compute_across(State<Case>& s, int ahead = 0) {
  constexpr int range = Capacity<Case>::chunks;
  const RowsForLater<Case> later = s.contacts.across_for_later(ahead);
  compute_range<Case, W>(s, range, s.contacts.ring(ahead), s.step + ahead, &later);
  if (const Status deep = check_overlap(s, range); !deep.ok()) detail::note(s, deep, s.step + ahead + 1);
}

/// Sums what contacts give the particles of a chunk, moves them, and checks them; in step `ahead` of a tile.
template <class Case, int W>
void move_chunk(State<Case>& s, int chunk, int ahead = 0) {
  const long long step = s.step + ahead;
  if (s.contacts.slots_are_stale[chunk]) {
    const Status status = list_slots(s.contacts, s.near_list, s.particles, s.scratch, chunk);
    if (!status.ok()) detail::note(s, status, step + 1);
  }
  if constexpr (Derived<Case>::is_periodic)
    if (s.near_list.outer.concerns_ends(chunk))
      add_later<Case, W>(s.contacts.across_for_later(ahead), s.contacts.sum[0], chunk, chunk + 1);
  StepMonitor<Case>& monitor = s.monitor[chunk];
  move<Case, W>(s.contacts, s.particles, chunk, s.contacts.ring(ahead), monitor);
  VelocityBox velocities;
  velocities.add(monitor.low, monitor.high);
  s.near_list.note_step(chunk, velocities);
  const Status status = check_chunk(s, chunk, step);
  if (!status.ok()) detail::note(s, status, step + 1);
  if constexpr (is_line<Case>)  // nobody leaves by a fault
    if (status.ok())
      let_leave(s.line, s.contacts, s.particles, chunk, velocities, [&]([[maybe_unused]] int slot) {
        if constexpr (Case::has_gas) s.gas.floats[slot] = true;  // as whoever is fed into it, until looked at
      });
}

/// What comes before a step: the order along the pipe, and the gas, when they are due.
template <class Case, int W>
void begin_step(State<Case>& s) {
  Status status;
  bool feeds = false;
  if constexpr (is_line<Case>) {
    begin_feeding(s.line, s.particles, s.near_list, s.step);
    feeds = s.line.feeds;
  }
  if (feeds || s.near_list.order_is_due(s.step, chunks_in_use(s.particles)))
    status = renew<Case, W>(s.contacts, s.near_list, s.particles, s.before.kept, s.scratch, s.line, s.step);
  if constexpr (Case::has_gas) {
    if (status.ok() && s.step % Case::gas_floater_interval == 0)
      find_floaters<Case, W>(s.gas, s.particles, s.near_list.outer);
    if (status.ok() && s.step % Case::gas_update_interval == 0)
      status = update_slices<Case, W>(s.gas, s.particles, s.step);
  }
  if (!status.ok()) detail::note(s, status, s.step);
}

/// One time step of the whole pipe. `W`: lanes per register.
template <class Case, int W>
void step(State<Case>& s) {
  const int chunks = chunks_in_use(s.particles);
  if constexpr (Derived<Case>::is_periodic) compute_across<Case, W>(s);
  for (int begin = 0; begin < chunks; begin += chunks_together) {
    const int end = begin + chunks_together < chunks ? begin + chunks_together : chunks;
    for (int chunk = begin; chunk < end; ++chunk) begin_range<Case, W>(s, chunk, s.step);
    compute_sparse<Case, W>(s, begin, end);
    for (int chunk = begin; chunk < end; ++chunk) {
      compute_dense<Case, W>(s, chunk, s.contacts.ring(0), s.step);
      move_chunk<Case, W>(s, chunk);
    }
  }
  ++s.step;
}

}  // namespace fixdem
