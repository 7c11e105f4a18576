// One scene with every feature, and the same scene stripped of them one by one; what goes with each is asserted.
//
// A square rod of 60 layers of 2 x 2 spheres that just fits its pipe: each sphere presses on four others (five with the
// one across the ends) and on the wall, so that every kind of contact is at work in every step. Last and apart, the rod
// as an open line, of which nothing may be left in the others.
#pragma once

#include "cases/plug_u24.hpp"
#include "kernel/fixdem.hpp"

namespace fixdem::footprint {

struct without_rolling : cases::plug_u24 {
  static constexpr int particle_count = 240;
  static constexpr double spacing = 0.99999 * diameter;
  static constexpr double pipe_diameter = 2.4141 * diameter, pipe_length = 60 * spacing;
  static constexpr int slice_count = 60;
  static constexpr auto integrator = Integrator::leapfrog;
};
struct one_size : without_rolling {
  static constexpr double wall_friction = 0.2, rolling_friction = 0.1;
};
/// Two species, which differ in density alone: their rod is the same.
struct everything : one_size {
  static constexpr double largest_diameter = diameter, smallest_diameter = diameter, reference_density = density;
  static constexpr double mean_volume = Derived<one_size>::volume;
  static constexpr int species_count = 2;
  static constexpr SizeRun sizes[] = {{120, diameter, density, 0}, {120, diameter, 0.9 * density, 1}};
};
struct without_gas : without_rolling {
  static constexpr bool has_gas = false;
};
struct without_friction : without_gas {
  static constexpr double friction = 0;
};
struct without_wall : without_friction {
  static constexpr bool has_wall = false;
};
struct without_ends : without_wall {
  static constexpr auto ends = Ends::none;
};
struct without_ledger : without_ends {
  static constexpr bool energy_ledger = false;
};
struct pairs_only : without_ledger {
  static constexpr auto integrator = Integrator::euler;
};

struct line : everything {
  static constexpr auto ends = Ends::open;
  static constexpr int start_count = particle_count, first_fed_kind = 0;
  static constexpr TimeValue feed_rate[] = {{0, 0.1}};
  static constexpr double feed_start = 0, feed_length = 0.1, feed_velocity = 0.5;
  static constexpr unsigned long long feed_seed = 1;
  static constexpr int feed_interval = 500;
};

template <class Visit>
void for_each_strip(Visit visit) {
  visit.template operator()<everything>("everything");
  visit.template operator()<one_size>("one size");
  visit.template operator()<without_rolling>("no rolling resistance, walls like particles");
  visit.template operator()<without_gas>("no gas");
  visit.template operator()<without_friction>("no friction, so no rotation");
  visit.template operator()<without_wall>("no wall");
  visit.template operator()<without_ends>("no periodic ends");
  visit.template operator()<without_ledger>("no energy ledger");
  visit.template operator()<pairs_only>("no prediction (Euler): pairs alone");
  visit.template operator()<line>("everything, as an open line");
}

// No line: nothing of its books and of numbers that are used again.
static_assert(!__is_empty(Line<line>) && __is_empty(Line<everything>));
static_assert(sizeof(Particles<line>) - sizeof(Particles<everything>) >= 13 * everything::particle_count);
// One size: no radii while particles are sorted. No rolling resistance: no spring of it, no torques on partners.
static_assert(sizeof(SortScratch<everything>) - sizeof(SortScratch<one_size>) >= 8 * everything::particle_count);
static_assert(Particles<everything>::motion_width == 8 && sizeof(Particles<everything>) == sizeof(Particles<one_size>));
static_assert(ContactLaw<one_size, false>::history_size - ContactLaw<without_rolling, false>::history_size == 3);
static_assert(!__is_empty(decltype(Contacts<one_size>::torques)) &&
              __is_empty(decltype(Contacts<without_rolling>::torques)));
// No gas: no slices, and no force of the gas for each particle.
static_assert(sizeof(GasSlices<without_rolling>) > 1000 && __is_empty(GasSlices<without_gas>));
static_assert(sizeof(Particles<without_rolling>) - sizeof(Particles<without_gas>) ==
              everything::particle_count * 4 * 8);
// No friction: no angular velocity, no history, and force rows half as wide.
static_assert(Particles<without_gas>::motion_width == 8 && Particles<without_friction>::motion_width == 4);
static_assert(Contacts<without_gas>::row_width == 8 && Contacts<without_friction>::row_width == 4);
static_assert(!__is_empty(decltype(PairBatches<without_gas>::history)));
static_assert(__is_empty(decltype(PairBatches<without_friction>::history)) &&
              __is_empty(KeptHistory<without_friction>) && !__is_empty(KeptHistory<without_gas>));
// No wall: no list of those near it, and so no history of it.
static_assert(!__is_empty(decltype(Contacts<without_friction>::pipe)) &&
              __is_empty(decltype(Contacts<without_wall>::pipe)));
// No periodic ends: no range of pairs across them.
static_assert(PairBatches<without_wall>::ranges - PairBatches<without_ends>::ranges == 1);
// No ledger, no prediction.
static_assert(sizeof(StepMonitor<without_ledger>) < sizeof(StepMonitor<without_ends>));
static_assert(sizeof(Particles<without_ledger>) - sizeof(Particles<pairs_only>) == everything::particle_count * 4 * 8);

/// Sphere `id` of the rod, with a small velocity of its own.
inline Particle of_rod(int id) {
  const double d = everything::spacing;
  const int layer = id / 4;
  const double x = id % 2 == 0 ? -0.5 : 0.5, y = id / 2 % 2 == 0 ? -0.5 : 0.5;
  const auto some = [&](int k) { return 1e-3 * ((37 * id + 11 * k) % 19 - 9); };
  return {{d * x, d * y, d * (layer + 0.5)}, {some(0), some(1), some(2)}, {}};
}

}  // namespace fixdem::footprint
