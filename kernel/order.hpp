// Order along the pipe: periodic wrap and renumbering of the particles by z.
//
// Neighbours in space become neighbours in memory. The order is total (z, then input number), so it does not depend on
// how it was reached. Shell sort from a wide gap for an arrangement in any order; one insertion pass for the almost
// sorted sequence of a running simulation. Rows move whole; nothing is allocated.
#pragma once

#include "particles.hpp"

namespace fixdem {

/// Periods from the pipe beyond which a place is refused: it takes a broken state to get there between two renewals.
inline constexpr double farthest_place = 1000;

/// Brings z into [0, length) of a periodic pipe and counts the crossings.
template <class Case>
void wrap_into_pipe(Particles<Case>& particles) {
  for (int i = 0; i < Case::particle_count; ++i) {
    double& z = particles.position[i][2];
    while (z < 0) z += Case::pipe_length, --particles.image[i];
    while (z >= Case::pipe_length) z -= Case::pipe_length, ++particles.image[i];
  }
}

namespace detail {

template <class T>
void exchange(T& a, T& b) {
  const T kept = a;
  a = b;
  b = kept;
}

template <class Case>
void exchange_particles(Particles<Case>& p, int a, int b) {
  for (int c = 0; c < 4; ++c) exchange(p.position[a][c], p.position[b][c]);
  for (int c = 0; c < Particles<Case>::motion_width; ++c) exchange(p.motion[a][c], p.motion[b][c]);
  if constexpr (Particles<Case>::predicts)
    for (int c = 0; c < 4; ++c) exchange(p.last_kick.row[a][c], p.last_kick.row[b][c]);
  if constexpr (Case::has_gas)
    for (int c = 0; c < 4; ++c) exchange(p.gas_kick.row[a][c], p.gas_kick.row[b][c]);
  exchange(p.id[a], p.id[b]);
  exchange(p.image[a], p.image[b]);
}

}  // namespace detail

/// Renumbers by (z, id). `first_gap`: 1 when almost sorted, the particle count for any order.
template <class Case>
void sort_along_pipe(Particles<Case>& particles, int first_gap) {
  const auto before = [&](int a, int b) {
    const double za = particles.position[a][2], zb = particles.position[b][2];
    return za != zb ? za < zb : particles.id[a] < particles.id[b];
  };
  for (int gap = first_gap;; gap = gap * 4 / 9 > 1 ? gap * 4 / 9 : 1) {
    for (int i = gap; i < Case::particle_count; ++i)
      for (int j = i; j >= gap && before(j, j - gap); j -= gap) detail::exchange_particles(particles, j, j - gap);
    if (gap == 1) return;
  }
}

}  // namespace fixdem
