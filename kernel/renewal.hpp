// Renewal: particles sorted again, and everything listed.
//
// Renumbering moves contacts to other chunks and can exchange owner and partner, so histories go through
// kept_history.hpp. Seldom: a bed at rest is sorted every some 1e5 steps, an agitated one every some hundreds; in
// between single ranges are listed out of the outer list (listing.hpp).
#pragma once

#include "feed.hpp"
#include "outlet.hpp"
#include "slots.hpp"

namespace fixdem {

/// Refuses positions that are no numbers or lie outside the pipe: beyond its wall, or beyond a closed end.
template <class Case>
Status check_places(const Contacts<Case>& contacts, const Particles<Case>& p) {
  for (int i = 0; i < p.rows(); ++i) {
    if (!p.is_present(i)) continue;
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

/// Chunks that are no longer in use have no contacts.
template <class Case>
void forget_unused(Contacts<Case>& contacts, int from, int to) {
  for (int chunk = from; chunk < to; ++chunk) {
    contacts.pairs.count[chunk] = 0;
    contacts.has_rows[chunk] = contacts.has_sums[chunk] = contacts.slots_are_stale[chunk] = false;
    for_each_wall(contacts, [&](auto& walls) { walls.count[chunk] = 0; });
  }
}

/// The whole renewal, before step `step`. In a line those that have left are taken out, and particles are fed, after
/// histories have been kept and before all is sorted.
template <class Case, int W>
Status renew(Contacts<Case>& contacts, NearList<Case>& near, Particles<Case>& p, KeptHistory<Case>& kept,
             ListingScratch<Case>& scratch, [[maybe_unused]] Line<Case>& line, long long step) {
  using D = Derived<Case>;
  const auto ranges_of = [](int chunks) { return D::is_periodic ? NearList<Case>::ranges : chunks; };
  const int chunks_before = chunks_in_use(p);
  if (const Status status = check_places(contacts, p); !status.ok()) return status;
  for (int range = 0; range < ranges_of(chunks_before); ++range) keep_pair_histories(contacts, p, kept, range);
  for_each_wall(contacts, [&](const auto& walls) {
    for (int chunk = 0; chunk < chunks_before; ++chunk) keep_wall_histories(walls, p, kept, chunk);
  });
  if (const Status status = kept.status(); !status.ok()) return status;
  near.most_histories = kept.count() > near.most_histories ? kept.count() : near.most_histories;
  if constexpr (D::is_periodic) wrap_into_pipe(p);
  Status fed;
  if constexpr (is_line<Case>) {
    const int gone = take_out_gone(p);
    fed = feed(line, p, near, gone, step);  // a full pipe is listed as any other, for the report
    forget_unused(contacts, chunks_in_use(p), chunks_before);
  }
  const int chunks = chunks_in_use(p);
  sort_by_cell(near.outer, contacts.sort, p);
  for (int i = 0; i < p.rows(); ++i) p.note_motion(i);
  if (const Status status = list_outer<Case, W>(near.outer, contacts.sort, p); !status.ok()) return status;
  near.start_order(p, step, chunks > chunks_before ? chunks : chunks_before);
  if constexpr (is_line<Case>) start_watch(line, p);
  contacts.set_span(near.outer.span);

  for (int range = 0; range < ranges_of(chunks); ++range)
    if (const Status status = list_pairs<Case, W>(contacts, near, p, kept, range); !status.ok()) return status;
  for_each_wall(contacts, [&](auto& walls) {
    for (int chunk = 0; chunk < chunks; ++chunk) list_walls(walls, near, p, kept, chunk, contacts.pairs.sparse[chunk]);
  });
  kept.forget();
  for (int chunk = 0; chunk < chunks; ++chunk)
    if (const Status status = list_slots(contacts, near, p, scratch, chunk); !status.ok()) return status;
  return fed;
}

}  // namespace fixdem
