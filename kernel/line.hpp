// The books of an open line: what has entered, what has left, and what the feed still owes.
//
// A particle enters in a feeding event (feed.hpp) and leaves at the outlet (outlet.hpp). Whole numbers balance at every
// moment: those at the start and those fed are those present and those that have left. What leaves is booked by the
// chunk that it leaves from, so that sums have one order, whatever the order in which chunks are computed.
#pragma once

#include "contacts.hpp"

namespace fixdem {

/// What particles carry that enter or leave, summed. SI units.
struct Passage {
  long long count = 0;
  double mass = 0, momentum[3] = {}, mass_place[3] = {};  ///< kg, kg m/s, kg m (of which the potential energy follows)
  double kinetic = 0;                                     ///< J, of translation and rotation
  double elastic = 0;                                     ///< J, of the contacts that are cut

  void add(const Passage& other) {
    count += other.count, mass += other.mass, kinetic += other.kinetic, elastic += other.elastic;
    for (int c = 0; c < 3; ++c) momentum[c] += other.momentum[c], mass_place[c] += other.mass_place[c];
  }
};

/// A particle of a row as it passes.
template <class Case>
Passage passage_of(const Particles<Case>& p, int row) {
  Passage one;
  const double *x = p.position[row], *v = p.motion[row];
  one.count = 1, one.mass = Derived<Case>::reference_mass * share_of_mass(p, row);
  double square = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
  if constexpr (Derived<Case>::has_rotation) square += 0.4 * (v[4] * v[4] + v[5] * v[5] + v[6] * v[6]);
  for (int c = 0; c < 3; ++c) one.momentum[c] = one.mass * v[c], one.mass_place[c] = one.mass * x[c];
  one.kinetic = 0.5 * one.mass * square;
  return one;
}

/// Since the start. at_start + fed = present + left.
struct LineTotals {
  long long at_start, fed, left, present;
  double asked, accepted, left_mass;  ///< kg; asked: due up to the last feeding event
  double backlog;                     ///< kg, asked less accepted
  double blocked_time;                ///< s, with a backlog of more than a second of the feed
};

template <class Case, bool present = is_line<Case>>
struct Line {
  Passage entered;
  double asked;              ///< kg
  long long blocked_events;  ///< feeding events with a backlog of more than a second of the feed
  long long tries;           ///< places that the next particle has tried at earlier events
  bool feeds;                ///< the present event has found a place for the next particle
  int sorted_chunks;         ///< in use since the last sort
  // Of each chunk in use since the last sort:
  double front[Capacity<Case>::chunks];  ///< bound on the place of those that have not left, m
  int parked[Capacity<Case>::chunks];    ///< particles that have left
  Passage left[Capacity<Case>::chunks];  ///< since the start

  void clear() {
    entered = {}, asked = 0, blocked_events = tries = 0, feeds = false;
    for (Passage& of_chunk : left) of_chunk = {};
  }
  Passage all_left() const {
    Passage sum;
    for (const Passage& of_chunk : left) sum.add(of_chunk);
    return sum;
  }
  double backlog() const { return asked > entered.mass ? asked - entered.mass : 0; }
};
template <class Case>
struct Line<Case, false> {};

}  // namespace fixdem
