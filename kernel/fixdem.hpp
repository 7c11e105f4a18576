// The public face: one simulation of one case.
//
//   static fixdem::Simulation<fixdem::cases::settle> simulation;   // all of its memory, known at compile time
//   for (int id = 0; id < count; ++id) simulation.place(id, particle);
//   Status status = simulation.start();
//   status = simulation.run(100000);
//
// A case is a struct of constants, generated from a case file by tools/casegen (kernel/case.hpp says what is in it).
// The object is large (0.5 to 1 kB per particle) and belongs in static storage. No call allocates, throws or prints.
// Results are the same bytes for the same case, lane width and compiler notwithstanding.
#pragma once

#include "consistency.hpp"
#include "memory.hpp"
#include "observe.hpp"
#include "refusals.hpp"
#include "restored_history.hpp"

namespace fixdem {

template <class Case, int W = native_lanes>
class Simulation {
  static_assert(Checked<Case>::ok);
  using D = Derived<Case>;

 public:
  using case_type = Case;
  static constexpr int count = Case::particle_count;  ///< in a line: the most that are present at once
  static constexpr int start_count = detail::start_count<Case>;

  /// Places particle `id` (0 .. start_count-1). All are placed before start(); values in SI units.
  /// The present state stays until then.
  void place(int id, const Particle& particle) {
    s_.before.placed[id] = particle;
    is_placed_[id] = is_placing_ = 1;
  }

  /// Sorts, checks and lists; clears contact histories, clocks and ledgers. A fault names what cannot start. All
  /// particles are placed anew before each start.
  Status start() {
    is_placing_ = 1;
    for (int i = 0; i < start_count; ++i)
      if (is_placed_[i] != 1) return s_.status = {Fault::not_placed, i, 0, 0, 1};
    s_.step = s_.histories_given_at = 0;
    s_.status = {};
    s_.deepest = 0;
    for (auto& monitor : s_.monitor) monitor = {};
    s_.near_list.most_neighbours = s_.near_list.most_chunk_pairs = s_.near_list.most_wrap_pairs = 0;
    s_.near_list.most_reach = s_.near_list.most_histories = 0;
    s_.near_list.listings = s_.near_list.sorts = 0;
    if constexpr (is_line<Case>) open_line();
    for (int i = 0; i < start_count; ++i) {
      s_.particles.id[i] = i;
      s_.particles.image[i] = 0;
      const Particle& from = s_.before.placed[i];
      double* x = s_.particles.position[i];
      double* v = s_.particles.motion[i];
      s_.particles.clear_row(i);
      for (int c = 0; c < 3; ++c) x[c] = from.position[c], v[c] = from.velocity[c];
      if constexpr (D::has_rotation)
        for (int c = 0; c < 3; ++c) v[4 + c] = radius_of<Case>(i) * from.angular_velocity[c];
      if constexpr (holds_positions_ahead<Case>)
        for (int c = 0; c < 3; ++c) x[c] += 0.5 * Case::time_step * v[c];
      set_size(s_.particles, i);
      if (s_.status.ok() && !s_.particles.is_present(i))
        s_.status = {Fault::outside_pipe, i, 0, x[2], Case::pipe_length};
    }
    forget_placed();
    clear_contacts();
    if (!s_.status.ok()) return s_.status;
    s_.status = renew<Case, W>(s_.contacts, s_.near_list, s_.particles, s_.before.kept, s_.scratch, s_.line, 0);
    if constexpr (takes_impulses<Case>) detail::mark_contacts_as_found(s_.contacts);
    if (s_.status.ok()) s_.status = deepest();
    if constexpr (is_coupled<Case>) s_.particles.coupling.reset();
    for (int c = 0; c < 3; ++c) start_place_[c] = place_sum(c);
    return s_.status;
  }

  /// Sets the history of a contact that start() has listed; metres, or newtons with the incremental forms. Partner as
  /// in Contact. Contacts that are not near are ignored: they have no history. With impulses it is that of the time of
  /// the start; otherwise that of the last force before it. `rolling`: likewise that of rolling, zero without it.
  void restore_history(int owner, int partner, const double* history,
                       [[maybe_unused]] const double* rolling = nullptr) {
    if constexpr (D::has_rotation)
      detail::restore_history(s_, row_of(owner), partner >= 0 ? row_of(partner) : partner, history, rolling);
  }

  /// Advances by `steps` time steps, or to the first fault. After a fault it does nothing more.
  Status run(long long steps) {
    static_assert(within_budget<Case, sizeof(Simulation)>());
    if (is_placing_ != 0) forget_placed();
    advance<Case, W>(s_, steps);
    if (s_.status.fault == Fault::overlap && s_.status.particle < 0) s_.status.particle = deepest().particle;
    return s_.status;
  }

  Status status() const { return s_.status; }
  long long step() const { return s_.step; }
  double time() const { return static_cast<double>(s_.step) * Case::time_step; }

  // Who is there: numbers from 0 to count-1. In a line a number is a place in the arrays that is used again by whoever
  // is fed after a particle has left; the serial number counts in order of entry, from those at the start on.
  long long present() const {
    if constexpr (is_line<Case>) return line().present;
    return count;
  }
  bool is_present(int id) const { return find_row(id) >= 0; }
  long long serial([[maybe_unused]] int id) const {
    if constexpr (is_line<Case>) return s_.particles.slots.serial[id];
    return id;
  }
  /// Number in the table of sizes (sizes.hpp).
  int kind(int id) const { return s_.particles.kind(row_of(id)); }
  LineTotals line() const requires is_line<Case> { return line_totals(s_); }

  /// Particle by number: position and velocity at the same time, z within a periodic pipe.
  Particle particle(int id) const {
    const int i = row_of(id);
    const double *x = s_.particles.position[i], *v = s_.particles.motion[i];
    Particle p{{x[0], x[1], x[2]}, {v[0], v[1], v[2]}, {}};
    if constexpr (holds_positions_ahead<Case>)
      for (int c = 0; c < 3; ++c) p.position[c] -= 0.5 * Case::time_step * v[c];
    if constexpr (D::is_periodic) p.position[2] -= turns(p.position[2]) * Case::pipe_length;
    if constexpr (D::has_rotation)
      for (int c = 0; c < 3; ++c) p.angular_velocity[c] = v[4 + c] / radius_at<Case>(x);
    return p;
  }

  /// Crossings of the periodic ends so far: unwrapped z = particle(id).position[2] + image(id) * length.
  int image(int id) const {
    const int i = row_of(id);
    double z = s_.particles.position[i][2];
    if constexpr (holds_positions_ahead<Case>) z -= 0.5 * Case::time_step * s_.particles.motion[i][2];
    return s_.particles.image[i] + (D::is_periodic ? turns(z) : 0);
  }

  /// Visits every contact with overlap: f(const Contact&).
  template <class F>
  void for_each_contact(F&& f) const {
    detail::for_each_observed(s_.contacts, s_.particles, [&](const detail::Observed<Case>& o) { f(o.contact); });
  }

  /// Maximum overlap of all contacts in all steps so far, m.
  double deepest_overlap() const { return s_.deepest; }

  Observation observe() const { return fixdem::observe(s_); }

  /// Where the energy is and where it went. Dissipation and gas work are zero in a case without energy ledger.
  Energy energy() const {
    Energy e = energy_without_gravity(s_);
    e.gravity_work = D::reference_mass * work_of_gravity();
    if constexpr (is_line<Case>) {
      const Passage left = s_.line.all_left();
      e.entered = s_.line.entered.kinetic, e.left_with = left.kinetic + left.elastic;
    }
    return e;
  }

  /// Sum of the forces that particles exert on the pipe's wall or one of its ends, as for_each_contact sees them, N.
  Vec3<double> force_on(int wall) const { return detail::force_on(s_, wall); }

  // From the next step on; coupled cases only (coupling.hpp). start() returns to what the case says.
  void set_gravity(const double (&gravity)[3])  ///< m/s2
      requires is_coupled<Case> {
    s_.particles.coupling.earlier_work = work_of_gravity();
    for (int c = 0; c < 3; ++c) start_place_[c] = place_sum(c);
    s_.particles.coupling.set_gravity(gravity);
  }
  void set_gas_velocity(double bulk_velocity)  ///< m/s; at the next update of the gas
      requires(is_coupled<Case>&& Case::has_gas && !has_inlet_pressure<Case> && !has_blower<Case>) {
    s_.particles.coupling.gas_velocity = bulk_velocity;
  }

  // Gas at the last update; cases with gas only. Slices count from z = 0.
  double pressure_gradient(int slice) const { return s_.gas.pressure_gradient[slice]; }  ///< Pa/m
  double void_fraction(int slice) const { return s_.gas.void_fraction[slice]; }          ///< of the bed
  double bed_area(int slice) const { return s_.gas.bed_area[slice]; }                    ///< m2
  double gas_velocity_above(int slice) const { return s_.gas.velocity_above[slice]; }    ///< m/s
  double gas_velocity_in_bed(int slice) const { return s_.gas.velocity_in_bed[slice]; }  ///< m/s
  double bulk_velocity(int slice) const { return bulk_velocity_in(s_.gas, slice); }      ///< U, m/s
  double gas_density(int slice) const { return gas_density_in(s_.gas, slice); }          ///< kg/m3
  /// At node 0 (inlet) to slice_count (outlet) above the pressure at the outlet, Pa.
  double pressure(int node) const { return pressure_at_node(s_.gas, node); }
  /// What enters at the inlet, kg/s.
  double gas_supply() const { return fixdem::gas_supply(s_.gas); }
  /// Over the whole pipe, Pa.
  double pressure_drop() const { return loss_from_node(s_.gas, 0); }

  static constexpr int high_water_count() { return detail::high_water_marks; }
  HighWater high_water(int k) const { return detail::high_water(s_.near_list, k); }
  /// How often particles were sorted along the pipe, and how often a single range of pairs was listed anew.
  long long sorts() const { return s_.near_list.sorts; }
  long long listings() const { return s_.near_list.listings; }

  /// Whether this object, whose bytes have come from outside, may be run (consistency.hpp).
  bool is_consistent() const {
    for (const int row : id_row_)
      if (row < 0 || row >= count) return false;
    return fixdem::is_consistent(s_);
  }

  State<Case>& state() { return s_; }  ///< for benchmarks and tests of single stages

 private:
  /// Whole periods that a place lies outside [0, length). Zero for a place so far off that a fault has been raised.
  static int turns(double z) {
    int n = 0;
    if (!(abs(z) < farthest_place * Case::pipe_length)) return n;
    while (z - n * Case::pipe_length < 0) --n;
    while (z - n * Case::pipe_length >= Case::pipe_length) ++n;
    return n;
  }

  int row_of(int id) const {
    if (id_row_[id] < s_.particles.rows() && s_.particles.id[id_row_[id]] == id) return id_row_[id];
    for (int i = 0; i < s_.particles.rows(); ++i) id_row_[s_.particles.id[i]] = i;
    return id_row_[id];
  }
  /// -1 where nobody of that number is present.
  int find_row(int id) const {
    if constexpr (is_line<Case>) {
      if (!s_.particles.slots.is_taken[id]) return -1;
      const int row = row_of(id);
      return s_.particles.is_present(row) ? row : -1;
    }
    return row_of(id);
  }

  /// An empty line, in which those at the start have their places.
  void open_line() {
    auto& slots = s_.particles.slots;
    slots.rows_in_use = start_count;
    for (int i = 0; i < count; ++i) {
      slots.is_taken[i] = i < start_count;
      slots.serial[i] = i;
      if constexpr (has_sizes<Case>) slots.kind[i] = i < start_count ? i : 0;
      if constexpr (Case::has_gas) s_.gas.floats[i] = true;
    }
    for (VelocityBox& of_chunk : s_.near_list.velocities) of_chunk = {};
    s_.line.clear();
  }

  /// What has been placed gives way to the histories that are kept there.
  void forget_placed() {
    for (unsigned char& is_placed : is_placed_) is_placed = 0;
    is_placing_ = 0;
    if constexpr (keeps_history<Case>) s_.before.kept.clear();
  }

  void clear_contacts() {
    for (int c = 0; c < PairBatches<Case>::ranges; ++c) s_.contacts.pairs.count[c] = 0;
    for_each_wall(s_.contacts, [](auto& walls) {
      for (int& contacts : walls.count) contacts = 0;
    });
    for (auto& r : s_.contacts.rows) r = 0;
    for (auto& sum : s_.contacts.sum)
      for (auto& s : sum) s = 0;
  }

  /// The contact with the maximum overlap, as a fault where it is beyond the limit.
  Status deepest() const {
    Status worst{};
    detail::for_each_observed(s_.contacts, s_.particles, [&](const detail::Observed<Case>& o) {
      const double overlap = o.contact.overlap / D::smallest_radius;
      if (overlap > worst.value) worst = {Fault::overlap, o.contact.owner, s_.step, overlap, Case::max_overlap};
    });
    if (!(worst.value > Case::max_overlap)) worst.fault = Fault::none;
    return worst;
  }

  /// Since the start, per mass of reference, J/kg.
  double work_of_gravity() const {
    const double* gravity = Case::gravity;
    double work = 0;
    if constexpr (is_coupled<Case>) gravity = s_.particles.coupling.gravity, work = s_.particles.coupling.earlier_work;
    for (int c = 0; c < 3; ++c) work += gravity[c] * (place_sum(c) - start_place_[c]);
    return work;
  }

  /// Weighted by mass. What has left counts where it left, and what has entered as if it had been there before.
  double place_sum(int c) const {
    double sum = 0;
    for (int i = 0; i < s_.particles.rows(); ++i)
      if (s_.particles.is_present(i))
        sum += share_of_mass(s_.particles, i) *
               (s_.particles.position[i][c] + (c == 2 ? s_.particles.image[i] * Case::pipe_length : 0));
    if constexpr (is_line<Case>)
      sum += (s_.line.all_left().mass_place[c] - s_.line.entered.mass_place[c]) / D::reference_mass;
    return sum;
  }

  State<Case> s_;
  double start_place_[3];
  mutable int id_row_[count];
  unsigned char is_placed_[count];  ///< 1 if so, since the last start or run
  unsigned char is_placing_;
};

}  // namespace fixdem
