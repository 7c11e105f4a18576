// What is expected of the kernel when a fault stops a scene, and of the program around it.
//
// The program must stop at the last good step, write a checkpoint that goes on from there, the state, and a frame of
// what lies around the particle that is named, name particle, step and value, say what to change, and end with 4 or 5.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include "cases/pipe_bed.hpp"
#include "guarded.hpp"
#include "loop_end.hpp"
#include "program_run.hpp"
#include "scenes.hpp"
#include "tools/run/case_adapter.hpp"
#include "tools/run/fault_report.hpp"
#include "tools/run/frames_vtp.hpp"
#include "tools/run/neighbourhood.hpp"
#include "tools/run/result_folder.hpp"
#include "tools/run/state_file.hpp"

namespace fixdem::tests {

struct few : cases::pipe_bed {
  static constexpr int particle_count = 4;
  static constexpr double gravity[3] = {0, 0, 0};
  static constexpr double pipe_length = 0.2;
};
inline constexpr double d = few::diameter;

/// Four spheres well apart, at rest.
inline Spheres apart() {
  Spheres spheres(4);
  for (int k = 0; k < 4; ++k) spheres[k].position[2] = 0.02 + 0.04 * k;
  return spheres;
}

struct Expected {
  Fault fault;
  int particle;
  double value, limit;
};

inline void check_status(const Status& status, const Expected& expected) {
  CHECK(status.fault == expected.fault);
  CHECK(status.particle == expected.particle);
  if (std::isnan(expected.value)) {
    CHECK(!std::isfinite(status.value));
  } else {
    CHECK(status.value == doctest::Approx(expected.value).epsilon(1e-6));
  }
  CHECK(status.limit == doctest::Approx(expected.limit).epsilon(1e-12));
}

/// After a fault nothing moves and the status stays.
template <class Case>
void check_final(Simulation<Case>& simulation, const Status& status) {
  const auto before = all_particles(simulation, Case::particle_count);
  const Status again = simulation.run(10);
  CHECK(again.fault == status.fault);
  CHECK(again.step == status.step);
  CHECK(again.particle == status.particle);
  const auto after = all_particles(simulation, Case::particle_count);
  CHECK(std::memcmp(before.data(), after.data(), before.size() * sizeof(Sphere)) == 0);
}

/// Refused by start(), at step 0.
template <class Case>
void check_refused(const Spheres& spheres, const Expected& expected) {
  enter({Case::name, seed()});
  Guarded<Case>& object = guarded<Case>();
  place_all(object.simulation, spheres);
  const Status status = object.simulation.start();
  check_status(status, expected);
  CHECK(status.step == 0);
  CHECK(object.simulation.run(10).fault == expected.fault);
  CHECK(object.simulation.step() == 0);
  CHECK(object.intact());
}

/// The time loop of the program over a started scene whose fault is known.
inline void check_program(program::SimulationView& view, program::CaseFacts facts, const Status& fault) {
  using namespace fixdem::program;
  facts.log_interval = 2e-3, facts.frame_interval = 2e-3;
  Options options;
  options.out = scratch("fault");
  options.duration = 1, options.quiet = true;
  prepare_folder(options.out);
  const LoopEnd end = end_of_loop(view, facts, options);
  const int code = end.code;
  const std::string& message = end.message;
  CAPTURE(message);
  CHECK(code == (fault_exit_code(fault.fault)));
  CHECK((code == exit_capacity || code == exit_unstable));
  CHECK(contains(message, fault_sentence(facts, fault)));
  CHECK(contains(message, "last good state: " + (options.out / "checkpoint-").string()));

  // Found before a step, the state that all steps until then have led to is good; found in a step, the one before.
  const long long good = view.step();
  CHECK((good == fault.step || good == fault.step - 1));
  CHECK(view.run(0).ok());
  const auto checkpoints = checkpoints_in(options.out);
  REQUIRE(checkpoints.size() == 1);
  const Checkpoint checkpoint = read_checkpoint(checkpoints.front(), identity(facts, view));
  CHECK(checkpoint.step == good);
  const auto summary = nlohmann::json::parse(read_bytes(options.out / "summary.json"));
  CHECK(summary["status"] == fault_name(fault.fault));
  CHECK(summary["steps"] == good);
  CHECK(contains(read_bytes(options.out / "log.csv"), "," + std::to_string(good) + ","));
  const StoredState state = read_state(options.out / "stopped.fixdem");
  CHECK(state.step == static_cast<unsigned long long>(good));
  CHECK_FALSE(state.complete);
  CHECK_FALSE(std::filesystem::exists(options.out / "final.fixdem"));

  const Snapshot snapshot = take_snapshot(view, facts.particle_count, facts.has_gas ? facts.slice_count : 0);
  const auto around = neighbourhood(facts, snapshot, fault.particle);
  CHECK(read_bytes(options.out / "fault.vtp") == encode_vtp(snapshot, facts, VtpData::appended, around));
  if (fault.particle >= 0) CHECK(std::count(around.begin(), around.end(), fault.particle) == 1);

  // Whoever goes on from there meets the same fault.
  std::memcpy(view.memory().data(), checkpoint.simulation.data(), checkpoint.simulation.size());
  const Status again = view.run(2);
  CHECK(again.fault == fault.fault);
  CHECK(again.step == fault.step);
  CHECK(again.particle == fault.particle);
}

template <class Case>
void check_program(const Spheres& spheres, const Status& fault) {
  Simulation<Case>& simulation = guarded<Case>().simulation;
  place_all(simulation, spheres);
  REQUIRE(simulation.start().ok());
  program::CaseAdapter<Case> view(simulation);
  check_program(view, program::case_facts<Case>(), fault);
}

/// Accepted by start(), stopped after `step` steps (within `slack`).
template <class Case>
void check_stopped(const Spheres& spheres, const Expected& expected, double step, double slack) {
  enter({Case::name, seed()});
  Guarded<Case>& object = guarded<Case>();
  place_all(object.simulation, spheres);
  REQUIRE(object.simulation.start().ok());
  const Status status = object.simulation.run(100000);
  check_status(status, expected);
  CHECK(std::abs(static_cast<double>(status.step) - step) <= slack);
  CHECK(object.simulation.step() == status.step);
  check_final(object.simulation, status);
  CHECK(object.intact());
  check_program<Case>(spheres, status);
}

}  // namespace fixdem::tests
