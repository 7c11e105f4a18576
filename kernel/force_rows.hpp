// Force rows: how those of a step are numbered, what a partner takes of them, and those that are added later.
//
// A row is the velocity change that a contact gives its owner: force, pad, torque, pad; four numbers without rotation.
// The same row serves the partner with the opposite force. How rows come to be and who sums them: contacts.hpp.
#pragma once

#include "capacity.hpp"
#include "contact_law.hpp"
#include "particles.hpp"
#include "rows.hpp"
#include "surfaces.hpp"

namespace fixdem {

/// Walls that a particle can touch at the same time, each at one place.
template <class Case>
inline constexpr int kinds_of_wall = (PipeSurface<Case>::is_present ? 1 : 0) + (EndSurfaces<Case>::is_present ? 1 : 0);

/// Whether the torques of a pair differ. Its forces are opposite and its torques of friction are equal, so that one row
/// serves both; the torques of rolling are opposite, and a pair then has nine numbers.
template <class Case>
inline constexpr bool has_partner_torques = ContactLaw<Case, false>::has_rolling;

namespace detail {
/// Torques on the partners: row k belongs to force row k, which has that on the owner. Half of a second force row,
/// which took as long.
template <class Case, int Count, bool present = has_partner_torques<Case>>
struct PartnerTorques {
  alignas(64) Real<Case> row[Count][4];
  Real<Case>* at(std::ptrdiff_t number) { return row[number]; }
  const Real<Case>* at(std::ptrdiff_t number) const { return row[number]; }
};
template <class Case, int Count>
struct PartnerTorques<Case, Count, false> {
  Real<Case>* at(std::ptrdiff_t) { return nullptr; }
};
}  // namespace detail

/// Numbering of the force rows of a step: the pairs across the ends, a row of zeros, and as many chunks in turn as the
/// span makes necessary.
template <class Case>
struct Rows {
  using Cap = Capacity<Case>;
  using D = Derived<Case>;
  static constexpr int of_chunk = Cap::chunk_pairs + kinds_of_wall<Case> * Cap::chunk_size;
  static constexpr int wrap_first = 0;
  static constexpr int zero = D::is_periodic ? Cap::wrap_pairs : 0;
  static constexpr int chunks_first = zero + Cap::batch;
  /// Rows of a ring in which the chunks have so many places; those kept for the second phase of a tile come after it.
  static constexpr int ring(int places) { return chunks_first + places * of_chunk; }

  using Offset = RowOffset<(Cap::span + 2) * Cap::chunk_size>;  ///< of a particle, from the first of a chunk on
  using SlotOffset = RowOffset<ring(Cap::span + 1)>;            ///< of a force row, or a particle
  static constexpr Offset offset(int number) { return static_cast<Offset>(8 * number); }
  static constexpr SlotOffset slot_offset(int number) { return static_cast<SlotOffset>(8 * number); }
  static constexpr int number(Offset offset) { return static_cast<int>(offset / 8); }

  /// First particle that partners across the ends are counted from: they lie in one slab of cells, the last.
  static constexpr int wrap_chunk = Cap::chunks > Cap::span + 2 ? Cap::chunks - Cap::span - 2 : 0;
  static constexpr int wrap_base = wrap_chunk * Cap::chunk_size;
};

/// By what the row of a contact counts for its partner: the force is opposite, the torque equal.
template <class T>
alignas(64) inline constexpr T incoming_sign[8] = {-1, -1, -1, -1, 1, 1, 1, 1};

namespace detail {
/// What a partner takes from column p of a force row on, but for the sign: its torque is in `torque` if it has one of
/// its own.
template <class Case, class V, class T>
FIXDEM_INLINE V incoming_part(const T* row, [[maybe_unused]] const T* torque, int p) {
  if constexpr (!has_partner_torques<Case>)
    return load<V>(row + p);
  else if constexpr (sizeof(V) == 8 * sizeof(T))
    return joined<V>(row, torque);
  else
    return load<V>(p < 4 ? row + p : torque + p - 4);
}
}  // namespace detail

/// Where the force rows of a ring are, and the torques on partners that belong to them.
template <class Case>
struct RingRows {
  const Real<Case>*rows, *torques;
};

/// Force rows of sparse contacts that are added later to the sums of their particles, from the last row of a region
/// backwards: dense contacts have the first ones.
template <class Case>
struct RowsForLater {
  static constexpr int width = Particles<Case>::motion_width;
  static constexpr std::uint32_t nobody = ~std::uint32_t{};  ///< in place of a partner: a wall
  Real<Case>* last_row;
  Real<Case>* last_torque;                   ///< on the partner, where it has one of its own
  std::uint32_t *last_owner, *last_partner;  ///< 8 times the particle's number
  int* count;

  void put(const Real<Case> (&values)[width], [[maybe_unused]] const Real<Case>* torque, std::uint32_t owner,
           std::uint32_t partner) const {
    for (int c = 0; c < width; ++c) last_row[c - *count * width] = values[c];
    if constexpr (has_partner_torques<Case>)
      if (torque != nullptr)  // of a pair
        for (int c = 0; c < 4; ++c) last_torque[c - *count * 4] = torque[c];
    last_owner[-*count] = owner, last_partner[-*count] = partner;
    ++*count;
  }
};

}  // namespace fixdem
