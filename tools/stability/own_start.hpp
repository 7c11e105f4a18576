// The start of a case as plain particles: what its program would place, without a kernel to place them in.
#pragma once

#include "tools/run/no_simulation.hpp"
#include "tools/run/start.hpp"
#include "trials.hpp"

namespace fixdem::stability {

/// Takes down what it is given; it never moves.
class StartRecorder final : public program::NoSimulation {
 public:
  Scene scene;

  void place(int id, const Particle& particle) override {
    scene.particles.resize(std::max(scene.particles.size(), static_cast<std::size_t>(id) + 1));
    scene.particles[static_cast<std::size_t>(id)] = particle;
  }
  void restore_history(int owner, int partner, const double (&h)[3], const double (&rolling)[3]) override {
    scene.histories.push_back({owner, partner, {h[0], h[1], h[2]}, {rolling[0], rolling[1], rolling[2]}});
  }
  Particle particle(int id) const override { return scene.particles[static_cast<std::size_t>(id)]; }
};

/// The start of the case; a case that starts from another one finds its final state in out/.
inline Scene own_start() {
  const program::CaseFacts facts = program::case_facts<Case>();
  program::Options options;
  options.out = std::string("out/") + facts.name;
  options.seed = facts.seed;
  options.quiet = true;
  StartRecorder recorder;
  program::start_simulation(recorder, facts, options);
  return recorder.scene;
}

}  // namespace fixdem::stability
