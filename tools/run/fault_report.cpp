#include "fault_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace fixdem::program {
namespace {

double contact_time(const CaseFacts& facts, double mass, double stiffness, double speed) {
  if (facts.normal == NormalLaw::linear) return 3.14159265358979324 * std::sqrt(mass / stiffness);
  // m v^2 / 2 = (2/5) K overlap^(5/2), the energy of eq. (15)
  return 2.9433 * std::pow(1.25 * mass * speed * speed / stiffness, 0.4) / speed;
}

/// Two digits, rounded down: 2.93e-6 -> 2.9e-6.
double two_digits_below(double x) {
  const double unit = std::pow(10.0, std::floor(std::log10(x)) - 1);
  return std::floor(x / unit) * unit;
}

}  // namespace

double contact_time(const CaseFacts& facts, double speed) {
  return std::min(contact_time(facts, facts.mass / 2, facts.stiffness_pair, speed),
                  contact_time(facts, facts.mass, facts.stiffness_wall, speed));
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
      return exit_capacity;
    default:
      return exit_unstable;
  }
}

std::string fault_sentence(const CaseFacts& facts, const Status& status) {
  const std::string who = status.particle >= 0 ? fmt::format("particle {}", status.particle) : "the simulation";
  switch (status.fault) {
    case Fault::neighbour_capacity:
      return fmt::format("{} has {} near neighbours (limit {})", who, status.value, status.limit);
    case Fault::non_finite:
      return fmt::format("{} has a position or velocity that is not finite", who);
    case Fault::outside_pipe:
      return fmt::format("{} has left the pipe of {} m x {} m: its centre is at {:.6g} m (limit {:.6g} m)", who,
                         facts.pipe_diameter, facts.pipe_length, status.value, status.limit);
    case Fault::overlap:
      return fmt::format("{} has an overlap of {:.3g} radii (limit {:.3g})", who, status.value, status.limit);
    case Fault::too_fast:
      return fmt::format("{} moves {:.3g} radii in one step (limit {:.3g})", who, status.value, status.limit);
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
      return "raise [capacity] neighbours in the case file (at most 30) and build again";
    case Fault::chunk_capacity:
      return "the particles are packed more densely than spheres can be: they overlap; a smaller [run] time_step or a "
             "stiffer material prevents that";
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
  if (steps < 20)
    return fmt::format(
        "a contact at {:.3g} m/s lasts {:.2g} s, {:.2g} time steps of {:.2g} s (20 are needed)\n  try [run] time_step "
        "= "
        "{:.2g}, or a lower youngs_modulus",
        speed, duration, steps, facts.time_step, two_digits_below(duration / 20));
  return fmt::format(
      "a contact at {:.3g} m/s lasts {:.2g} time steps, which is enough: the particles are pressed together or driven "
      "out by speed, gravity or gas\n  look at the last frame, and raise the stiffness{} if it is meant",
      speed, steps, status.fault == Fault::overlap ? " or [run] max_overlap" : "");
}

}  // namespace fixdem::program
