// Which particles float: no other centre within 1.1 (r_i + r_j), and not touching the lower half of the pipe wall.
// None do in a steep pipe (gas_steep.hpp).
//
// The outer list still holds all such pairs (outer_list.hpp), and each is looked at as it lies now. So the
// answer depends on the present positions alone, never on when the list was made.
#pragma once

#include "gas_slices.hpp"
#include "outer_list.hpp"

namespace fixdem {

/// Whether a particle at this place of a section touches the lower half of the pipe wall.
template <class Case>
bool is_on_bottom(double x, double y, double radius = Derived<Case>::largest_radius) {
  const double place[] = {x, y};
  return height_of<Case>(place) < 0 && sqrt(x * x + y * y) - (Derived<Case>::pipe_radius - radius) > 0;
}

template <class Case, int W>
void find_floaters(GasSlices<Case>& gas, const Particles<Case>& p, const OuterList<Case>& outer) {
  constexpr bool can_float = !Derived<Case>::is_steep;
  for (int i = 0; i < p.rows(); ++i) {
    if (!p.is_present(i)) continue;
    const double* x = p.position[i];
    gas.floats[p.id[i]] = can_float && !is_on_bottom<Case>(x[0], x[1], radius_at<Case>(x));
  }
  if constexpr (!can_float) return;
  for (int range = 0; range < PairBatches<Case>::ranges; ++range) {
    const PairRange<Case> at(range);
    const auto *owners = outer.owner + outer.first(range), *partners = outer.partner + outer.first(range);
    for (int k = 0; k < outer.pairs[range]; k += W) {
      const auto s = separation_of_pairs<Case, W>(p.position[at.partner_base], partners + k, p.position[at.owner_base],
                                                  owners + k, at.shift);
      const Lanes<W> reach = near_reach * reach_of<Case>(s, largest_diameter<Case>);
      // Behind the last pair of a range it is repeated.
      for (unsigned near = bits_below(s.gap_square, reach * reach); near != 0; near &= near - 1) {
        const int pair = k + __builtin_ctz(near);
        gas.floats[p.id[at.owner_base + Rows<Case>::number(owners[pair])]] = false;
        gas.floats[p.id[at.partner_base + Rows<Case>::number(partners[pair])]] = false;
      }
    }
  }
}

}  // namespace fixdem
