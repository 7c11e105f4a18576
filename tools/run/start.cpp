#include "start.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>

#include "arrangement.hpp"
#include "binary_file.hpp"
#include "failure.hpp"
#include "fault_report.hpp"
#include "running_hash.hpp"
#include "state_file.hpp"

namespace fixdem::program {
namespace {

std::filesystem::path default_start_state(const CaseFacts& facts, const Options& options) {
  // Normalised without asking the disk, so that `out/plug/` and `out/plug` have the same neighbour.
  std::filesystem::path out = std::filesystem::absolute(options.out).lexically_normal();
  if (!out.has_filename()) out = out.parent_path();
  return out.parent_path() / facts.start_from / "final.fixdem";
}

std::filesystem::path start_state_path(const CaseFacts& facts, const Options& options) {
  const std::filesystem::path path = options.start_state ? *options.start_state : default_start_state(facts, options);
  if (!options.start_state && !std::filesystem::exists(path))
    throw Failure(exit_input_output,
                  fmt::format("cannot read {}: the final state of {} is not there\n  run that case first (make run "
                              "CASE={}), or name a file with --start-state",
                              path.string(), facts.start_from, facts.start_from));
  return path;
}

std::vector<double> diameters_of(const CaseFacts& facts) {
  std::vector<double> diameters;
  for (int id = 0; id < facts.start_count(); ++id) diameters.push_back(facts.diameter_of(id));
  return diameters;
}

/// What of the first particle that differs; a state of one size knows no densities. Empty where the sizes are the same.
std::string difference_of_sizes(const CaseFacts& facts, const StoredState& state) {
  if (!facts.has_sizes() && state.diameters.empty())
    return state.diameter == facts.diameter
               ? ""
               : fmt::format("its particles are {} m wide, those of the case {} m", state.diameter, facts.diameter);
  for (int id = 0; id < facts.start_count(); ++id) {
    const auto k = static_cast<std::size_t>(id);
    const auto describe = [id](const char* what, double there, double here) {
      return fmt::format(
          "particle {} has {} {} there and {} here; allowed: the same diameters and densities, number by number", id,
          what, there, here);
    };
    const double diameter = state.diameters.empty() ? state.diameter : state.diameters[k];
    if (diameter != facts.diameter_of(id)) return describe("diameter", diameter, facts.diameter_of(id));
    if (!state.densities.empty() && state.densities[k] != facts.density_of(id))
      return describe("density", state.densities[k], facts.density_of(id));
  }
  return "";
}

StoredState load(const CaseFacts& facts, const Options& options) {
  const std::filesystem::path path = start_state_path(facts, options);
  StoredState state = read_state(path);
  const auto refuse = [&](const std::string& what, const std::string& advice) {
    throw Failure(exit_bad_input, fmt::format("{} (case {}) does not fit the case {}: {}\n  {}", path.string(),
                                              state.case_name, facts.name, what, advice));
  };
  if (!options.start_state && state.case_name != facts.start_from)
    refuse(fmt::format("it was written by {}, [start] from names {}", state.case_name, facts.start_from),
           fmt::format("run {} again, or give the file with --start-state if it is meant", facts.start_from));
  if (!options.start_state && !state.complete)
    refuse(fmt::format("its run was interrupted at {} s of {} s", state.time, state.duration),
           fmt::format("run {} to its end, or give the file with --start-state if it is meant", facts.start_from));
  if (state.particles.size() != static_cast<std::size_t>(facts.start_count()))
    refuse(fmt::format("it has {} particles, the case {}", state.particles.size(), facts.start_count()),
           facts.has_sizes() ? "both cases need the same particles"
                             : fmt::format("set [particles] count = {} or take another state", state.particles.size()));
  if (const std::string what = difference_of_sizes(facts, state); !what.empty())
    refuse(what,
           facts.has_sizes() ? "both cases need the same particles" : "both cases need the same [particles] diameter");
  const bool forces = facts.tangential != TangentialLaw::displacement;
  if (facts.start_keeps_motion && facts.has_rotation && state.histories_are_forces != forces)
    refuse(fmt::format("its contact histories are {}, the case needs {}",
                       state.histories_are_forces ? "forces" : "displacements", forces ? "forces" : "displacements"),
           "use the same [contact] tangential in both cases, or [start] motion = \"stop\"");
  for (std::size_t i = 0; i < state.particles.size(); ++i) {
    const double z = state.particles[i].position[2];
    if (z < 0 || z > facts.pipe_length || ((facts.is_periodic || facts.line.is_open) && z == facts.pipe_length))
      refuse(fmt::format("particle {} lies at z = {} m, the pipe ends at {} m", i, z, facts.pipe_length),
             fmt::format("raise [pipe] length, or let {} settle longer", state.case_name));
  }
  if (options.start_state && !state.complete && !options.quiet)
    std::fputs(
        fmt::format("fixdem: note: {} was interrupted at {} s of {} s\n", path.string(), state.time, state.duration)
            .c_str(),
        stderr);
  return state;
}

}  // namespace

std::uint64_t start_state_hash(const CaseFacts& facts, const Options& options) {
  if (facts.start != StartKind::from) return 0;
  RunningHash hash;
  hash.add(read_file(start_state_path(facts, options), "start state"));
  return hash.value();
}

void check_started(const CaseFacts& facts, const Status& status) {
  if (status.ok()) return;
  const ExitCode code = fault_exit_code(status.fault) == exit_capacity ? exit_capacity : exit_bad_input;
  throw Failure(code,
                "cannot start: " + fault_sentence(facts, status) + "\n  " +
                    (code == exit_capacity ? fault_advice(facts, status, 0)
                                           : std::string("change [start] so that every particle lies inside the "
                                                         "pipe and none overlap by more than [run] max_overlap")));
}

void start_simulation(SimulationView& view, const CaseFacts& facts, const Options& options) {
  StoredState state;
  if (facts.start == StartKind::random) {
    const Container pipe{facts.pipe_diameter, facts.pipe_length, facts.is_periodic};
    state.particles = facts.has_sizes() ? arrange_moving(pipe, diameters_of(facts), facts.start_velocity, options.seed)
                                        : arrange_moving(pipe, facts.start_count(), facts.diameter,
                                                         facts.start_velocity, options.seed);
  } else if (facts.start == StartKind::placed) {
    for (int id = 0; id < facts.start_count(); ++id) {
      const Placed& p = facts.placed[id];
      Particle particle{};
      for (int k = 0; k < 3; ++k) {
        particle.position[k] = p.position[k];
        particle.velocity[k] = p.velocity[k];
        particle.angular_velocity[k] = p.angular_velocity[k];
      }
      state.particles.push_back(particle);
    }
  } else {
    state = load(facts, options);
    for (Particle& particle : state.particles)
      for (int k = 0; k < 3; ++k) {
        if (!facts.start_keeps_motion) particle.velocity[k] = 0;
        if (!facts.start_keeps_motion || !facts.has_rotation) particle.angular_velocity[k] = 0;
      }
    if (!facts.start_keeps_motion || !facts.has_rotation) state.histories.clear();
  }

  for (int id = 0; id < facts.start_count(); ++id) view.place(id, state.particles[static_cast<std::size_t>(id)]);
  check_started(facts, view.start());
  for (const StoredHistory& h : state.histories) {
    // Walls that this case does not have took their history with them, and so did rolling resistance.
    if (h.partner == -1 && !facts.has_wall) continue;
    if (h.partner < -1 && facts.is_periodic) continue;
    if (h.partner == -3 && facts.line.is_open) continue;
    const ContactCoefficients& kind = h.partner >= 0 ? facts.pair_contact : facts.wall_contact;
    constexpr double none[3] = {0, 0, 0};
    view.restore_history(h.owner, h.partner, h.history, kind.rolling_friction > 0 ? h.rolling : none);
  }
}

}  // namespace fixdem::program
