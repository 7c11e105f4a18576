// What a simulation takes of memory, whether that is within the case's budget, and how full its arrays have been.
//
// All of it is known at compile time but the last. A case may set a budget (`[capacity] memory`, bytes): one that is
// exceeded does not compile, and the compiler's message lists what takes the space, as the arguments of `MemoryBudget`.
#pragma once

#include "step.hpp"

namespace fixdem {

/// Bytes by purpose; the sum of all is the size of the simulation less some flags.
template <class Case>
struct MemoryUse {
  using D = Derived<Case>;
  using C = Contacts<Case>;
  using Pairs = PairBatches<Case>;
  template <class T>
  static constexpr long long bytes_of = __is_empty(T) ? 0 : sizeof(T);

  static constexpr long long particles = sizeof(Particles<Case>);
  static constexpr long long pair_histories = bytes_of<decltype(Pairs::history)>;
  static constexpr long long pairs = sizeof(Pairs) - pair_histories;
  static constexpr long long walls = bytes_of<decltype(C::pipe)> + bytes_of<decltype(C::ends)>;
  static constexpr long long force_rows = sizeof(C::rows);
  static constexpr long long slots = static_cast<long long>(sizeof(C)) - sizeof(Pairs) - walls - force_rows;
  static constexpr long long near_list = sizeof(NearList<Case>);
  static constexpr long long listing = sizeof(ListingScratch<Case>) + sizeof(KeptOrPlaced<Case>);
  static constexpr long long gas = bytes_of<GasSlices<Case>>;
  static constexpr long long state = sizeof(State<Case>);
};

namespace memory {
// Names for the compiler's message.
template <long long bytes>
struct allowed;
template <long long bytes>
struct needed;
template <long long bytes>
struct particles;
template <long long bytes>
struct near_pairs;
template <long long bytes>
struct histories_of_pairs;
template <long long bytes>
struct near_walls;
template <long long bytes>
struct force_rows;
template <long long bytes>
struct who_sums_which_rows;
template <long long bytes>
struct near_list;
template <long long bytes>
struct listing_anew;
template <long long bytes>
struct gas;
template <long long bytes>
struct all_else;
}  // namespace memory

template <bool fits, class... Bytes>
struct MemoryBudget {
  static_assert(fits,
                "fixdem: the simulation exceeds [capacity] memory; the arguments of MemoryBudget are bytes by purpose: "
                "raise memory, or lower [capacity] neighbours, tile_steps or [particles] count, or do without "
                "[output] energy_ledger");
  static constexpr bool ok = fits;
};

/// Whether a simulation of `size` bytes is within the budget of its case, if that sets one.
template <class Case, long long size>
constexpr bool within_budget() {
  if constexpr (requires { Case::memory_budget; }) {
    using M = MemoryUse<Case>;
    constexpr long long rest = size - M::particles - M::pairs - M::pair_histories - M::walls - M::force_rows -
                               M::slots - M::near_list - M::listing - M::gas;
    return MemoryBudget<(size <= Case::memory_budget), memory::allowed<Case::memory_budget>, memory::needed<size>,
                        memory::particles<M::particles>, memory::near_pairs<M::pairs>,
                        memory::histories_of_pairs<M::pair_histories>, memory::near_walls<M::walls>,
                        memory::force_rows<M::force_rows>, memory::who_sums_which_rows<M::slots>,
                        memory::near_list<M::near_list>, memory::listing_anew<M::listing>, memory::gas<M::gas>,
                        memory::all_else<rest>>::ok;
  }
  return true;
}

/// A capacity, and the maximum use made of it so far.
struct HighWater {
  const char* name;
  int limit, high_water;
};

namespace detail {

inline constexpr int high_water_marks = 5;

template <class Case>
HighWater high_water(const NearList<Case>& near, int k) {
  using Cap = Capacity<Case>;
  switch (k) {
    case 0:
      return {"neighbours", Cap::neighbours, near.most_neighbours};
    case 1:
      return {"chunk_pairs", Cap::chunk_pairs, near.most_chunk_pairs};
    case 2:
      return {"wrap_pairs", Derived<Case>::is_periodic ? Cap::wrap_pairs : 0, near.most_wrap_pairs};
    case 3:
      return {"histories", keeps_history<Case> ? Cap::histories : 0, near.most_histories};
    default:
      return {"in_reach", Cap::in_reach, near.most_reach};
  }
}

}  // namespace detail

}  // namespace fixdem
