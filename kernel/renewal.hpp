// Renewal: particles sorted again, and everything listed.
//
// Renumbering moves contacts to other chunks and can exchange owner and partner, so histories go through
// kept_history.hpp. Seldom: a bed at rest is sorted every some 1e5 steps, an agitated one every some hundreds; in
// between single ranges are listed out of the outer list (listing.hpp).
#pragma once

#include "order.hpp"
#include "slots.hpp"

namespace fixdem {

/// Refuses positions that are no numbers or lie outside the pipe: beyond its wall, or beyond a closed end.
template <class Case>
Status check_places(const Contacts<Case>& contacts, const Particles<Case>& p) {
  for (int i = 0; i < Case::particle_count; ++i) {
    const double *x = p.position[i], *v = p.motion[i];
    double sum = (x[0] + x[1]) + x[2];
    for (int c = 0; c < Particles<Case>::motion_width; ++c) sum += v[c];
    if (!(sum - sum == 0)) return {Fault::non_finite, p.id[i], 0, sum, 0};
    Status status;
    for_each_wall(contacts, [&](const auto& walls) {
      if (status.ok() && walls.surface.is_outside(x))
        status = {Fault::outside_pipe, p.id[i], 0, walls.surface.place(x), walls.surface.limit};
    });
    if (!status.ok()) return status;
    if (Derived<Case>::is_periodic && !(abs(x[2]) < farthest_place * Case::pipe_length))
      return {Fault::outside_pipe, p.id[i], 0, x[2], farthest_place * Case::pipe_length};
  }
  return {};
}

/// The whole renewal, before step `step`.
template <class Case, int W>
Status renew(Contacts<Case>& contacts, NearList<Case>& near, Particles<Case>& p, KeptHistory<Case>& kept,
             ListingScratch<Case>& scratch, long long step) {
  using Cap = Capacity<Case>;
  using D = Derived<Case>;
  if (const Status status = check_places(contacts, p); !status.ok()) return status;
  for (int range = 0; range < NearList<Case>::ranges; ++range) keep_pair_histories(contacts, p, kept, range);
  for_each_wall(contacts, [&](const auto& walls) {
    for (int chunk = 0; chunk < Cap::chunks; ++chunk) keep_wall_histories(walls, p, kept, chunk);
  });
  if (const Status status = kept.status(); !status.ok()) return status;
  near.most_histories = kept.count() > near.most_histories ? kept.count() : near.most_histories;
  if constexpr (D::is_periodic) wrap_into_pipe(p);
  sort_by_cell(near.outer, contacts.sort, p);
  for (int i = 0; i < Case::particle_count; ++i) p.note_motion(i);
  if (const Status status = list_outer<Case, W>(near.outer, contacts.sort, p); !status.ok()) return status;
  near.start_order(p, step);
  contacts.set_span(near.outer.span);

  for (int range = 0; range < NearList<Case>::ranges; ++range)
    if (const Status status = list_pairs<Case, W>(contacts, near, p, kept, range); !status.ok()) return status;
  for_each_wall(contacts, [&](auto& walls) {
    for (int chunk = 0; chunk < Cap::chunks; ++chunk)
      list_walls(walls, near, p, kept, chunk, contacts.pairs.sparse[chunk]);
  });
  kept.forget();
  for (int chunk = 0; chunk < Cap::chunks; ++chunk)
    if (const Status status = list_slots(contacts, near, p, scratch, chunk); !status.ok()) return status;
  return {};
}

}  // namespace fixdem
