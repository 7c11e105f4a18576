// Order of the particles: periodic wrap, and renumbering by cells.
//
// Neighbours in space become neighbours in memory: cells are numbered slab by slab along the pipe, in a slab by y and
// then x, and particles by cell, in a cell by input number. So the order is that of the places alone. A counting sort;
// rows then move once each, along the cycles of the permutation. Nothing is allocated.
#pragma once

#include "near_list.hpp"

namespace fixdem {

/// Periods from the pipe beyond which a place is refused: it takes a broken state to get there between two sorts.
inline constexpr double farthest_place = 1000;

/// Brings z into [0, length) of a periodic pipe and counts the crossings.
template <class Case>
void wrap_into_pipe(Particles<Case>& particles) {
  for (int i = 0; i < particles.rows(); ++i) {
    double& z = particles.position[i][2];
    while (z < 0) z += Case::pipe_length, --particles.image[i];
    while (z >= Case::pipe_length) z -= Case::pipe_length, ++particles.image[i];
  }
}

namespace detail {

/// Cell of a place; outside the pipe, the nearest one at its surface.
template <class Case>
int cell_at(const double* x) {
  using C = Cells<Case>;
  const auto part = [](double from_start, double length, int cells) {
    const double n = from_start * (cells / length);
    return n < 1 ? 0 : (n < cells - 1 ? static_cast<int>(n) : cells - 1);
  };
  const int ix = part(x[0] + C::width / 2, C::width, C::across), iy = part(x[1] + C::width / 2, C::width, C::across);
  return (part(x[2], Case::pipe_length, C::along) * C::across + iy) * C::across + ix;
}

/// Slabs of cells up to the foremost particle: those of a line that fills are few.
template <class Case>
int slabs_up_to_foremost(const Particles<Case>& p) {
  if constexpr (!is_line<Case>) return Cells<Case>::along;
  double front = 0;
  for (int i = 0; i < p.rows(); ++i) front = max(p.position[i][2], front);
  const double x[3] = {0, 0, front};
  return cell_at<Case>(x) / Cells<Case>::in_slab + 1;
}

/// All that is renumbered of a particle, except the copy of its motion in floats.
template <class Case>
struct WholeParticle {
  static constexpr int width = Particles<Case>::motion_width;
  double position[4], motion[width], last_kick[4], gas_kick[4];
  int id, image;

  WholeParticle(const Particles<Case>& p, int i) : id(p.id[i]), image(p.image[i]) {
    __builtin_memcpy(position, p.position[i], sizeof position);
    __builtin_memcpy(motion, p.motion[i], sizeof motion);
    if constexpr (Particles<Case>::predicts) __builtin_memcpy(last_kick, p.last_kick.row[i], sizeof last_kick);
    if constexpr (Case::has_gas) __builtin_memcpy(gas_kick, p.gas_kick.row[i], sizeof gas_kick);
  }
  void put(Particles<Case>& p, int i) const {
    __builtin_memcpy(p.position[i], position, sizeof position);
    __builtin_memcpy(p.motion[i], motion, sizeof motion);
    if constexpr (Particles<Case>::predicts) __builtin_memcpy(p.last_kick.row[i], last_kick, sizeof last_kick);
    if constexpr (Case::has_gas) __builtin_memcpy(p.gas_kick.row[i], gas_kick, sizeof gas_kick);
    p.id[i] = id, p.image[i] = image;
  }
};

}  // namespace detail

/// Renumbers by (cell, input number).
template <class Case>
void sort_by_cell(OuterList<Case>& outer, SortScratch<Case>& scratch, Particles<Case>& p) {
  outer.slabs = detail::slabs_up_to_foremost(p);
  const int cells = outer.slabs * Cells<Case>::in_slab;
  const int count = p.rows();
  int *start = outer.cell_start, *source = scratch.source;
  for (int c = 0; c <= cells; ++c) start[c] = 0;
  for (int i = 0; i < count; ++i) ++start[detail::cell_at<Case>(p.position[i]) + 1];
  for (int c = 0; c < cells; ++c) start[c + 1] += start[c];
  for (int i = 0; i < count; ++i) source[start[detail::cell_at<Case>(p.position[i])]++] = i;
  for (int c = cells; c > 0; --c) start[c] = start[c - 1];
  start[0] = 0;
  for (int c = 0; c < cells; ++c)
    for (int i = start[c] + 1; i < start[c + 1]; ++i) {
      const int moved = source[i];
      int j = i;
      for (; j > start[c] && p.id[moved] < p.id[source[j - 1]]; --j) source[j] = source[j - 1];
      source[j] = moved;
    }
  for (int first = 0; count > 1 && first < count; ++first) {
    if (source[first] == first) continue;
    const detail::WholeParticle<Case> kept(p, first);
    int i = first;
    for (int from = source[i]; from != first; from = source[i]) {
      detail::WholeParticle<Case>(p, from).put(p, i);
      source[i] = i;
      i = from;
    }
    kept.put(p, i);
    source[i] = i;
  }
}

}  // namespace fixdem
