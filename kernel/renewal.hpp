// Renewal: particles sorted along the pipe again, and everything listed anew.
//
// Renumbering moves contacts to other chunks and can exchange owner and partner, so histories go through
// kept_history.hpp. In a periodic pipe the first particles are seen once more behind the last, one period on; pairs
// with them are owned by the lower number and form a range of their own. Seldom: a bed at rest is sorted every some 1e5
// steps, an agitated one every 500; in between ranges are listed anew one by one (listing.hpp).
#pragma once

#include "order.hpp"
#include "slots.hpp"

namespace fixdem {

/// Keeps the histories of the present contacts by particle number.
template <class Case>
void keep_histories(const Contacts<Case>& contacts, const Particles<Case>& p, KeptHistory<Case>& kept) {
  if constexpr (keeps_history<Case>) {
    constexpr int size = KeptHistory<Case>::size;
    kept.clear();
    for_each_near_pair(contacts, [&](int batch, int lane, int owner, int partner) {
      kept.keep(p.id[owner], p.id[partner], contacts.pairs.history.value[batch], lane);
    });
    if constexpr (Case::has_wall)
      for_each_near_wall<Case>(contacts.pipe, [&](int batch, int lane, int owner) {
        for (int c = 0; c < size; ++c) kept.pipe[p.id[owner]][c] = contacts.pipe.history.value[batch][c][lane];
      });
    if constexpr (Derived<Case>::has_ends)
      for_each_near_wall<Case>(contacts.ends, [&](int batch, int lane, int owner) {
        for (int c = 0; c < size; ++c) kept.ends[p.id[owner]][c] = contacts.ends.history.value[batch][c][lane];
      });
  }
}

/// Refuses positions that are no numbers or lie outside the pipe: beyond its wall, or beyond a closed end.
template <class Case>
Status check_places(const Particles<Case>& p) {
  for (int i = 0; i < Case::particle_count; ++i) {
    const double *x = p.position[i], *v = p.motion[i];
    double sum = (x[0] + x[1]) + x[2];
    for (int c = 0; c < Particles<Case>::motion_width; ++c) sum += v[c];
    if (!(sum - sum == 0)) return {Fault::non_finite, p.id[i], 0, sum, 0};
    const double q = sqrt(x[0] * x[0] + x[1] * x[1]);
    if (Case::has_wall && q > Derived<Case>::pipe_radius)
      return {Fault::outside_pipe, p.id[i], 0, q, Derived<Case>::pipe_radius};
    if (Derived<Case>::is_periodic && !(abs(x[2]) < farthest_place * Case::pipe_length))
      return {Fault::outside_pipe, p.id[i], 0, x[2], farthest_place * Case::pipe_length};
    if (Derived<Case>::has_ends && (x[2] < 0 || x[2] > Case::pipe_length))
      return {Fault::outside_pipe, p.id[i], 0, x[2], Case::pipe_length};
  }
  return {};
}

/// Notes the end of every particle's reach in the new order, the speed of every chunk, and starts their ways.
template <class Case>
Status find_reaches(NearList<Case>& near, const Particles<Case>& p) {
  constexpr int count = Case::particle_count;
  constexpr double reach = (1 + greatest_margin + order_slack) * Case::diameter;
  const auto place = [&](int j) { return j < count ? p.position[j][2] : p.position[j - count][2] + Case::pipe_length; };
  int end = 0;
  for (int i = 0; i < count; ++i) {
    if (end <= i) end = i + 1;
    while (end < count + near.copies && place(end) - place(i) < reach) ++end;
    near.end_of_reach[i] = end;
    const int followers = end - 1 - i;
    if (followers > near.most_reach) near.most_reach = followers;
    // One that has followers up to the last copy may have more.
    const bool has_all = near.copies == count || near.copies == 0 || end < count + near.copies;
    if (followers >= Capacity<Case>::chunk_size && near.copies < count)
      return {Fault::chunk_capacity, p.id[i], 0, followers + 1.0, Capacity<Case>::chunk_size};
    if (!has_all) return {Fault::chunk_capacity, p.id[i], 0, near.copies + 1.0, Capacity<Case>::chunk_size};
  }
  for (int chunk = 0; chunk < Capacity<Case>::chunks; ++chunk) {
    const int base = chunk * Capacity<Case>::chunk_size;
    double square = 0;
    for (int i = base; i < base + particles_in<Case>(chunk); ++i) {
      const double* v = p.motion[i];
      square = max(v[0] * v[0] + v[1] * v[1] + v[2] * v[2], square);
    }
    near.way[chunk] = 0;
    near.speed[chunk] = sqrt(square);
  }
  return {};
}

/// The whole renewal. `first_gap`: see sort_along_pipe.
template <class Case, int W>
Status renew(Contacts<Case>& contacts, NearList<Case>& near, Particles<Case>& p, KeptHistory<Case>& kept,
             ListingScratch<Case>& scratch, int first_gap) {
  using Cap = Capacity<Case>;
  using D = Derived<Case>;
  if (const Status status = check_places(p); !status.ok()) return status;
  keep_histories(contacts, p, kept);
  if constexpr (D::is_periodic) wrap_into_pipe(p);
  sort_along_pipe(p, first_gap);
  if (const Status status = find_reaches(near, p); !status.ok()) return status;
  for (int i = 0; i < Case::particle_count; ++i) p.note_motion(i);
  ++near.sorts;

  for (int range = 0; range < NearList<Case>::ranges; ++range) {
    near.promise_anew(range);
    const PairRange<Case> at(range);
    const Status status =
        list_pairs<Case, W>(contacts, near, p, scratch, range,
                            [&](int owner, int partner, Real<Case>(*value)[Capacity<Case>::batch], int lane) {
                              if constexpr (keeps_history<Case>)
                                kept.restore(p.id[at.owner_base + owner], p.id[at.partner_base + partner], value, lane);
                            });
    if (!status.ok()) return status;
    if (range == Cap::chunks) break;
    const int base = range * Cap::chunk_size;
    const auto walls = [&](auto& kind, auto is_near, auto histories) {
      detail::list_walls(kind, p, range, near.promise[range].margin, is_near,
                         [&](int i, Real<Case>(*value)[Cap::batch], int lane) {
                           if constexpr (keeps_history<Case>)
                             for (int c = 0; c < KeptHistory<Case>::size; ++c)
                               value[c][lane] = histories(p.id[base + i])[c];
                         });
    };
    if constexpr (Case::has_wall) walls(contacts.pipe, is_near_pipe<Case>, [&](int id) { return kept.of_pipe(id); });
    if constexpr (D::has_ends) walls(contacts.ends, is_near_end<Case>, [&](int id) { return kept.of_end(id); });
  }
  for (int chunk = 0; chunk < Cap::chunks; ++chunk)
    if (const Status status = list_slots(contacts, near, p, scratch, chunk); !status.ok()) return status;
  return {};
}

}  // namespace fixdem
