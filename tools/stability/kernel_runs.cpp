// Runs of the kernel itself, compiled for one time step and integrator.
//
//   kernel_runs rest STATE OUT_STATE        without gas and with little rebound, until nothing has moved faster than
//                                           1e-9 m/s for a while (or 3 s have passed); the state goes to OUT_STATE
//   kernel_runs bed STATE                   pushed by 1e-9 m/s at random, 600 steps: prints how kinetic energy grew
//   kernel_runs decay OUT.csv DURATION      the case from its own start: kinetic energy against time
//
// Defines beside those of a program: FIXDEM_TIME_STEP, FIXDEM_INTEGRATOR, FIXDEM_RESTITUTION, and FIXDEM_STILL, which
// takes the gas away. Each is optional. Prints one line; a fault is part of it and not an error.
#include FIXDEM_CASE_HEADER

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

#include "tools/run/case_adapter.hpp"
#include "tools/run/case_facts.hpp"
#include "tools/run/fault_report.hpp"
#include "tools/run/home.hpp"
#include "tools/run/random_numbers.hpp"
#include "tools/run/start.hpp"
#include "tools/run/state_file.hpp"

namespace {

using namespace fixdem;

struct Scene : cases::FIXDEM_CASE {
  using Case = cases::FIXDEM_CASE;
#ifdef FIXDEM_TIME_STEP
  static constexpr double time_step = FIXDEM_TIME_STEP;
#endif
#ifdef FIXDEM_INTEGRATOR
  static constexpr auto integrator = Integrator::FIXDEM_INTEGRATOR;
#endif
#ifdef FIXDEM_RESTITUTION
  static constexpr double restitution = FIXDEM_RESTITUTION, wall_restitution = FIXDEM_RESTITUTION;
#endif
#ifdef FIXDEM_STILL
  static constexpr bool has_gas = false;
#endif
};

program::Home<Simulation<Scene>> home;
Simulation<Scene>& simulation = home.simulation();

double kinetic(const Observation& seen) { return seen.kinetic_translation + seen.kinetic_rotation; }

std::string outcome(const Status& status) {
  return status.ok() ? "done" : program::fault_sentence(program::case_facts<Scene>(), status);
}

/// The particles of a file with its contact histories, each component of the velocity uniform in +-push.
Status place(const program::StoredState& state, double push) {
  program::RandomNumbers random(1);
  for (int id = 0; id < simulation.count; ++id) {
    Particle p = state.particles[static_cast<std::size_t>(id)];
    for (int c = 0; c < 3; ++c) p.velocity[c] = random.between(-push, push), p.angular_velocity[c] = 0;
    simulation.place(id, p);
  }
  const Status status = simulation.start();
  for (const auto& h : state.histories) simulation.restore_history(h.owner, h.partner, h.history, h.rolling);
  return status;
}

/// Kinetic damping: whenever the kinetic energy begins to fall, the bed is on its way through a place nearer to
/// equilibrium, and all is stopped there. Without it a sphere that rolls to and fro between others takes many seconds
/// to stop; and at the turning point of such a motion a look at the speed alone takes it for one at rest.
int rest(const std::string& from, const std::string& to) {
  constexpr int steps_per_look = 250, quiet_looks = 20;
  constexpr double at_rest = 1e-9, damped_below = 1e-3, time_limit = 3;  // m/s, m/s, s
  const program::CaseFacts facts = program::case_facts<Scene>();
  const program::CaseAdapter<Scene> view(simulation);
  const auto state = [&] {
    return program::stored_state(facts, program::take_snapshot(view, facts.particle_count), true, 3);
  };
  Status status = place(program::read_state(from), 0);
  Observation seen = simulation.observe();
  double time = 0, fastest = 0;
  for (int quiet = 0; status.ok() && quiet < quiet_looks && time < time_limit;) {
    const double last = kinetic(seen);
    status = simulation.run(steps_per_look);
    time += steps_per_look * Scene::time_step;
    seen = simulation.observe();
    fastest = seen.max_speed > fastest || quiet == 0 ? seen.max_speed : fastest;
    quiet = seen.max_speed < at_rest ? quiet + 1 : 0;
    if (status.ok() && quiet == 0 && seen.max_speed < damped_below && kinetic(seen) < last) {
      status = place(state(), 0);
      seen = simulation.observe();
    }
  }
  std::fputs(fmt::format("{},{:.3g},{:.3g}\n", outcome(status), time, fastest).c_str(), stdout);
  if (!status.ok()) return 1;
  program::write_state(to, state());
  return 0;
}

int bed(const std::string& from) {
  Status status = place(program::read_state(from), 1e-9);
  const double given = kinetic(simulation.observe());
  if (status.ok()) status = simulation.run(600);
  std::fputs(fmt::format("{},{:.3g}\n", outcome(status), kinetic(simulation.observe()) / given).c_str(), stdout);
  return 0;
}

int decay(const std::string& to, double duration) {
  constexpr program::CaseFacts facts = program::case_facts<Scene>();
  program::CaseAdapter<Scene> view(simulation);
  program::Options options;
  options.out = std::string("out/") + facts.name;
  options.seed = facts.seed;
  options.quiet = true;
  program::start_simulation(view, facts, options);
  std::ofstream file(to);
  file << "time [s],kinetic energy [J],maximum overlap / radius\n";
  Status status;
  const auto steps = std::llround(duration / facts.time_step);
  constexpr int rows = 100;
  double deepest = 0;
  for (int row = 0; row <= rows && status.ok(); ++row) {
    status = simulation.run(steps * row / rows - simulation.step());
    const Observation seen = simulation.observe();
    deepest = std::fmax(deepest, seen.max_overlap / facts.smallest_radius());
    file << fmt::format("{:.5g},{:.6g},{:.4g}\n", simulation.time(), kinetic(seen),
                        seen.max_overlap / facts.smallest_radius());
  }
  std::fputs(fmt::format("{},{:.6g},{:.4g}\n", outcome(status), kinetic(simulation.observe()), deepest).c_str(),
             stdout);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string mode = argc > 1 ? argv[1] : "";
  try {
    if (mode == "rest" && argc == 4) return rest(argv[2], argv[3]);
    if (mode == "bed" && argc == 3) return bed(argv[2]);
    if (mode == "decay" && argc == 4) return decay(argv[2], std::atof(argv[3]));
  } catch (const std::exception& error) {
    std::fputs(fmt::format("kernel_runs: {}\n", error.what()).c_str(), stderr);
    return 1;
  }
  std::fputs("usage: kernel_runs rest STATE OUT_STATE | bed STATE | decay OUT.csv DURATION\n", stderr);
  return 2;
}
