// Renewal of the near list: sort, search, and fill the batches and slot lists of contacts.hpp.
//
// Particles lie sorted along z; the partners of particle i with higher numbers are found by comparing it with the
// next ones, W at a time, until z differs by the cut-off d + margin. In a periodic pipe the first particles are
// repeated behind the last, one period on; such pairs are owned by the lower number and go to a range of their own.
// Every capacity is checked before it is used, and the first that does not suffice ends the run.
#pragma once

#include "kept_history.hpp"
#include "near_list.hpp"
#include "order.hpp"
#include "status.hpp"

namespace fixdem {

/// Share of touching pairs below which a chunk counts as sparse (pair_contacts.hpp).
inline constexpr double sparse_below = 0.5;

namespace detail {

/// Fills the lanes behind the last contact of a range with copies of the last one, history zero; they are masked out.
template <int Size, class Batches>
void fill_last_batch(Batches& batches, int first_batch, int contacts) {
  for (int k = contacts; k % 8 != 0; ++k) {
    const int batch = first_batch + k / 8, lane = k % 8;
    batches.owner[batch][lane] = batches.owner[batch][lane - 1];
    if constexpr (requires { batches.partner; }) batches.partner[batch][lane] = batches.partner[batch][lane - 1];
    if constexpr (Size > 0)
      for (int c = 0; c < Size; ++c) batches.history.value[batch][c][lane] = 0;
  }
}

/// Puts one pair into a range and books its force row with both particles.
template <class Case>
void add_pair(Contacts<Case>& contacts, NearList<Case>& near, const Particles<Case>& p, const KeptHistory<Case>& kept,
              int range, int owner, int partner, int first_row) {
  const bool wraps = range == Capacity<Case>::chunks;
  const int owner_base = wraps ? 0 : range * Capacity<Case>::chunk_size;
  const int partner_base = wraps ? Rows<Case>::wrap_base : owner_base;
  const int k = contacts.pairs.count[range]++;
  const int batch = contacts.pairs.first[range] + k / 8, lane = k % 8;
  contacts.pairs.owner[batch][lane] = Rows<Case>::offset(owner - owner_base);
  contacts.pairs.partner[batch][lane] = Rows<Case>::offset(partner - partner_base);
  if constexpr (PairBatches<Case>::history_size > 0)
    kept.restore(p.id[owner], p.id[partner], contacts.pairs.history.value[batch], lane);
  near.own_row[owner][near.own_count[owner]++] = Rows<Case>::offset(first_row + k);
  near.incoming_row[partner][near.incoming_count[partner]++] = Rows<Case>::offset(first_row + k);
}

/// Lists the particles of one chunk that are near a wall; `is_near(row)` decides. Returns the row after the last batch.
template <class Case, class Walls, class IsNear>
int list_walls(Walls& walls, NearList<Case>& near, const Particles<Case>& p,
               const double (*kept)[Walls::history_size > 0 ? Walls::history_size : 1], int chunk, int first_row,
               IsNear&& is_near) {
  constexpr int size = Walls::history_size;
  const int base = chunk * Capacity<Case>::chunk_size;
  const int end = base + Capacity<Case>::chunk_size < Case::particle_count ? base + Capacity<Case>::chunk_size
                                                                           : Case::particle_count;
  int k = 0;
  for (int i = base; i < end; ++i) {
    if (!is_near(i)) continue;
    const int batch = walls.first[chunk] + k / 8, lane = k % 8;
    walls.owner[batch][lane] = Rows<Case>::offset(i - base);
    if constexpr (size > 0)
      for (int c = 0; c < size; ++c) walls.history.value[batch][c][lane] = kept[p.id[i]][c];
    near.own_row[i][near.own_count[i]++] = Rows<Case>::offset(first_row + k);
    ++k;
  }
  walls.count[chunk] = k;
  fill_last_batch<size>(walls, walls.first[chunk], k);
  walls.first[chunk + 1] = walls.first[chunk] + (k + 7) / 8;
  return first_row + (k + 7) / 8 * 8;
}

/// Slot lists of one chunk: particles by the greater of their own and incoming rows, short ones first.
template <class Case>
int list_slots(Contacts<Case>& contacts, const NearList<Case>& near, int chunk, int entry) {
  constexpr int kinds = Contacts<Case>::max_slots + 1;
  const int base = chunk * Capacity<Case>::chunk_size;
  const int end = base + Capacity<Case>::chunk_size < Case::particle_count ? base + Capacity<Case>::chunk_size
                                                                           : Case::particle_count;
  contacts.first_slot[chunk] = entry;
  const auto length = [&](int i) {
    return near.own_count[i] > near.incoming_count[i] ? near.own_count[i] : near.incoming_count[i];
  };
  for (int k = 0; k < kinds; ++k) contacts.bucket[chunk][k] = 0;
  for (int i = base; i < end; ++i) ++contacts.bucket[chunk][length(i)];
  int next[kinds];
  for (int k = 0; k < kinds; ++k) {
    next[k] = entry;
    entry += contacts.bucket[chunk][k] * (2 * k + 1);
  }
  for (int i = base; i < end; ++i) {
    const int k = length(i);
    auto* slot = contacts.slots + next[k];
    next[k] += 2 * k + 1;
    *slot++ = Rows<Case>::offset(i - base);
    for (int s = 0; s < k; ++s)
      *slot++ = s < near.own_count[i] ? near.own_row[i][s] : Rows<Case>::offset(Rows<Case>::zero);
    for (int s = 0; s < k; ++s)
      *slot++ = s < near.incoming_count[i] ? near.incoming_row[i][s] : Rows<Case>::offset(Rows<Case>::zero);
  }
  return entry;
}

}  // namespace detail

/// Keeps the histories of the present contacts by particle number.
template <class Case>
void keep_histories(const Contacts<Case>& contacts, const Particles<Case>& p, KeptHistory<Case>& kept) {
  if constexpr (Derived<Case>::has_friction) {
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

/// Searches pairs and walls within the margin and fills batches and slots. Particles must be sorted; histories kept.
template <class Case, int W>
Status list_contacts(Contacts<Case>& contacts, NearList<Case>& near, const Particles<Case>& p,
                     const KeptHistory<Case>& kept) {
  using Cap = Capacity<Case>;
  using D = Derived<Case>;
  using V = Lanes<W>;
  constexpr int count = Case::particle_count;
  const double cut_off = Case::diameter + near.margin;
  for (int i = 0; i < count + near.copies; ++i) {
    const int q = i < count ? i : i - count;
    near.x[i] = p.position[q][0], near.y[i] = p.position[q][1];
    near.z[i] = p.position[q][2] + (i < count ? 0 : Case::pipe_length);
  }
  for (int i = count + near.copies; i < count + near.copies + 16; ++i) near.x[i] = near.y[i] = 0, near.z[i] = 1e300;
  for (int i = 0; i < count; ++i) near.own_count[i] = near.incoming_count[i] = 0, contacts.near_count[i] = 0;

  const auto fault = [&](Fault kind, int i, double value, double limit) {
    return Status{kind, 0, p.id[i], value, limit};
  };
  if constexpr (NearList<Case>::copies < count &&
                D::is_periodic) {  // a search that runs past the copies would miss pairs
    const int last = count + near.copies - 1;
    if (near.z[last] - near.z[count - 1] < cut_off)
      return fault(Fault::chunk_capacity, count - 1, near.copies + 1, Cap::chunk_size);
  }
  int entry = 0, wraps = 0;
  contacts.pairs.first[0] = 0;
  if constexpr (Case::has_wall) contacts.pipe.first[0] = 0;
  if constexpr (D::has_ends) contacts.ends.first[0] = 0;

  for (int chunk = 0; chunk < Cap::chunks; ++chunk) {
    const int base = chunk * Cap::chunk_size;
    const int end = base + Cap::chunk_size < count ? base + Cap::chunk_size : count;
    int row = Rows<Case>::first(chunk);
    contacts.pairs.count[chunk] = 0;
    int touching = 0;
    for (int i = base; i < end; ++i) {
      for (int j = i + 1; near.z[j] - near.z[i] < cut_off; j += W) {
        const V dx = load_any<V>(near.x + j) - near.x[i], dy = load_any<V>(near.y + j) - near.y[i],
                dz = load_any<V>(near.z + j) - near.z[i];
        const V square = fused(dz, dz, fused(dy, dy, dx * dx));
        if (!any(square < cut_off * cut_off)) continue;
        alignas(64) double squares[W];
        store(squares, square);
        for (int lane = 0; lane < W; ++lane) {
          if (!(squares[lane] < cut_off * cut_off)) continue;
          const int j_lane = j + lane, partner = j_lane < count ? j_lane : j_lane - count;
          const int both[2] = {i, partner};
          for (int particle : both)
            if (++contacts.near_count[particle] > Cap::neighbours)
              return fault(Fault::neighbour_capacity, particle, contacts.near_count[particle], Cap::neighbours);
          touching += squares[lane] < Case::diameter * Case::diameter;
          if (j_lane - i > near.most_reach) near.most_reach = j_lane - i;
          if (j_lane - i > Cap::chunk_size) return fault(Fault::chunk_capacity, i, j_lane - i, Cap::chunk_size);
          if (j_lane >= count) {
            if (wraps == Cap::wrap_pairs) return fault(Fault::pair_capacity, i, wraps + 1, Cap::wrap_pairs);
            near.wrap_owner[wraps] = partner, near.wrap_partner[wraps++] = i;
          } else {
            if (contacts.pairs.count[chunk] == Cap::chunk_pairs)
              return fault(Fault::pair_capacity, i, Cap::chunk_pairs + 1, Cap::chunk_pairs);
            detail::add_pair(contacts, near, p, kept, chunk, i, j_lane, row);
          }
        }
      }
    }
    const int pairs = contacts.pairs.count[chunk];
    if (pairs > near.most_chunk_pairs) near.most_chunk_pairs = pairs;
    detail::fill_last_batch<PairBatches<Case>::history_size>(contacts.pairs, contacts.pairs.first[chunk], pairs);
    contacts.pairs.first[chunk + 1] = contacts.pairs.first[chunk] + (pairs + 7) / 8;
    row += (pairs + 7) / 8 * 8;
    contacts.pairs.sparse[chunk] = touching < sparse_below * pairs;

    if constexpr (Case::has_wall) {
      const double q = D::pipe_radius - D::radius - near.margin, q_square = q > 0 ? q * q : -1;
      const auto is_near = [&](int i) { return near.x[i] * near.x[i] + near.y[i] * near.y[i] > q_square; };
      if constexpr (D::has_friction)
        row = detail::list_walls(contacts.pipe, near, p, kept.pipe, chunk, row, is_near);
      else
        row = detail::list_walls(contacts.pipe, near, p, nullptr, chunk, row, is_near);
    }
    if constexpr (D::has_ends) {
      const double reach = D::radius + near.margin;
      const auto is_near = [&](int i) { return near.z[i] < reach || near.z[i] > Case::pipe_length - reach; };
      if constexpr (D::has_friction)
        row = detail::list_walls(contacts.ends, near, p, kept.ends, chunk, row, is_near);
      else
        row = detail::list_walls(contacts.ends, near, p, nullptr, chunk, row, is_near);
    }
  }
  if constexpr (D::is_periodic) {
    constexpr int range = Cap::chunks;
    contacts.pairs.count[range] = 0;
    for (int k = 0; k < wraps; ++k)
      detail::add_pair(contacts, near, p, kept, range, near.wrap_owner[k], near.wrap_partner[k],
                       Rows<Case>::wrap_first);
    detail::fill_last_batch<PairBatches<Case>::history_size>(contacts.pairs, contacts.pairs.first[range], wraps);
    contacts.pairs.first[range + 1] = contacts.pairs.first[range] + (wraps + 7) / 8;
    contacts.pairs.sparse[range] = false;
    if (wraps > near.most_wrap_pairs) near.most_wrap_pairs = wraps;
  }
  for (int chunk = 0; chunk < Cap::chunks; ++chunk) entry = detail::list_slots(contacts, near, chunk, entry);
  for (int i = 0; i < count; ++i)
    if (contacts.near_count[i] > near.most_neighbours) near.most_neighbours = contacts.near_count[i];
  return {};
}

/// Refuses positions that are no numbers or lie outside the pipe: beyond its wall, or beyond a closed end.
template <class Case>
Status check_places(const Particles<Case>& p) {
  for (int i = 0; i < Case::particle_count; ++i) {
    const double *x = p.position[i], *v = p.motion[i];
    double sum = (x[0] + x[1]) + x[2];
    for (int c = 0; c < Particles<Case>::motion_width; ++c) sum += v[c];
    if (!(sum - sum == 0)) return {Fault::non_finite, 0, p.id[i], sum, 0};
    const double q = sqrt(x[0] * x[0] + x[1] * x[1]);
    if (Case::has_wall && q > Derived<Case>::pipe_radius)
      return {Fault::outside_pipe, 0, p.id[i], q, Derived<Case>::pipe_radius};
    if (Derived<Case>::is_periodic && !(abs(x[2]) < farthest_place * Case::pipe_length))
      return {Fault::outside_pipe, 0, p.id[i], x[2], farthest_place * Case::pipe_length};
    if (Derived<Case>::has_ends && (x[2] < 0 || x[2] > Case::pipe_length))
      return {Fault::outside_pipe, 0, p.id[i], x[2], Case::pipe_length};
  }
  return {};
}

/// The whole renewal. `speed`: bound on the present speeds, m/s; `first_gap`: see sort_along_pipe.
template <class Case, int W>
Status renew(Contacts<Case>& contacts, NearList<Case>& near, Particles<Case>& p, KeptHistory<Case>& kept, double speed,
             int first_gap) {
  if (const Status status = check_places(p); !status.ok()) return status;
  keep_histories(contacts, p, kept);
  if constexpr (Derived<Case>::is_periodic) wrap_into_pipe(p);
  sort_along_pipe(p, first_gap);
  near.choose_margin(speed);
  ++near.renewals;
  return list_contacts<Case, W>(contacts, near, p, kept);
}

}  // namespace fixdem
