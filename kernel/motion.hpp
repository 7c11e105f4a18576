// Sum of what contacts give each particle, and its motion; eqs. (1)-(5), (13), (14).
//
// A particle adds the rows of its own dense contacts, subtracts the forces of the incoming ones (torques of friction
// are equal on both spheres and are added; of rolling the partner has its own, force_rows.hpp), adds what the sparse
// ones have summed already (sparse_contacts.hpp), gravity and gas, and moves while the sum is in registers:
// semi-implicit Euler, position with the new velocity. With positions held half a step ahead the same two lines are the
// leapfrog. Rows are scaled to velocity change per step; r dw = r^2 m / I times the torque row = 2.5 times it for a
// solid sphere. With several sizes rows are those of the mass of reference, and their sum counts m_0/m times.
#pragma once

#include "contacts.hpp"
#include "step_monitor.hpp"

namespace fixdem {

namespace detail {

/// Sum of rows of a particle, in as few registers as a row takes. W: lanes of the contact loop.
template <int Width, int W, class T>
struct RowSum {
  static constexpr int step = W < Width ? W : Width;
  static constexpr int parts = Width / step;
  using V = Lanes<step, T>;
  V part[parts];
  /// `column(p)`: the numbers of a row from column p on.
  template <class Column>
  FIXDEM_INLINE void start(Column&& column) {
    for (int p = 0; p < parts; ++p) part[p] = column(p * step);
  }
  template <class Column>
  FIXDEM_INLINE void add(Column&& column) {
    for (int p = 0; p < parts; ++p) part[p] = part[p] + column(p * step);
  }
};

/// Doubles of a row that are moved together.
template <class Case, int W>
inline constexpr int motion_step = W < Particles<Case>::motion_width ? W : Particles<Case>::motion_width;

/// Partial values of the monitor that the motion loop keeps in registers.
template <class Case, int W>
struct MotionMonitor {
  static constexpr int width = Particles<Case>::motion_width, step = motion_step<Case, W>;
  Partials<step, width> low, high, square_sum;
  FIXDEM_INLINE explicit MotionMonitor(const StepMonitor<Case>& monitor)
      : low(monitor.low), high(monitor.high), square_sum(monitor.square_sum) {}
  FIXDEM_INLINE void put_back(StepMonitor<Case>& monitor) const {
    low.put_back(monitor.low);
    high.put_back(monitor.high);
    square_sum.put_back(monitor.square_sum);
  }
};
template <class Case, int W>
requires(Case::energy_ledger&& Case::has_gas) struct MotionMonitor<Case, W> {
  static constexpr int width = Particles<Case>::motion_width, step = motion_step<Case, W>;
  Partials<step, width> low, high, square_sum, gas_work;
  FIXDEM_INLINE explicit MotionMonitor(const StepMonitor<Case>& monitor)
      : low(monitor.low), high(monitor.high), square_sum(monitor.square_sum), gas_work(monitor.ledger.gas_work) {}
  FIXDEM_INLINE void put_back(StepMonitor<Case>& monitor) const {
    low.put_back(monitor.low);
    high.put_back(monitor.high);
    square_sum.put_back(monitor.square_sum);
    gas_work.put_back(monitor.ledger.gas_work);
  }
};

/// Velocity change of a particle by its contacts: k own rows, less the forces of k incoming ones; `entry(s)` is the
/// offset of row s. In mixed precision rows are summed in float, then widened.
template <class Case, int W, class Count, class Entry>
FIXDEM_INLINE void sum_rows(
    Count k, Entry&& entry, const RingRows<Case>& ring,
    Lanes<motion_step<Case, W>> (&change)[Particles<Case>::motion_width / motion_step<Case, W>]) {
  constexpr int width = Particles<Case>::motion_width, step = motion_step<Case, W>;
  using Sum = RowSum<width, contact_lanes<Case, W>, Real<Case>>;
  using V = typename Sum::V;
  const auto own_at = [&](std::size_t offset) FIXDEM_INLINE_LAMBDA {
    return [row = row_at<width>(ring.rows, offset)](int p) FIXDEM_INLINE_LAMBDA { return load<V>(row + p); };
  };
  const auto incoming_at = [&](std::size_t offset) FIXDEM_INLINE_LAMBDA {
    const Real<Case>* torque = nullptr;
    if constexpr (has_partner_torques<Case>) torque = row_at<4>(ring.torques, offset);
    return [row = row_at<width>(ring.rows, offset), torque](int p)
               FIXDEM_INLINE_LAMBDA { return incoming_part<Case, V>(row, torque, p); };
  };
  Sum own{}, incoming{};
  if (k > 0) own.start(own_at(entry(0))), incoming.start(incoming_at(entry(k)));
  for (int s = 1; s < k; ++s) own.add(own_at(entry(s))), incoming.add(incoming_at(entry(k + s)));
  for (int p = 0; p < Sum::parts; ++p)
    own.part[p] = fused(load<V>(incoming_sign<Real<Case>> + p * Sum::step), incoming.part[p], own.part[p]);
  if constexpr (is_mixed<Case>) {
    alignas(64) float sum[width];
    for (int p = 0; p < Sum::parts; ++p) store(sum + p * Sum::step, own.part[p]);
    for (int p = 0; p < width / step; ++p) change[p] = load_wide<step>(sum + p * step);
  } else {
    for (int p = 0; p < width / step; ++p) change[p] = own.part[p];
  }
}

/// The time step for the columns of a position from `column` on; none for a pad that holds something.
template <class V, class Case>
FIXDEM_INLINE V time_step_of([[maybe_unused]] int column) {
  if constexpr (has_sizes<Case>) {
    alignas(64) static constexpr double steps[4] = {Case::time_step, Case::time_step, Case::time_step, 0};
    return load<V>(steps + column);
  } else {
    return splat<V>(Case::time_step);
  }
}

/// Moves one particle by the velocity change of its contacts. `offset`: its row, from the first one of the chunk.
template <class Case, int W>
FIXDEM_INLINE void move_particle(
    std::size_t offset,
    const Lanes<motion_step<Case, W>> (&change)[Particles<Case>::motion_width / motion_step<Case, W>], int base,
    Particles<Case>& particles, MotionMonitor<Case, W>& monitor) {
  constexpr int width = Particles<Case>::motion_width, step = motion_step<Case, W>;
  using V = Lanes<step>;
  using Half = Lanes<(step > 1 ? step / 2 : 1)>;  // the translation in a register of 8
  // Where a register holds the rotation too, it gains -0: that changes nothing, while +0 would turn a -0 into +0.
  alignas(64) static constexpr double gravity[8] = {Case::gravity[0] * Case::time_step,
                                                    Case::gravity[1] * Case::time_step,
                                                    Case::gravity[2] * Case::time_step,
                                                    0,
                                                    -0.0,
                                                    -0.0,
                                                    -0.0,
                                                    -0.0};
  const double* gravity_kick = gravity;
  if constexpr (is_coupled<Case>) gravity_kick = particles.coupling.kick;
  alignas(64) static constexpr double inertia[8] = {1, 1, 1, 1, 2.5, 2.5, 2.5, 2.5};  // r^2 m / I

  double* const motion = row_at<width>(particles.motion[base], offset);
  [[maybe_unused]] const V per_mass = splat<V>(has_sizes<Case> ? motion[3] : 1);  // m_0/m
  double* const position = row_at<4>(particles.position[base], offset);
  for (int p = 0; p < width / step; ++p) {
    const int column = p * step;
    const bool translates = column < 4;  // a part of rotation alone feels neither gravity nor gas
    V kick = change[p];
    if constexpr (has_sizes<Case>) kick = per_mass * kick;
    if (translates) kick = kick + load<V>(gravity_kick + column);
    [[maybe_unused]] V gas{};
    if constexpr (Case::has_gas) {
      const double* const by_gas = row_at<4>(particles.gas_kick.row[base], offset);
      if constexpr (step == 8)
        gas = __builtin_shufflevector(load<Half>(by_gas), -Half{}, 0, 1, 2, 3, 4, 5, 6, 7);
      else if (translates)
        gas = load<V>(by_gas + column);
      if (translates) kick = has_sizes<Case> ? fused(per_mass, gas, kick) : kick + gas;
    }
    const V moved = fused(load<V>(inertia + column), kick, load<V>(motion + column));
    store(motion + column, moved);
    if constexpr (is_mixed<Case>)
      store_narrow<step>(row_at<width>(particles.motion_as_float.row[base], offset) + column, moved);
    const V square = moved * moved;
    if (translates) {
      monitor.low.part[p] = min(moved, monitor.low.part[p]);
      monitor.high.part[p] = max(moved, monitor.high.part[p]);
    }
    monitor.square_sum.part[p] = square + monitor.square_sum.part[p];
    if constexpr (step == 8) {
      const Half velocity = __builtin_shufflevector(moved, moved, 0, 1, 2, 3);
      store(position, fused(velocity, time_step_of<Half, Case>(0), load<Half>(position)));
    } else if (translates) {
      store(position + column, fused(moved, time_step_of<V, Case>(column), load<V>(position + column)));
    }
    if constexpr (Particles<Case>::predicts) {
      double* const last_kick = row_at<4>(particles.last_kick.row[base], offset);
      if constexpr (step == 8)
        store(last_kick, __builtin_shufflevector(kick, kick, 0, 1, 2, 3));
      else if (translates)
        store(last_kick + column, kick);
    }
    if constexpr (Case::has_gas && Case::energy_ledger)
      monitor.gas_work.part[p] = fused(gas, fused(splat<V>(-0.5), kick, moved), monitor.gas_work.part[p]);
  }
}

/// Adds what sparse contacts have given a particle, and clears it.
template <class Case, int W>
FIXDEM_INLINE void take_sum(
    Real<Case>* sum, Lanes<motion_step<Case, W>> (&change)[Particles<Case>::motion_width / motion_step<Case, W>]) {
  constexpr int width = Particles<Case>::motion_width, step = motion_step<Case, W>;
  for (int p = 0; p < width / step; ++p) {
    if constexpr (is_mixed<Case>)
      change[p] = change[p] + load_wide<step>(sum + p * step);
    else
      change[p] = change[p] + load<Lanes<step>>(sum + p * step);
    store(sum + p * step, Lanes<step, Real<Case>>{});
  }
}

/// Moves the `particles_in_bucket` particles of one bucket with k own and k incoming rows each. `sum`: of the chunk, or
/// null where nothing is sparse.
template <class Case, int W, int k, class Offset>
FIXDEM_INLINE const Offset* move_bucket(const Offset* entry, int particles_in_bucket, int base,
                                        const RingRows<Case>& rows, Real<Case>* sum, Particles<Case>& particles,
                                        MotionMonitor<Case, W>& monitor) {
  constexpr int width = Particles<Case>::motion_width, step = motion_step<Case, W>;
  // Rows are found from their offsets alone: an address from a particle's number takes nine instructions more.
  for (int q = 0; q < particles_in_bucket; ++q, entry += 2 * k + 1) {
    Lanes<step> change[width / step];
    const Offsets<2 * k + 1> at = load_offsets<2 * k + 1>(entry);
    const auto row = [&](int s) FIXDEM_INLINE_LAMBDA { return at.value[1 + s]; };
    sum_rows<Case, W>(std::integral_constant<int, k>{}, row, rows, change);
    if (sum != nullptr) take_sum<Case, W>(row_at<width>(sum, at.value[0]), change);
    move_particle<Case, W>(at.value[0], change, base, particles, monitor);
  }
  return entry;
}

/// Rows of a particle up to which each number of them has a loop of its own: no equal spheres have more.
inline constexpr int loops_of_their_own = 16;

/// Moves those that have more.
template <class Case, int W, class Offset>
void move_long_buckets(const Offset* entry, const int* bucket, int base, const RingRows<Case>& rows, Real<Case>* sum,
                       Particles<Case>& particles, MotionMonitor<Case, W>& monitor) {
  constexpr int width = Particles<Case>::motion_width, step = motion_step<Case, W>;
  for (int k = loops_of_their_own + 1; k <= Contacts<Case>::max_slots; ++k)
    for (int q = 0; q < bucket[k]; ++q, entry += 2 * k + 1) {
      Lanes<step> change[width / step];
      sum_rows<Case, W>(
          k, [&](int s) FIXDEM_INLINE_LAMBDA { return std::size_t{entry[1 + s]}; }, rows, change);
      if (sum != nullptr) take_sum<Case, W>(row_at<width>(sum, entry[0]), change);
      move_particle<Case, W>(entry[0], change, base, particles, monitor);
    }
}

template <class Case, int W, int k, class Offset>
FIXDEM_INLINE void move_buckets_from(const Offset* entry, const int* bucket, int base, const RingRows<Case>& rows,
                                     Real<Case>* sum, Particles<Case>& particles, MotionMonitor<Case, W>& monitor) {
  entry = move_bucket<Case, W, k>(entry, bucket[k], base, rows, sum, particles, monitor);
  if constexpr (k == loops_of_their_own && k < Contacts<Case>::max_slots)
    move_long_buckets<Case, W>(entry, bucket, base, rows, sum, particles, monitor);
  else if constexpr (k < Contacts<Case>::max_slots)
    move_buckets_from<Case, W, k + 1>(entry, bucket, base, rows, sum, particles, monitor);
}

/// Moves all particles of a chunk whose contacts are all sparse.
template <class Case, int W>
FIXDEM_INLINE void move_by_sums(int particles_in_chunk, int base, Real<Case>* sum, Particles<Case>& particles,
                                MotionMonitor<Case, W>& monitor) {
  constexpr int width = Particles<Case>::motion_width, step = motion_step<Case, W>;
  for (int i = 0; i < particles_in_chunk; ++i) {
    Lanes<step> change[width / step] = {};
    take_sum<Case, W>(sum + i * width, change);
    move_particle<Case, W>(static_cast<std::size_t>(8 * i), change, base, particles, monitor);
  }
}

}  // namespace detail

/// Sums what the contacts of every particle of one chunk give it, and moves it. `rows`: the ring of the step.
template <class Case, int W>
void move(Contacts<Case>& contacts, Particles<Case>& particles, int chunk, const Real<Case>* rows,
          StepMonitor<Case>& totals) {
  const int base = chunk * Capacity<Case>::chunk_size;
  detail::MotionMonitor<Case, W> monitor(totals);
  if (contacts.has_rows[chunk])
    detail::move_buckets_from<Case, W, 0>(contacts.slots[chunk], contacts.bucket[chunk], base,
                                          {rows, contacts.torque_at(rows)},
                                          contacts.has_sums[chunk] ? contacts.sum[base] : nullptr, particles, monitor);
  else
    detail::move_by_sums<Case, W>(particles_in(particles, chunk), base, contacts.sum[base], particles, monitor);
  monitor.put_back(totals);
}

}  // namespace fixdem
