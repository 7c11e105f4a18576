// The outlet of an open line: a particle whose centre has come to z >= pipe_length leaves in that step.
//
// What it carries is booked, with the elastic energy of its contacts, which are cut. To take it out of the lists at
// once would cost a renewal; so its row stays until particles are sorted next, parked at rest on the axis, each in a
// place of its own behind the outlet and so far from everything that nothing touches it. Gravity moves what is parked,
// so it is put back after every step. A chunk looks for particles beyond the outlet only where some can be: the place
// of its foremost is bounded by its velocities since the sort.
#pragma once

#include "line.hpp"
#include "near_list.hpp"
#include "observe_contact.hpp"
#include "order.hpp"

namespace fixdem {

namespace detail {

/// Puts the particle of a row behind the outlet, at rest.
template <class Case>
void park(Particles<Case>& p, int row) {
  p.clear_row(row);
  p.position[row][2] = Case::pipe_length + 2 * largest_diameter<Case> * (1 + p.id[row]);
  set_size(p, row);
  p.note_motion(row);
}
template <class Case>
bool is_parked(const Particles<Case>& p, int row) {
  return p.position[row][2] > Case::pipe_length + largest_diameter<Case>;
}

/// Cuts the contacts of the particle of a row of a chunk: they lose their histories. Returns the elastic energy that
/// was in them, J. Particles behind it in the order have not moved in this step.
template <class Case>
double cut_contacts(Contacts<Case>& contacts, const Particles<Case>& p, int chunk, int row) {
  double elastic = 0;
  const auto add = [&](const Observed<Case>& seen) {
    if (seen.contact.owner == p.id[row] || seen.contact.partner == p.id[row]) elastic += seen.elastic;
  };
  const auto forget = [&](auto& batches, int range, int k) {
    for (int c = 0; c < std::remove_reference_t<decltype(batches)>::history_size; ++c)
      batches.history_of(range, k)[c] = 0;
  };
  for (int range = chunk > contacts.span ? chunk - contacts.span : 0; range <= chunk; ++range) {
    for_each_observed_pair_in(contacts, p, range, add);
    for_each_near_pair_in(contacts, range, [&](int, int k, int owner, int partner) {
      if (owner == row || partner == row) forget(contacts.pairs, range, k);
    });
  }
  for_each_wall(contacts, [&](auto& walls) {
    for_each_observed_wall_in(walls, p, chunk, add);
    for_each_near_wall_in<Case>(walls, chunk, [&](int, int k, int owner) {
      if (owner == row) forget(walls, chunk, k);
    });
  });
  return elastic;
}

}  // namespace detail

/// After a chunk has moved: lets go of its particles that are beyond the outlet. Calls left(slot) for each.
template <class Case, class Left>
void let_leave(Line<Case>& line, Contacts<Case>& contacts, Particles<Case>& p, int chunk, const VelocityBox& velocities,
               Left&& left) {
  constexpr double rounding = 1e-9;  // of the bound against the places themselves, in lengths of the pipe
  double& front = line.front[chunk];
  front += max(velocities.high[2], 0.0) * Case::time_step;
  if (front < Case::pipe_length * (1 - rounding) && line.parked[chunk] == 0) return;
  const int base = chunk * Capacity<Case>::chunk_size;
  front = 0;
  for (int row = base; row < base + particles_in(p, chunk); ++row) {
    if (p.is_present(row)) {
      front = max(p.position[row][2], front);
      continue;
    }
    if (!detail::is_parked(p, row)) {
      Passage leaving = passage_of(p, row);
      leaving.elastic = detail::cut_contacts(contacts, p, chunk, row);
      line.left[chunk].add(leaving);
      ++line.parked[chunk];
      left(p.id[row]);
    }
    detail::park(p, row);
  }
}

/// Takes the rows of those that have left out of use and frees their slots; the others keep their order. Returns how
/// many. Contacts must have been given up, and all is sorted and listed after it.
template <class Case>
int take_out_gone(Particles<Case>& p) {
  int kept = 0;
  const int rows = p.rows();
  for (int row = 0; row < rows; ++row) {
    if (!p.is_present(row)) {
      p.slots.is_taken[p.id[row]] = false;
      continue;
    }
    if (kept != row) detail::WholeParticle<Case>(p, row).put(p, kept);
    ++kept;
  }
  p.slots.rows_in_use = kept;
  return rows - kept;
}

/// After a sort: where the foremost of each chunk is. Nobody is parked.
template <class Case>
void start_watch(Line<Case>& line, const Particles<Case>& p) {
  line.sorted_chunks = chunks_in_use(p);
  for (int chunk = 0; chunk < line.sorted_chunks; ++chunk) {
    line.front[chunk] = line.parked[chunk] = 0;
    const int base = chunk * Capacity<Case>::chunk_size;
    for (int row = base; row < base + particles_in(p, chunk); ++row)
      line.front[chunk] = max(p.position[row][2], line.front[chunk]);
  }
}

}  // namespace fixdem
