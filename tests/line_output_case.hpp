// Lines for tests of what the program sees and writes: a short one that the kernel runs, with everything that is
// watched, and a made-up one of which each test says who is present.
#pragma once

#include "line_scenes.hpp"
#include "tools/run/case_facts.hpp"
#include "tools/run/no_simulation.hpp"

namespace fixdem::tests {

/// What a case says for the program alone.
template <class Line>
struct watched : Line {
  static constexpr const char *title = "a watched line", *source = "", *keys = "", *start_from = "";
  static constexpr unsigned long long source_hash = 0, seed = 1;
  static constexpr double duration = 0.02, log_interval = 2e-3, frame_interval = 5e-3, sample_interval = 1e-3;
  static constexpr double slice_interval = 1e-3, contact_interval = 4e-3, checkpoint_interval = 0;
  static constexpr Probe probes[] = {{0.15, 2e-3}, {0.25, 3e-3}};
  static constexpr int probe_count = 2;
  static constexpr double reference_speed = 2.4, overlap_warning = 1, stability_limit = 1.5, start_velocity = 3;
  static constexpr double max_overlap = 0.5;
  static constexpr bool text_frames = false, dump = true, start_keeps_motion = false;
  static constexpr StartKind start = StartKind::random;
  static constexpr Placed placed[] = {{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}};
};
using WatchedLine = watched<short_line>;
using WatchedSpecies = watched<in_two_species<short_line>>;

/// The facts of the line of acceptance figures: 2 m, slices of 10 mm.
inline program::CaseFacts facts_of_line() {
  program::CaseFacts facts{};
  facts.name = "line", facts.title = facts.source = facts.keys = facts.kernel = "";
  facts.diameter = 0.01, facts.density = 1000, facts.mass = 3.14159265358979324 / 6 * 1e-3;
  facts.particle_count = 6, facts.pipe_diameter = 0.05, facts.pipe_length = 2, facts.slice_count = 200;
  facts.gas_velocity = 2.4, facts.has_wall = facts.has_gas = facts.has_rotation = true;
  facts.gravity[1] = -9.81;
  facts.time_step = 5e-5, facts.sample_interval = 0.01;
  facts.line.is_open = true, facts.line.feed_length = 0.1;
  return facts;
}

/// Room for six; slots 0, 2 and 5 are taken.
class ThreePresent : public program::NoSimulation {
 public:
  bool is_line() const override { return true; }
  bool is_present(int id) const override { return id == 0 || id == 2 || id == 5; }
  long long serial(int id) const override { return id == 2 ? 5000000009 : id + 1; }
  int kind(int id) const override { return id == 5 ? 2 : 0; }
  Particle particle(int id) const override { return {{0, -0.02, 0.1 * (id + 1)}, {0, 0, 0.5}, {}}; }
  std::vector<Contact> contacts() const override {
    Contact pair{}, wall{};
    pair.owner = 5, pair.partner = 2, pair.overlap = 1e-5, pair.normal[2] = -1, pair.normal_force = 2;
    pair.tangential_force[0] = 0.25, pair.history[0] = 1e-7;
    wall.owner = 5, wall.partner = -1, wall.overlap = 2e-5, wall.normal[1] = -1, wall.normal_force = 3;
    wall.tangential_force[2] = -0.5;
    return {wall, pair};
  }
  LineTotals line() const override { return totals; }

  LineTotals totals{4, 3, 4, 3, 0.003, 0.002, 0.001, 0.001, 0.5};
};

}  // namespace fixdem::tests
