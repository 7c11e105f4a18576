// The feed of an open line: which particle is due, and where it finds a place.
//
// Due is the integral of the feed rate since feed_start. At every feeding event (feed_interval steps, 1 ms) particles
// are fed while the next one is due and finds a place: up to 20 candidates, uniform over the length of the feed section
// and, as from a rotary feeder, over the upper half of its cross-section; accepted is what lies in the section and
// overlaps no particle. It falls with the feed velocity, does not spin, and feels no gas until its next update. The
// first particle without a place ends the event and goes on trying at the next; what is due stays due, so a blocked
// line is a result and not an error. Numbers are hashes of the seed, of how many have been fed, of the try and of the
// component: there is no random state, and a restart repeats them.
//
// Candidates are compared with the rows of the slabs of cells in which their neighbours were when particles were sorted
// last, and with those fed in the same event.
#pragma once

#include "line.hpp"
#include "near_list.hpp"

namespace fixdem {

inline constexpr int feed_tries = 20;  ///< at an event

namespace detail {

/// The finaliser of splitmix64 (Steele, Lea & Flood 2014): 64 bits that follow from 64 bits.
constexpr unsigned long long mix(unsigned long long z) {
  z += 0x9E3779B97F4A7C15ULL;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
  return z ^ (z >> 31);
}

/// In [0, 1), of the particle that is fed as number `fed`, from 0.
template <class Case>
double feed_number(long long fed, long long attempt, int component) {
  const unsigned long long of_particle = mix(mix(Case::feed_seed) + static_cast<unsigned long long>(fed));
  return static_cast<double>(mix(of_particle + static_cast<unsigned long long>(4 * attempt + component)) >> 11) *
         0x1p-53;
}

/// Number in the table of sizes of the particle that is fed as number `fed`.
template <class Case>
int kind_of_fed([[maybe_unused]] long long fed) {
  if constexpr (has_sizes<Case>) {
    constexpr int first = Case::first_fed_kind, kinds = kinds_in<Case> - first;
    return first + static_cast<int>(feed_number<Case>(fed, 0, 3) * kinds);
  }
  return 0;
}

}  // namespace detail

/// A particle on its way into the pipe.
struct FedParticle {
  int kind;
  double radius, mass;  ///< m, kg
  double place[3];      ///< m
};

template <class Case>
FedParticle next_fed(const Line<Case>& line) {
  const int kind = detail::kind_of_fed<Case>(line.entered.count);
  return {kind, radius_of<Case>(kind), mass_of<Case>(kind), {}};
}

/// Whether the next particle is due. A whole number of particles is not missed for rounding.
template <class Case>
bool is_due(const Line<Case>& line, double mass) {
  return line.entered.mass + mass <= line.asked * (1 + 1e-12);
}

/// Rows as an event finds them: those that were sorted last, less those that have gone since, which has moved the
/// others forwards, and how far particles have come along the pipe since [m].
struct SortedRows {
  int end, gone;
  double moved;
};

/// Whether a sphere overlaps none of those present.
template <class Case>
bool is_free(const FedParticle& fed, const Particles<Case>& p, const NearList<Case>& near, const SortedRows& sorted) {
  using C = Cells<Case>;
  const auto overlaps = [&](int from, int to) {
    for (int i = from; i < to; ++i) {
      const double* x = p.position[i];
      const double dx = x[0] - fed.place[0], dy = x[1] - fed.place[1], dz = x[2] - fed.place[2];
      const double touch = fed.radius + radius_at<Case>(x);
      if (dx * dx + dy * dy + dz * dz < touch * touch) return true;
    }
    return false;
  };
  const double reach = fed.radius + Derived<Case>::largest_radius + sorted.moved;
  const auto slab_at = [&](double z) {
    const double n = z * (C::along / Case::pipe_length);
    return n < 0 ? 0 : (n < near.outer.slabs - 1 ? static_cast<int>(n) : near.outer.slabs - 1);
  };
  const int from = near.outer.cell_start[slab_at(fed.place[2] - reach) * C::in_slab] - sorted.gone;
  const int to = near.outer.cell_start[(slab_at(fed.place[2] + reach) + 1) * C::in_slab];
  return !overlaps(from > 0 ? from : 0, to < sorted.end ? to : sorted.end) && !overlaps(sorted.end, p.rows());
}

/// Looks for a place for the next particle, which has tried `line.tries` before.
template <class Case>
bool find_place(FedParticle& fed, const Line<Case>& line, const Particles<Case>& p, const NearList<Case>& near,
                const SortedRows& sorted) {
  using D = Derived<Case>;
  const double room = D::pipe_radius - fed.radius;
  for (long long attempt = line.tries; attempt < line.tries + feed_tries; ++attempt) {
    const auto u = [&](int component) { return detail::feed_number<Case>(line.entered.count, attempt, component); };
    const double across = (2 * u(0) - 1) * room, height = u(1) * room;
    if (!(across * across + height * height <= room * room)) continue;
    // Fused by hand: g++ 12 at -O2 makes one fused addition and subtraction of the plain sums, -ffp-contract=off or
    // not.
    fed.place[0] = fused(height, D::up[0], across * D::up[1]);
    fed.place[1] = fused(height, D::up[1], -(across * D::up[0]));
    fed.place[2] = fed.radius + (Case::feed_length - 2 * fed.radius) * u(2);
    if (is_free(fed, p, near, sorted)) return true;
  }
  return false;
}

/// Adds a particle as the last row, in the lowest free slot; there must be one.
template <class Case>
void enter(const FedParticle& fed, Line<Case>& line, Particles<Case>& p) {
  using D = Derived<Case>;
  auto& slots = p.slots;
  int slot = 0;
  while (slots.is_taken[slot]) ++slot;
  const int row = slots.rows_in_use++;
  slots.is_taken[slot] = true;
  slots.serial[slot] = Case::start_count + line.entered.count;
  if constexpr (has_sizes<Case>) slots.kind[slot] = fed.kind;
  p.id[row] = slot, p.image[row] = 0;
  p.clear_row(row);
  for (int c = 0; c < 3; ++c) p.position[row][c] = fed.place[c];
  for (int c = 0; c < 2; ++c) p.motion[row][c] = -Case::feed_velocity * D::up[c];
  set_size(p, row);
  line.entered.add(passage_of(p, row));
  line.tries = 0;
}

/// The event ends; the next particle, if it is due, has found no place.
template <class Case>
void end_feeding(Line<Case>& line, double mass, double time) {
  line.feeds = false;
  if (!is_due(line, mass)) return;
  line.tries += feed_tries;
  if (line.backlog() > value_at(Case::feed_rate, time) * 1.0) ++line.blocked_events;  // a second's feed
}

/// A feeding event before step `step`: books what is due and tells whether there is a place for the next particle.
/// Nothing changes among the particles: those fed come with the next renewal, which must follow (feed).
template <class Case>
void begin_feeding(Line<Case>& line, const Particles<Case>& p, const NearList<Case>& near, long long step) {
  line.feeds = false;
  if (step % Case::feed_interval != 0) return;
  const double time = static_cast<double>(step) * Case::time_step;
  line.asked = integral_of(Case::feed_rate, Case::feed_start, time);
  FedParticle fed = next_fed(line);
  const SortedRows sorted{p.rows(), 0, near.moved(step, line.sorted_chunks)};
  line.feeds = is_due(line, fed.mass) && find_place(fed, line, p, near, sorted);
  if (!line.feeds) end_feeding(line, fed.mass, time);
}

/// The rest of the event, in the renewal, once those that have left are gone (outlet.hpp) and before particles are
/// sorted. A fault tells that the pipe is full.
template <class Case>
Status feed(Line<Case>& line, Particles<Case>& p, const NearList<Case>& near, int gone_rows, long long step) {
  if (!line.feeds) return {};
  const SortedRows sorted{p.rows(), gone_rows, near.moved(step, line.sorted_chunks)};
  FedParticle fed = next_fed(line);
  for (; is_due(line, fed.mass) && find_place(fed, line, p, near, sorted); fed = next_fed(line)) {
    if (p.rows() == Case::particle_count)
      return {Fault::line_full, -1, 0, Case::particle_count + 1.0, 1.0 * Case::particle_count};
    enter(fed, line, p);
  }
  end_feeding(line, fed.mass, static_cast<double>(step) * Case::time_step);
  return {};
}

}  // namespace fixdem
