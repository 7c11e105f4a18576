// Whether a state that comes from outside (a checkpoint's bytes) may be run: no number in it leads out of its array.
//
// A run keeps these promises by itself and checks none of them in a step, so whoever copies bytes into a simulation
// asks here first. What is looked at, array by array:
//   particles  id is a permutation; places are finite, inside the pipe and almost in order; motion is finite
//   near list  end_of_reach stays within the candidates that a listing gathers
//   pairs      counts fit; owners and partners of all lanes in use are rows of their range; bits of lanes that exist
//   walls      the same, and every particle once, in increasing order
//   slots      every particle of a chunk once; rows lie in the ring; the row of zeros is zero
//   the rest   flags are true or false, the step is a possible one, there is no fault
// Values (histories, ledgers, speeds) are not judged: they may make a run stop with a fault, never read elsewhere. What
// is written anew before it is used (scratch, kept histories, slices of the gas) is not looked at. A new array of
// indices gets a line above and its check below; tests/consistency_test.cpp changes bytes at random and runs on.
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

/// The row that an offset names, or -1 where it names none.
template <class Case>
int row_named(typename Rows<Case>::Offset offset) {
  return offset % 8 == 0 ? Rows<Case>::number(offset) : -1;
}
template <class Case>
bool names_row_below(typename Rows<Case>::Offset offset, int end) {
  const int row = row_named<Case>(offset);
  return row >= 0 && row < end;
}

template <class Case>
bool are_particles_consistent(const Particles<Case>& p) {
  constexpr int count = Case::particle_count;
  if (!check_places(p).ok()) return false;
  double farthest = p.position[0][2];
  for (int i = 0; i < count; ++i) {
    const double z = p.position[i][2];
    if (p.id[i] < 0 || p.id[i] >= count) return false;
    if (p.image[i] > 1 << 30 || p.image[i] < -(1 << 30)) return false;
    if (!(z >= -Case::diameter && z <= Case::pipe_length + Case::diameter)) return false;
    if (!(z >= farthest - Case::diameter)) return false;
    farthest = max(z, farthest);
  }
  // A permutation: sums of the numbers and of their squares would not tell; marks need a bit for each particle.
  unsigned char seen[(count + 7) / 8 < 4096 ? (count + 7) / 8 : 4096];
  constexpr int window = 8 * sizeof seen;
  for (int first = 0; first < count; first += window) {
    for (auto& bits : seen) bits = 0;
    for (int i = 0; i < count; ++i) {
      const int k = p.id[i] - first;
      if (k < 0 || k >= window) continue;
      const auto bit = static_cast<unsigned char>(1 << k % 8);
      if (seen[k / 8] & bit) return false;
      seen[k / 8] |= bit;
    }
  }
  return true;
}

template <class Case>
bool is_near_list_consistent(const NearList<Case>& near) {
  constexpr int count = Case::particle_count, copies = NearList<Case>::copies;
  for (int i = 0; i < count; ++i) {
    const int end = near.end_of_reach[i];
    if (end <= i || end > count + copies) return false;
    if (copies < count && end - 1 - i >= Capacity<Case>::chunk_size) return false;
  }
  return is_flag(near.in_haste);
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

template <class Case>
bool are_pairs_consistent(const PairBatches<Case>& pairs) {
  using Cap = Capacity<Case>;
  for (int range = 0; range < PairBatches<Case>::ranges; ++range) {
    const bool wraps = range == Cap::chunks;
    const int left = Case::particle_count - PairRange<Case>(range).partner_base;
    const int owners = wraps ? NearList<Case>::copies : particles_in<Case>(range);
    const int partners = left < 2 * Cap::chunk_size ? left : 2 * Cap::chunk_size;
    if (!are_lanes_consistent<Case>(pairs, range, Cap::chunk_pairs, owners, partners)) return false;
  }
  return true;
}

template <class Case, class Walls>
bool are_walls_consistent(const Walls& walls) {
  for (int chunk = 0; chunk < Capacity<Case>::chunks; ++chunk) {
    const int particles = particles_in<Case>(chunk);
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
bool are_slots_consistent(const Contacts<Case>& contacts, int chunk) {
  using R = Rows<Case>;
  const int particles = particles_in<Case>(chunk);
  bool seen[Capacity<Case>::chunk_size] = {};
  const auto* entry = contacts.slots[chunk];
  int found = 0;
  for (int k = 0; k <= Contacts<Case>::max_slots; ++k) {
    const int bucket = contacts.bucket[chunk][k];
    if (bucket < 0 || bucket > particles - found) return false;
    found += bucket;
    for (int q = 0; q < bucket; ++q) {
      if (!names_row_below<Case>(*entry, particles) || seen[R::number(*entry)]) return false;
      seen[R::number(*entry++)] = true;
      for (int row = 0; row < 2 * k; ++row)
        if (!names_row_below<Case>(*entry++, R::zero + 1)) return false;
    }
  }
  return found == particles;
}

template <class Case>
bool are_rows_of_zeros_zero(const Contacts<Case>& contacts) {
  constexpr int width = Contacts<Case>::row_width;
  for (const auto& ring : contacts.rows)
    for (int c = 0; c < width; ++c)
      if (ring[Rows<Case>::zero * width + c] != 0) return false;
  return true;
}

}  // namespace detail

template <class Case>
bool is_consistent(const State<Case>& s) {
  using D = Derived<Case>;
  if (!s.status.ok() || s.step < 0) return false;
  if (!detail::are_particles_consistent(s.particles)) return false;
  if (!detail::is_near_list_consistent(s.near_list)) return false;
  if (!detail::are_pairs_consistent<Case>(s.contacts.pairs)) return false;
  if constexpr (Case::has_wall)
    if (!detail::are_walls_consistent<Case>(s.contacts.pipe)) return false;
  if constexpr (D::has_ends)
    if (!detail::are_walls_consistent<Case>(s.contacts.ends)) return false;
  for (int chunk = 0; chunk < Capacity<Case>::chunks; ++chunk)
    if (!detail::are_slots_consistent(s.contacts, chunk)) return false;
  if (!detail::are_flags(s.contacts.slots_are_stale) || !detail::are_rows_of_zeros_zero(s.contacts)) return false;
  if constexpr (Case::has_gas)
    if (!detail::are_flags(s.gas.floats)) return false;
  return true;
}

}  // namespace fixdem
