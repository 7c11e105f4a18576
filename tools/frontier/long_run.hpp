// Observables of a long run, which chaos leaves alone: what a user of a granular simulation looks at.
//
// From the case's own start with the given seed (or from a stored state, when the case starts from another one),
// sampled eighty times. Height of the centres above the pipe's bottom and coordination number: means over the last
// fifth. Decay time: when the kinetic energy last falls below a tenth of the largest one, interpolated in its
// logarithm; not a number while it has not. Front velocity and layer area ratio of the plug over the second half, as in
// summary.json (tools/run/plug_analysis.hpp). SI units.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "kernel/fixdem.hpp"
#include "tools/run/case_adapter.hpp"
#include "tools/run/case_facts.hpp"
#include "tools/run/plug_analysis.hpp"
#include "tools/run/start.hpp"

namespace fixdem::frontier {

struct LongRun {
  Status status;
  double height, coordination, decay_time, front_velocity, layer_ratio;
};

struct EnergySample {
  double time, kinetic;
};

inline double decay_time(const std::vector<EnergySample>& samples) {
  double maximum = 0, found = std::numeric_limits<double>::quiet_NaN();
  for (const EnergySample& s : samples) maximum = std::max(maximum, s.kinetic);
  const double level = maximum / 10;
  for (std::size_t k = 1; k < samples.size(); ++k) {
    const auto &a = samples[k - 1], &b = samples[k];
    if (a.kinetic >= level && b.kinetic < level)
      found = a.time + (b.time - a.time) * std::log(a.kinetic / level) / std::log(a.kinetic / b.kinetic);
    else if (b.kinetic >= level)
      found = std::numeric_limits<double>::quiet_NaN();
  }
  return found;
}

template <class Setting>
LongRun long_run(Simulation<Setting>& simulation, unsigned long long seed, double seconds, const char* state) {
  constexpr int samples = 80, last = samples / 5;
  program::CaseAdapter<Setting> view(simulation);
  const program::CaseFacts facts = program::case_facts<Setting>();
  program::Options options;
  options.seed = seed, options.quiet = true;
  if (state != nullptr) options.start_state = state;
  program::start_simulation(view, facts, options);

  LongRun seen{};
  std::vector<EnergySample> energies{{0, view.observe().kinetic_translation + view.observe().kinetic_rotation}};
  program::PlugRecord plugs(facts.pipe_length);
  for (int k = 1; k <= samples; ++k) {
    seen.status = view.run(std::llround(seconds * k / samples / Setting::time_step) - view.step());
    if (!seen.status.ok()) return seen;
    const Observation o = view.observe();
    energies.push_back({view.time(), o.kinetic_translation + o.kinetic_rotation});
    if (k > samples - last) seen.height += o.mean_height / last, seen.coordination += o.coordination_number / last;
    if (Setting::has_gas) {
      std::vector<double> gradients;
      for (int slice = 0; slice < Setting::slice_count; ++slice) gradients.push_back(view.pressure_gradient(slice));
      const auto snapshot = program::take_snapshot(view, Setting::particle_count);
      plugs.add(program::find_plug(program::slice_profile(facts, snapshot, gradients), view.time()));
    }
  }
  seen.decay_time = decay_time(energies);
  seen.front_velocity = seen.layer_ratio = std::numeric_limits<double>::quiet_NaN();
  if (Setting::has_gas) {
    const double g = std::hypot(facts.gravity[0], facts.gravity[1], facts.gravity[2]);
    const program::PlugResult plug = plugs.result(seconds, g, facts.pipe_diameter);
    seen.front_velocity = plug.front_velocity, seen.layer_ratio = plug.layer_area_ratio;
  }
  return seen;
}

}  // namespace fixdem::frontier
