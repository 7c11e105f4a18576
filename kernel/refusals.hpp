// What does not compile: a case that makes no sense, with a message that says what to change.
//
// Casegen refuses the same with file and line before a compiler sees it; this is for cases written by hand.
#pragma once

#include "capacity.hpp"
#include "gas_case.hpp"

namespace fixdem {

/// Of an open line; nothing of others.
template <class Case, bool present = is_line<Case>>
struct CheckedLine {
  static_assert(
      requires { Case::feed_rate, Case::start_count, Case::feed_length; },
      "fixdem: ends = \"open\" needs a feed: add the table [feed]");
  static_assert(Case::start_count >= 0 && Case::start_count <= Case::particle_count,
                "fixdem: [particles] count must not be above capacity");
  static_assert(Case::has_wall, "fixdem: ends = \"open\" needs the pipe's wall: set [pipe] wall = true");
  static_assert(Case::pipe_length >= 4 * largest_diameter<Case>,
                "fixdem: an open line must be at least 4 particle diameters long: raise [pipe] length");
  static_assert(Case::feed_length >= 2 * largest_diameter<Case> && Case::feed_length <= Case::pipe_length,
                "fixdem: [feed] length must lie between two diameters of the particles and the length of the pipe");
  static_assert(Case::feed_interval >= 1, "fixdem: feed_interval must be 1 step at least");
  static_assert(Case::feed_velocity >= 0, "fixdem: [feed] velocity must not be negative");
  static constexpr bool rates_are_sound = [] {
    double last = -1e300;
    for (const TimeValue& row : Case::feed_rate) {
      if (!(row.value >= 0) || !(row.time > last)) return false;
      last = row.time;
    }
    return true;
  }();
  static_assert(rates_are_sound, "fixdem: [feed] rate must not be negative, and its times must increase");
  static constexpr bool kinds_are_sound = [] {
    if constexpr (has_sizes<Case>)
      return Case::first_fed_kind >= 0 && Case::first_fed_kind < kinds_in<Case> && Case::start_count <= kinds_in<Case>;
    else
      return true;
  }();
  static_assert(kinds_are_sound, "fixdem: sizes must have the kinds of all particles at the start, and one to be fed");
  static_assert(!is_coupled<Case>, "fixdem: a line cannot be coupled: gravity and gas are those of its case");
  static constexpr bool ok = true;
};
template <class Case>
struct CheckedLine<Case, false> {
  static_assert(
      !requires { Case::feed_rate; }, "fixdem: [feed] needs [pipe] ends = \"open\"");
  static constexpr bool ok = true;
};

/// Of the gas: with a compressible one what drives it, otherwise that nothing of that is there.
template <class Case, bool present = is_compressible<Case>>
struct CheckedGas {
  static_assert(Case::has_gas, "fixdem: compressible needs the gas: add the table [gas]");
  static_assert(Case::gas_outlet_pressure > 0, "fixdem: [gas] outlet_pressure must be positive");
  static_assert(supply_volume<Case> >= 0, "fixdem: [gas] supply_volume must not be negative");
  static_assert(!has_inlet_pressure<Case> || !has_blower<Case>,
                "fixdem: [gas] inlet_pressure excludes a blower: remove one");
  static_assert(!has_velocity_in_time<Case> || !(has_inlet_pressure<Case> || has_blower<Case>),
                "fixdem: [gas] bulk_velocity excludes inlet_pressure and a blower: remove one");
  static_assert(supply_volume<Case> == 0 || stores_gas<Case>, "fixdem: [gas] supply_volume needs storage = true");
  static_assert(supply_volume<Case> == 0 || !has_inlet_pressure<Case>,
                "fixdem: [gas] supply_volume says nothing with inlet_pressure: remove it");
  static constexpr bool ok = true;
};
template <class Case>
struct CheckedGas<Case, false> {
  static_assert(!stores_gas<Case> && !has_inlet_pressure<Case> && !has_blower<Case> && supply_volume<Case> == 0,
                "fixdem: [gas] storage, supply_volume, inlet_pressure and blower_flow need compressible = true");
  static constexpr bool ok = true;
};

template <class Case>
struct Checked {
  static_assert(Case::particle_count >= 1, "fixdem: [particles] count must be at least 1");
  static_assert(smallest_diameter<Case> > 0 && Derived<Case>::reference_mass > 0,
                "fixdem: [particles] diameter and density must be positive");
  static_assert(largest_diameter<Case> < Case::pipe_diameter,
                "fixdem: the particle is wider than the pipe: lower [particles] diameter or raise [pipe] diameter");
  static_assert(largest_diameter<Case> <= 10 * smallest_diameter<Case>,
                "fixdem: the largest diameter must be at most 10 times the smallest");
  static_assert(is_line<Case> || kinds_in<Case> == Case::particle_count,
                "fixdem: the counts of sizes must add up to particle_count");
  static_assert(!has_sizes<Case> || Case::damping_mass == DampingMass::reduced,
                "fixdem: [contact] damping_mass = \"particle\" needs one size of particles: use \"reduced\"");
  static_assert(Case::restitution > 0 && Case::restitution <= 1,
                "fixdem: [material] restitution must be above 0 and at most 1");
  static_assert(Case::friction >= 0, "fixdem: [material] friction must not be negative");
  static_assert(Derived<Case>::wall_restitution > 0 && Derived<Case>::wall_restitution <= 1,
                "fixdem: [material] wall_restitution must be above 0 and at most 1");
  static_assert(Derived<Case>::wall_friction >= 0, "fixdem: [material] wall_friction must not be negative");
  static_assert(Derived<Case>::has_walls || (Derived<Case>::wall_friction == Case::friction &&
                                             Derived<Case>::wall_restitution == Case::restitution),
                "fixdem: [material] wall_friction and wall_restitution need a wall: set [pipe] wall = true or ends = "
                "\"closed\", or remove them");
  static_assert(Case::damping != Damping::critical || Derived<Case>::wall_restitution == Case::restitution,
                "fixdem: [material] wall_restitution says nothing with damping = \"critical\": remove it");
  static_assert(Derived<Case>::friction_limit == FrictionLimit::total || Derived<Case>::has_rotation,
                "fixdem: friction_limit = \"elastic\" needs [material] friction above 0");
  static_assert(
      Derived<Case>::friction_limit == FrictionLimit::total || Case::slider != Slider::paper,
      "fixdem: friction_limit = \"elastic\" needs slider = \"clip\" or \"exact\": eqs. (10)-(12) to the letter use "
      "the whole force");
  static_assert(Derived<Case>::rolling_friction >= 0, "fixdem: [material] rolling_friction must not be negative");
  static_assert(Derived<Case>::wall_rolling_friction >= 0,
                "fixdem: [material] wall_rolling_friction must not be negative");
  static_assert(Derived<Case>::rolling_friction == 0 || Case::friction > 0,
                "fixdem: [material] rolling_friction needs [material] friction above 0: without it nothing turns");
  static_assert(Derived<Case>::wall_rolling_friction == 0 || Derived<Case>::wall_friction > 0,
                "fixdem: [material] wall_rolling_friction needs wall_friction above 0: without it nothing turns there");
  static_assert(
      Derived<Case>::has_walls || Derived<Case>::wall_rolling_friction == Derived<Case>::rolling_friction,
      "fixdem: [material] wall_rolling_friction needs a wall: set [pipe] wall = true or ends = \"closed\", or "
      "remove it");
  static_assert(Capacity<Case>::chunk_size <= largest_chunk,
                "fixdem: a slice of the pipe holds too many particles: lower [pipe] diameter or [particles] count");
  static_assert(Case::normal != NormalLaw::hertz || (Case::poisson_ratio >= 0 && Case::poisson_ratio <= 0.5),
                "fixdem: [material] poisson_ratio must lie between 0 and 0.5");
  static_assert(Case::normal != NormalLaw::hertz || Case::youngs_modulus > 0,
                "fixdem: [material] youngs_modulus must be positive");
  static_assert(Case::normal != NormalLaw::linear || (Case::normal_stiffness > 0 && Case::tangential_stiffness > 0),
                "fixdem: normal = \"linear\" needs [contact] normal_stiffness and tangential_stiffness above 0");
  static_assert(Case::damping != Damping::critical || Case::normal == NormalLaw::linear,
                "fixdem: damping = \"critical\" belongs to normal = \"linear\"; with \"hertz\" use \"restitution\"");
  static_assert(Case::integrator != Integrator::impulse || Case::slider != Slider::paper,
                "fixdem: integrator = \"impulse\" needs slider = \"exact\" or \"clip\": with \"paper\" impacts do not "
                "converge, so nothing would be gained");
  static_assert(Case::ends != Ends::periodic || Case::pipe_length >= 4 * largest_diameter<Case>,
                "fixdem: a periodic pipe must be at least 4 particle diameters long: raise [pipe] length");
  static_assert(Case::ends != Ends::closed || Case::pipe_length >= 2 * largest_diameter<Case>,
                "fixdem: a closed pipe must be at least 2 particle diameters long: raise [pipe] length");
  static_assert(!Case::has_gas || Case::has_wall, "fixdem: the gas model needs the pipe wall: set [pipe] wall = true");
  static_assert(!Case::has_gas || gas_takes_gravity(Case::gravity, Case::particle_count > 1),
                "fixdem: the gas model needs to know where a bed lies: with gas and several particles, [run] gravity "
                "must not be zero");
  static_assert(Case::time_step > 0, "fixdem: [run] time_step must be positive");
  static_assert(Case::neighbour_capacity >= 2 && Case::neighbour_capacity <= (has_sizes<Case> ? 160 : 30),
                "fixdem: [capacity] neighbours must lie between 2 and 30, with several sizes 160");
  static_assert(CheckedLine<Case>::ok);
  static_assert(CheckedGas<Case>::ok);
  static constexpr bool gap_is_sound = [] {
    if constexpr (requires { Case::gas_full_gap; })
      return Case::has_gas && Case::gas_bed_height != BedHeight::strict && Case::gas_full_gap > 0 &&
             Case::gas_full_gap < Case::pipe_diameter;
    else
      return true;
  }();
  static_assert(gap_is_sound,
                "fixdem: [gas] full_gap must lie between 0 and the diameter of the pipe, and bed_height must not be "
                "\"strict\": with that no gap counts");
  static constexpr bool ok = true;
};

}  // namespace fixdem
