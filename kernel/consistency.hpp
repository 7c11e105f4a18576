// Whether a state that comes from outside (a checkpoint's bytes) may be run: no number in it leads out of its array.
//
// A run keeps these promises by itself and checks none of them in a step, so whoever copies bytes into a simulation
// asks here first. What is looked at, array by array:
//   particles  id is a permutation; places are finite and inside the pipe; motion is finite; each has its own size
//   outer list the span and the chunks at the ends are possible ones; counts fit, and pairs are rows of their range; in
//              a line, where the feed looks them up, cells begin at rows
//   next sort  its decision is near, and what it goes by are possible numbers
//   pairs      the same, of all lanes in use; bits of lanes that exist
//   walls      the same, and every particle once, in increasing order
//   slots      where they are used: every particle of a chunk once; rows lie in the ring; rows of zeros are zero
//   kept       no history is being carried over
//   line       slots taken are those of the rows, kinds are in the table of sizes, and whole numbers balance
//   the rest   flags are true or false, the step is a possible one, there is no fault
// Values (histories, ledgers, speeds, pressures) are not judged: they may make a run stop with a fault, never read
// elsewhere. What is written before it is used (scratch, cells, rows for later, slices of the gas) is not looked at. A
// new array of indices gets a line above and its check below; tests/consistency_test.cpp changes bytes at random and
// runs on.
#pragma once

#include "step.hpp"

namespace fixdem {

namespace detail {

/// A flag from outside may hold any byte.
inline bool is_flag(const bool& flag) {
  unsigned char byte;
  __builtin_memcpy(&byte, &flag, 1);
  return byte <= 1;
}

template <int Count>
bool are_flags(const bool (&flags)[Count]) {
  for (const bool& flag : flags)
    if (!is_flag(flag)) return false;
  return true;
}

/// Whether an offset names a row below `end`.
template <class Case, class Offset>
bool names_row_below(Offset offset, int end) {
  return offset % 8 == 0 && static_cast<long long>(offset / 8) < end;
}

/// In a line: rows fit, taken are the slots of the rows in use, and kinds are in the table.
template <class Case>
bool are_slots_of_line_consistent([[maybe_unused]] const Particles<Case>& p) {
  if constexpr (is_line<Case>) {
    const auto& slots = p.slots;
    if (slots.rows_in_use < 0 || slots.rows_in_use > Case::particle_count) return false;
    int taken = 0;
    for (const bool& is_taken : slots.is_taken) {
      if (!is_flag(is_taken)) return false;
      taken += is_taken;
    }
    if (taken != slots.rows_in_use) return false;
    for (int i = 0; i < p.rows(); ++i)
      if (p.id[i] < 0 || p.id[i] >= Case::particle_count || !slots.is_taken[p.id[i]]) return false;
    if constexpr (has_sizes<Case>)
      for (const int kind : slots.kind)
        if (kind < 0 || kind >= kinds_in<Case>) return false;
  }
  return true;
}

/// Who has entered is there or has left, and has a serial number of its own time.
template <class Case>
bool are_books_consistent(const Line<Case>& line, const Particles<Case>& p) {
  constexpr long long limit = 1LL << 40;  // sums of so many chunks stay far from overflow
  const auto is_possible = [](long long count) { return count >= 0 && count < limit; };
  if (!is_possible(line.entered.count) || !is_possible(line.tries) || !is_possible(line.blocked_events)) return false;
  const long long ever = Case::start_count + line.entered.count;
  long long known = 0;
  for (int i = 0; i < p.rows(); ++i) {
    const long long serial = p.slots.serial[p.id[i]];
    if (serial < 0 || serial >= ever) return false;
    known += p.is_present(i);
  }
  for (const Passage& of_chunk : line.left) {
    if (!is_possible(of_chunk.count)) return false;
    known += of_chunk.count;
  }
  return known == ever;
}

template <class Case>
bool are_particles_consistent(const Particles<Case>& p) {
  constexpr int count = Case::particle_count;
  if (!are_slots_of_line_consistent(p)) return false;
  for (int i = 0; i < p.rows(); ++i) {
    const double z = p.position[i][2];
    if (p.id[i] < 0 || p.id[i] >= count) return false;
    if (p.image[i] > 1 << 30 || p.image[i] < -(1 << 30)) return false;
    if (p.is_present(i) && !(z > -Case::pipe_length && z < 2 * Case::pipe_length)) return false;
    if (!has_its_size(p, i)) return false;
  }
  // A permutation: sums of the numbers and of their squares would not tell; marks need a bit for each particle.
  unsigned char seen[(count + 7) / 8 < 4096 ? (count + 7) / 8 : 4096];
  constexpr int window = 8 * sizeof seen;
  for (int first = 0; first < count; first += window) {
    for (auto& bits : seen) bits = 0;
    for (int i = 0; i < p.rows(); ++i) {
      const int k = p.id[i] - first;
      if (k < 0 || k >= window) continue;
      const auto bit = static_cast<unsigned char>(1 << k % 8);
      if (seen[k / 8] & bit) return false;
      seen[k / 8] |= bit;
    }
  }
  return true;
}

/// Rows that the owners of a range of pairs, and their partners, may be.
template <class Case>
struct RowsOfRange {
  int owners, partners;
  RowsOfRange(const OuterList<Case>& outer, const Particles<Case>& p, int range) {
    constexpr int size = Capacity<Case>::chunk_size;
    const bool wraps = range == Capacity<Case>::chunks;
    const auto least = [](int a, int b) { return a < b ? a : b; };
    owners = wraps ? least((outer.last_at_start + 1) * size, p.rows()) : particles_in(p, range);
    const int left = p.rows() - PairRange<Case>(range).partner_base;
    partners = wraps ? left : least((outer.span + 1) * size, left);
  }
};

template <class Case>
bool is_outer_list_consistent(const OuterList<Case>& outer, const Particles<Case>& p) {
  using Cap = Capacity<Case>;
  if (outer.span < (Cap::chunks > 1 ? 1 : 0) || outer.span > Cap::span) return false;
  if (outer.last_at_start < -1 || outer.last_at_start >= Cap::chunks) return false;
  if (outer.slabs < 1 || outer.slabs > Cells<Case>::along) return false;
  if constexpr (is_line<Case>)
    for (int c = 0; c <= outer.slabs * Cells<Case>::in_slab; ++c)
      if (outer.cell_start[c] < 0 || outer.cell_start[c] > Case::particle_count) return false;
  if (outer.first_at_end < 0 || outer.first_at_end > Cap::chunks) return false;
  for (int range = 0; range < PairBatches<Case>::ranges; ++range) {
    const int pairs = outer.pairs[range], first = outer.first(range);
    const RowsOfRange<Case> rows(outer, p, range);
    if (pairs < 0 || pairs > outer.capacity(range)) return false;
    for (int k = first; k < first + Cap::batch * batches_for<Case>(pairs); ++k)
      if (!names_row_below<Case>(outer.owner[k], rows.owners) ||
          !names_row_below<Case>(outer.partner[k], rows.partners))
        return false;
  }
  return true;
}

/// Lanes in use of one range of pairs or of walls: `owners` and `partners` rows lie behind their bases.
template <class Case, class Batches>
bool are_lanes_consistent(const Batches& batches, int range, int most, int owners, int partners) {
  const int contacts = batches.count[range], first = Batches::first(range);
  if (contacts < 0 || contacts > most || !is_flag(batches.sparse[range])) return false;
  for (int b = first; b < first + batches_for<Case>(contacts); ++b) {
    if ((batches.touching[b] & ~Capacity<Case>::all_lanes) != 0) return false;
    for (int lane = 0; lane < Capacity<Case>::batch; ++lane) {
      if (!names_row_below<Case>(batches.owner[b][lane], owners)) return false;
      if constexpr (requires { batches.partner; })
        if (!names_row_below<Case>(batches.partner[b][lane], partners)) return false;
    }
  }
  return true;
}

/// With these, particles are sorted, and in a periodic pipe brought back into it, before a slice of the gas is asked
/// for that is not there.
template <class Case>
bool is_next_sort_consistent(const NearList<Case>& near, long long step) {
  if (near.sorted_at < 0 || near.sorted_at > step || near.next_decision > step + order_interval) return false;
  if (!(near.outer.margin >= 0 && near.outer.margin <= outer_margin<Case> * smallest_diameter<Case>)) return false;
  for (double travel : near.travel)
    if (!(travel >= 0)) return false;
  for (double velocity : near.frame)
    if (!(velocity - velocity == 0)) return false;
  return true;
}

template <class Case>
bool are_pairs_consistent(const PairBatches<Case>& pairs, const OuterList<Case>& outer, const Particles<Case>& p) {
  for (int range = 0; range < PairBatches<Case>::ranges; ++range) {
    const RowsOfRange<Case> rows(outer, p, range);
    if (!are_lanes_consistent<Case>(pairs, range, pairs.capacity(range), rows.owners, rows.partners)) return false;
  }
  return true;
}

template <class Case, class Walls>
bool are_walls_consistent(const Walls& walls, const Particles<Case>& p) {
  for (int chunk = 0; chunk < Capacity<Case>::chunks; ++chunk) {
    const int particles = particles_in(p, chunk);
    if (!are_lanes_consistent<Case>(walls, chunk, particles, particles, 0)) return false;
    int last = -1;
    bool increases = true;
    for_each_near_wall_in<Case>(walls, chunk, [&](int, int, int row) {
      increases = increases && row > last;
      last = row;
    });
    if (!increases) return false;
  }
  return true;
}

template <class Case>
bool are_slots_consistent(const Contacts<Case>& contacts, const Particles<Case>& p, int chunk) {
  using R = Rows<Case>;
  if (!contacts.has_rows[chunk]) return true;
  const int particles = particles_in(p, chunk);
  const auto* entry = contacts.slots[chunk];
  unsigned char seen[(Capacity<Case>::chunk_size + 7) / 8] = {};
  int found = 0;
  for (int k = 0; k <= Contacts<Case>::max_slots; ++k) {
    const int bucket = contacts.bucket[chunk][k];
    if (bucket < 0 || bucket > particles - found) return false;
    found += bucket;
    for (int q = 0; q < bucket; ++q) {
      if (!names_row_below<Case>(*entry, particles)) return false;
      const int i = static_cast<int>(*entry++ / 8);
      if (seen[i / 8] >> i % 8 & 1) return false;
      seen[i / 8] = static_cast<unsigned char>(seen[i / 8] | 1 << i % 8);
      for (int row = 0; row < 2 * k; ++row)
        if (!names_row_below<Case>(*entry++, R::ring(contacts.span + 1))) return false;
    }
  }
  return found == particles;
}

template <class Case>
bool are_zeros_zero(const Contacts<Case>& contacts) {
  bool all = true;
  contacts.for_each_row_of_zeros([&](const Real<Case>* row) {
    for (int c = 0; c < Contacts<Case>::row_width; ++c) all = all && row[c] == 0;
    if constexpr (has_partner_torques<Case>)
      for (int c = 0; c < 4; ++c) all = all && contacts.torque_at(row)[c] == 0;
  });
  for (const auto& sum : contacts.sum)
    for (const Real<Case>& component : sum) all = all && component == 0;
  return all;
}

}  // namespace detail

template <class Case>
bool is_consistent(const State<Case>& s) {
  const Contacts<Case>& contacts = s.contacts;
  if (!s.status.ok() || s.step < 0 || !s.before.kept.is_empty()) return false;
  if (!check_places(contacts, s.particles).ok() || !detail::are_particles_consistent(s.particles)) return false;
  const OuterList<Case>& outer = s.near_list.outer;
  if (!detail::is_outer_list_consistent(outer, s.particles) || contacts.span != outer.span) return false;
  if (!detail::is_next_sort_consistent(s.near_list, s.step)) return false;
  if (!detail::are_pairs_consistent<Case>(contacts.pairs, outer, s.particles)) return false;
  bool are_walls_consistent = true;
  for_each_wall(contacts, [&](const auto& walls) {
    are_walls_consistent &= detail::are_walls_consistent<Case>(walls, s.particles);
  });
  if (!are_walls_consistent) return false;
  if (!detail::are_flags(contacts.slots_are_stale) || !detail::are_flags(contacts.has_rows) ||
      !detail::are_flags(contacts.has_sums))
    return false;
  for (int chunk = 0; chunk < Capacity<Case>::chunks; ++chunk)
    if (!detail::are_slots_consistent(contacts, s.particles, chunk)) return false;
  if (!detail::are_zeros_zero(contacts)) return false;
  if constexpr (is_line<Case>)
    if (s.line.sorted_chunks != chunks_in_use(s.particles) || !detail::is_flag(s.line.feeds) ||
        !detail::are_books_consistent(s.line, s.particles))
      return false;
  if constexpr (Case::has_gas)
    if (!detail::are_flags(s.gas.floats)) return false;
  return true;
}

}  // namespace fixdem
