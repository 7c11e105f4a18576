#include "fault_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "contact_kinds.hpp"
#include "contact_time.hpp"

namespace fixdem::program {
namespace {

/// The least of `time(reduced mass, stiffness)` over the kinds of contact that the case can have, and what touches
/// there.
struct ShortestContact {
  double seconds = INFINITY;
  std::string between;  ///< " of large with small"; empty where all particles are equal
};

std::string kind_name(const CaseFacts& facts, const ParticleKind& kind) {
  if (facts.has_species()) return facts.species[kind.species];
  return kind.diameter == facts.smallest_diameter ? "smallest" : "largest";
}

template <class Time>
ShortestContact shortest_contact(const CaseFacts& facts, Time&& time) {
  ShortestContact shortest;
  const auto look_at = [&](double mass, double stiffness, const auto& name) {
    if (const double seconds = time(mass, stiffness); seconds < shortest.seconds) shortest = {seconds, name()};
  };
  const auto equal = [] { return std::string(); };
  const bool has_walls = facts.has_wall || !facts.is_periodic;
  if (!facts.has_sizes()) {
    if (facts.particle_count > 1) look_at(facts.mass / 2, facts.stiffness_pair, equal);
    if (has_walls) look_at(facts.mass, facts.stiffness_wall, equal);
    return shortest;
  }
  const std::vector<CountedKind> kinds = counted_kinds(facts, facts.particle_count);
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    const ParticleKind& a = kinds[i].kind;
    for (std::size_t j = i; j < kinds.size(); ++j) {
      const ParticleKind& b = kinds[j].kind;
      // Of a continuous distribution the smallest stands for those that are nearly as small.
      if (i == j && kinds[i].count < 2 && facts.has_species() && !facts.line.is_open) continue;
      look_at(reduced_mass(a, b), pair_coefficients(facts, a, b).stiffness,
              [&] { return fmt::format(" of {} with {}", kind_name(facts, a), kind_name(facts, b)); });
    }
    if (has_walls)
      look_at(a.mass(), wall_coefficients(facts, a).stiffness,
              [&] { return fmt::format(" of {} with the wall", kind_name(facts, a)); });
  }
  return shortest;
}

/// At this approach speed.
ShortestContact shortest_at(const CaseFacts& facts, double speed) {
  return shortest_contact(facts, [&](double mass, double stiffness) {
    return facts.normal == NormalLaw::linear ? linear_contact_time(mass, stiffness)
                                             : hertz_contact_time(mass, stiffness, speed);
  });
}

/// With this maximum overlap.
ShortestContact shortest_with(const CaseFacts& facts, double max_overlap) {
  return shortest_contact(facts, [&](double mass, double stiffness) {
    return facts.normal == NormalLaw::linear
               ? linear_contact_time(mass, stiffness)
               : hertz_contact_time(mass, stiffness, hertz_impact_speed(mass, stiffness, max_overlap));
  });
}

/// Two digits, rounded down: 2.93e-6 -> 2.9e-6.
double two_digits_below(double x) {
  const double unit = std::pow(10.0, std::floor(std::log10(x)) - 1);
  return std::floor(x / unit) * unit;
}

}  // namespace

double contact_time(const CaseFacts& facts, double speed) { return shortest_at(facts, speed).seconds; }

double contact_time_of(const CaseFacts& facts, double max_overlap) { return shortest_with(facts, max_overlap).seconds; }

const char* overlap_unit(const CaseFacts& facts) {
  return facts.has_sizes() ? "radii of the smallest particle" : "radii";
}

std::string contact_warning(const CaseFacts& facts, double deepest_overlap) {
  const bool is_measured = deepest_overlap > 0;
  if (!is_measured && !(facts.reference_speed > 0) && facts.normal == NormalLaw::hertz) return "";
  const auto [duration, between] =
      is_measured ? shortest_with(facts, deepest_overlap) : shortest_at(facts, facts.reference_speed);
  const double steps = duration / facts.time_step;
  if (!(steps < fewest_steps_per_contact)) return "";
  return fmt::format(
      "fixdem: warning: [run] time_step = {} gives only {:.1f} steps per contact{} at {}; at least {:.0f} are needed "
      "for a true rebound: results may be wrong\n  try time_step = {:.2g}, or a softer material\n",
      facts.time_step, steps, between,
      is_measured ? fmt::format("the deepest overlap so far, {:.2g} {}", deepest_overlap / facts.smallest_radius(),
                                overlap_unit(facts))
                  : fmt::format("{:.4g} m/s", facts.reference_speed),
      fewest_steps_per_contact, two_digits_below(duration / fewest_steps_per_contact));
}

const char* fault_name(Fault fault) {
  switch (fault) {
    case Fault::none:
      return "done";
    case Fault::neighbour_capacity:
      return "neighbour_capacity";
    case Fault::pair_capacity:
      return "pair_capacity";
    case Fault::chunk_capacity:
      return "chunk_capacity";
    case Fault::history_capacity:
      return "history_capacity";
    case Fault::not_placed:
      return "not_placed";
    case Fault::non_finite:
      return "non_finite";
    case Fault::outside_pipe:
      return "outside_pipe";
    case Fault::overlap:
      return "overlap";
    case Fault::too_fast:
      return "too_fast";
    case Fault::order_lost:
      return "order_lost";
    case Fault::gas_unsolved:
      return "gas_unsolved";
    case Fault::line_full:
      return "line_full";
  }
  return "unknown_fault";
}

ExitCode fault_exit_code(Fault fault) {
  switch (fault) {
    case Fault::none:
      return exit_done;
    case Fault::neighbour_capacity:
    case Fault::pair_capacity:
    case Fault::chunk_capacity:
    case Fault::history_capacity:
    case Fault::line_full:
      return exit_capacity;
    default:
      return exit_unstable;
  }
}

std::string fault_sentence(const CaseFacts& facts, const Status& status, const NamedParticle& named) {
  std::string who = status.particle >= 0 ? fmt::format("particle {}", named.serial) : "the simulation";
  if (status.particle >= 0 && facts.has_sizes())
    who += fmt::format(" (diameter {:.4g} m)", facts.diameter_of(named.kind));
  switch (status.fault) {
    case Fault::neighbour_capacity:
      return fmt::format("{} has {} near neighbours (limit {})", who, status.value, status.limit);
    case Fault::non_finite:
      return fmt::format("{} has a position or velocity that is not finite", who);
    case Fault::outside_pipe:
      return fmt::format("{} has left the pipe of {} m x {} m: its centre is at {:.6g} m (limit {:.6g} m)", who,
                         facts.pipe_diameter, facts.pipe_length, status.value, status.limit);
    case Fault::overlap:
      return fmt::format("{} has an overlap of {:.3g} {} (limit {:.3g})", who, status.value, overlap_unit(facts),
                         status.limit);
    case Fault::too_fast:
      return fmt::format("{} moves {:.3g} {} in one step (limit {:.3g})", who, status.value, overlap_unit(facts),
                         status.limit);
    case Fault::order_lost:
      return fmt::format("{} became more than {} times as fast within {} steps", who, speed_growth, order_interval);
    default:
      return fmt::format("{}: {}, {:.6g} (limit {:.6g})", who, describe(status.fault), status.value, status.limit);
  }
}

std::string fault_advice(const CaseFacts& facts, const Status& status, double speed) {
  switch (status.fault) {
    case Fault::neighbour_capacity:
    case Fault::pair_capacity:
      return fmt::format("raise [capacity] neighbours in the case file (at most {}) and build again",
                         facts.most_neighbours());
    case Fault::chunk_capacity:
      return "more particles lie beside each other than touching ones in a pipe of [pipe] diameter: they overlap "
             "deeply, or "
             "the case has no wall to hold them";
    case Fault::history_capacity:
      return fmt::format(
          "there are more than {} contacts for each particle, which spheres that do not overlap cannot have: "
          "lower [run] time_step, or max_overlap so that the run stops where it begins",
          facts.has_sizes() ? "seven and a half" : "six");
    case Fault::line_full:
      return "raise [particles] capacity in the case file, or leave it out: then there is room for all that the pipe "
             "can "
             "hold; and build again";
    case Fault::gas_unsolved:
      return "the gas flow of a slice has no solution in floating point: check [gas] bulk_velocity, density and "
             "kinematic_viscosity";
    default:
      break;
  }
  if (!(speed > 0) || !std::isfinite(speed)) speed = facts.reference_speed;
  if (!(speed > 0)) speed = 1;
  const double duration = contact_time(facts, speed);
  const double steps = duration / facts.time_step;
  if (steps < fewest_steps_per_contact)
    return fmt::format(
        "a contact at {:.3g} m/s lasts {:.2g} s, {:.2g} time steps of {:.2g} s ({:.0f} are needed)\n  try [run] "
        "time_step = {:.2g}, or a lower youngs_modulus",
        speed, duration, steps, facts.time_step, fewest_steps_per_contact,
        two_digits_below(duration / fewest_steps_per_contact));
  return fmt::format(
      "a contact at {:.3g} m/s lasts {:.2g} time steps, which is enough: the particles are pressed together or driven "
      "out by speed, gravity or gas\n  look at the last frame, and raise the stiffness{} if it is meant",
      speed, steps, status.fault == Fault::overlap ? " or [run] max_overlap" : "");
}

}  // namespace fixdem::program
