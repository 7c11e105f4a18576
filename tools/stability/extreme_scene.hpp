// One extreme scene in the kernel: what the program of such a case would say and do.
//
// A scene is the case with a few values changed, scaled down to few particles so that it compiles quickly. It is run in
// pieces, with the watch of a program (tools/run/stability_watch.hpp) after each; the first fault, the watch's stop, or
// the end of the scene decides. The verdict is one of
//   stable         ran to its end; the answer is right as far as the scene can tell
//   warned         the same, and the watch, or the count of steps per contact, has warned: the answer may be wrong, and
//                  the user has been told
//   refused        the kernel would not start
//   stopped        a fault, or the watch, ended the run with a message
//   DEFECT         a value that is no number, an energy out of nothing, or a wrong rebound, without a word
// Lengths of scenes are given in diameters, so that they suit any case.
#pragma once

#include FIXDEM_CASE_HEADER

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "tools/run/case_adapter.hpp"
#include "tools/run/case_facts.hpp"
#include "tools/run/contact_time.hpp"
#include "tools/run/energy_balance.hpp"
#include "tools/run/fault_report.hpp"
#include "tools/run/stability_watch.hpp"
#include "tools/run/start.hpp"

namespace fixdem::stability {

using Own = cases::FIXDEM_CASE;

/// What scenes start from: the case without gas and weight, few particles, and room for few neighbours.
struct Small : Own {
  static constexpr int particle_count = 3, neighbour_capacity = 4, slice_count = 20;
  static constexpr bool has_gas = false, has_wall = true, energy_ledger = true;
  static constexpr Ends ends = Ends::periodic;
  static constexpr double pipe_diameter = 5 * Own::diameter, pipe_length = 20 * Own::diameter;
  static constexpr double gravity[3] = {0, 0, 0};
};

/// Contact time of the shortest impact at 1 m/s, s, at compile time.
template <class Case>
constexpr double contact_time() {
  using D = Derived<Case>;
  if (!D::is_hertz) return linear_contact_time(D::mass / 2, D::stiffness_pair);
  const double pair = hertz_contact_time(D::mass / 2, D::stiffness_pair, 1);
  const double wall = hertz_contact_time(D::mass, D::stiffness_wall, 1);
  return pair < wall ? pair : wall;
}

/// The scene at a step that resolves a collision at 1 m/s.
template <class Case, int steps = 60>
struct Resolved : Case {
  static constexpr double time_step = contact_time<Case>() / steps;
};

struct Row {
  std::string verdict, message;
  double balance_error = NAN, max_overlap = NAN, restitution = NAN;
};

struct Scene {
  std::string name;
  std::function<Row()> run;
};

inline std::string one_line(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  for (std::size_t at; (at = text.find('\n')) != std::string::npos;) text.replace(at, 1, "; ");
  std::replace(text.begin(), text.end(), '"', '\'');
  for (std::size_t at; (at = text.find("  ")) != std::string::npos;) text.erase(at, 1);
  return text;
}

/// Runs particles for so many steps. `restitution`: of the first two along z, where the scene is a collision of theirs;
/// the rebound must come back within 0.02. `look_interval`: steps between two looks of the watch.
template <class Case>
Row run_scene(const std::vector<Particle>& particles, long long steps, bool is_collision, long long look_interval) {
  static Simulation<Case> simulation;
  static const program::CaseFacts facts = program::case_facts<Case>();
  program::CaseAdapter<Case> view(simulation);
  Row row;
  for (int id = 0; id < simulation.count; ++id) simulation.place(id, particles[static_cast<std::size_t>(id)]);
  const Status refused = simulation.start();
  const auto sentence = [&](const Status& status, double speed) {
    return one_line(fmt::format("exit code {}: {}; {}", static_cast<int>(program::fault_exit_code(status.fault)),
                                program::fault_sentence(facts, status), program::fault_advice(facts, status, speed)));
  };
  if (!refused.ok()) {
    row.verdict = "refused";
    try {
      program::check_started(facts, refused);
    } catch (const program::Failure& failure) {
      row.message = one_line(fmt::format("exit code {}: {}", static_cast<int>(failure.code()), failure.what()));
    }
    row.max_overlap = refused.fault == Fault::overlap ? refused.value : NAN;
    return row;
  }

  const auto closing = [&] { return simulation.particle(0).velocity[2] - simulation.particle(1).velocity[2]; };
  const double before = is_collision ? closing() : 0;
  const Energy begin = simulation.energy();
  program::StabilityWatch watch(facts);
  double deepest = simulation.observe().max_overlap, fastest = simulation.observe().max_speed;
  bool must_stop = watch.look(0, view.contacts(), deepest);
  std::string warning = watch.take_warning();
  Status status;
  while (!must_stop && status.ok() && simulation.step() < steps) {
    status = simulation.run(std::min(look_interval, steps - simulation.step()));
    const Observation seen = simulation.observe();
    deepest = std::fmax(deepest, seen.max_overlap);
    if (status.ok()) fastest = std::fmax(fastest, seen.max_speed);
    must_stop = status.ok() && watch.look(simulation.time(), view.contacts(), seen.max_overlap);
    warning += watch.take_warning();
  }
  warning += program::contact_warning(facts, simulation.deepest_overlap());
  const Energy end = simulation.energy();
  row.balance_error = program::balance_error(begin, end), row.max_overlap = deepest / facts.smallest_radius();
  if (is_collision && status.ok()) row.restitution = -closing() / before;
  if (!status.ok()) {
    row.verdict = "stopped", row.message = sentence(status, fastest);
    return row;
  }
  if (must_stop) {
    row.verdict = "stopped", row.message = one_line("exit code 5: " + watch.stop_message());
    return row;
  }
  row.verdict = warning.empty() ? "stable" : "warned";

  std::string defect;
  for (int id = 0; id < simulation.count; ++id) {
    const Particle p = simulation.particle(id);
    for (int c = 0; c < 3; ++c)
      if (!std::isfinite(p.position[c] + p.velocity[c] + p.angular_velocity[c])) defect = "a value is no number; ";
  }
  const double given = begin.kinetic + begin.elastic + std::fabs(end.gravity_work) + std::fabs(end.gas_work);
  const double gained = end.kinetic + end.elastic - begin.kinetic - begin.elastic - end.gravity_work - end.gas_work;
  // Motion of less than a unit in the last place of a position per step is not resolved, and its energy is noise.
  const double least_speed = 2.2e-16 * std::fmax(Case::pipe_length, Case::pipe_diameter) / Case::time_step;
  const double noise = simulation.count * facts.mass * least_speed * least_speed;
  if (given <= noise) row.message += fmt::format("all below the resolution of positions ({:.1g} m/s); ", least_speed);
  if (!(gained <= 0.02 * given + noise))
    defect += fmt::format("energy has grown by {:.3g} of what was given; ", gained / given);
  if (is_collision && !(std::fabs(row.restitution - Case::restitution) <= 0.02)) defect += "the rebound is wrong; ";
  if (!defect.empty() && warning.empty()) row.verdict = "DEFECT";
  row.message = one_line(defect + row.message + warning);
  return row;
}

/// Lists the names of the scenes, or runs the one of the given number and prints it as a line of a CSV file.
inline int main_of(const std::vector<Scene>& scenes, int argc, char** argv) {
  if (argc < 2) {
    for (const Scene& scene : scenes) std::puts(scene.name.c_str());
    return 0;
  }
  const std::size_t number = static_cast<std::size_t>(std::atoi(argv[1]));
  if (number >= scenes.size()) return 2;
  const Row row = scenes[number].run();
  const auto value = [](double x) { return std::isnan(x) ? std::string() : fmt::format("{:.3g}", x); };
  std::puts(fmt::format("\"{}\",{},{},{},{},\"{}\"", scenes[number].name, row.verdict, value(row.balance_error),
                        value(row.max_overlap), value(row.restitution), row.message)
                .c_str());
  return 0;
}

}  // namespace fixdem::stability
