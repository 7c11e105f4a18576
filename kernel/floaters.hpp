// Which particles float: no other centre within 1.1 d, and not touching the lower half of the pipe wall.
//
// Only particles without a listed near pair are looked at: a listed pair was within d + margin when the list was made
// and is within d + 2 margin < 1.1 d now. For the others the neighbours along z are compared, from the nearest on,
// until z differs by more than the reach and what the order along the pipe may have changed since it was made. So the
// answer depends on the present positions alone, never on when the list was renewed.
#pragma once

#include "gas_slices.hpp"

namespace fixdem {

namespace detail {

/// Whether some centre on one side of particle i (step = +1 or -1 along the order) lies within the reach.
template <class Case>
bool has_company(const Particles<Case>& p, int i, int step) {
  constexpr double reach = near_reach * Case::diameter;
  constexpr double window = reach + 2 * order_slack * Case::diameter;  // both this and the next one may have moved
  const double* a = p.position[i];
  double shift = 0;
  for (int j = i + step, seen = 1; seen < Case::particle_count; j += step, ++seen) {
    if (j < 0 || j >= Case::particle_count) {
      if constexpr (!Derived<Case>::is_periodic) return false;
      j = j < 0 ? Case::particle_count - 1 : 0;
      shift = step * Case::pipe_length;
    }
    const double* b = p.position[j];
    const double dx = b[0] - a[0], dy = b[1] - a[1], dz = b[2] + shift - a[2];
    if (step * dz > window) return false;
    if (dx * dx + dy * dy + dz * dz < reach * reach) return true;
  }
  return false;
}

}  // namespace detail

/// Whether a particle at this place of a section touches the lower half of the pipe wall.
template <class Case>
bool is_on_bottom(double x, double y) {
  return y < 0 && sqrt(x * x + y * y) - (Derived<Case>::pipe_radius - Derived<Case>::radius) > 0;
}

template <class Case>
void find_floaters(GasSlices<Case>& gas, const Particles<Case>& p, const Contacts<Case>& contacts) {
  static_assert(1 + 2 * greatest_margin < near_reach, "fixdem: near pairs must stay within the floaters' reach");
  for (int i = 0; i < Case::particle_count; ++i) {
    const double* x = p.position[i];
    gas.floats[p.id[i]] = contacts.near_count[i] == 0 && !is_on_bottom<Case>(x[0], x[1]) &&
                          !detail::has_company(p, i, 1) && !detail::has_company(p, i, -1);
  }
}

}  // namespace fixdem
