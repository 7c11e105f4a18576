// How near a run is to instability: a cheap bound on the time step from the contacts of the moment, never above the
// true limit, and the greatest overlap. Looked at for every row of the log.
//
// Each contact is a normal and a tangential spring with a damper each, taken at its present overlap (d force / d
// overlap; sliding contacts count as sticking, which is stiffer). For two vectors |a + b|^2 <= 2 |a|^2 + 2 |b|^2, so
// the stiffness of a pair is at most twice that of each of its particles against a wall in its place: the 6 x 6 blocks
// of single particles, pairs doubled, bound the whole matrix, and the greatest row sum of absolute values bounds the
// greatest eigenvalue of a block. A row with sums a (stiffness over mass, 1/s2) and b (damping, with the integrator's
// factors, 1/s) allows the step h of a h^2 + b h = 4 (step_criteria.hpp); the smallest of all rows is the stable step.
//
// Every comparison is written so that a value that is no number fails it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "case_facts.hpp"
#include "kernel/fixdem.hpp"
#include "step_criteria.hpp"

namespace fixdem::program {

/// Stiffness (N/m) and damping (kg/s) of one contact at its present overlap.
struct TangentSpring {
  double stiffness, tangential_stiffness, damping, tangential_damping;
};
TangentSpring tangent_spring(NormalLaw, const ContactCoefficients&, double overlap);

struct StableStep {
  double seconds;  ///< infinite without contacts
  int particle;    ///< whose contacts allow no more; -1 without contacts
};
StableStep stable_step(const CaseFacts&, const StepCriterion&, const std::vector<Contact>&);

class StabilityWatch {
 public:
  explicit StabilityWatch(const CaseFacts& facts) : facts_(facts) {}

  /// Looks at the contacts of one moment. True: the time step is beyond the limit, the run must not go on.
  bool look(double time, const std::vector<Contact>&, double max_overlap);

  double ratio() const { return ratio_; }                    ///< time step / stable step at the last look
  double greatest_ratio() const { return greatest_ratio_; }  ///< of all looks
  /// A warning that has just become due, or empty; each kind comes once.
  std::string take_warning();
  /// What is wrong and what to change, after look() has returned true.
  std::string stop_message() const;
  int particle() const { return particle_; }

 private:
  std::string excess(double time) const;

  const CaseFacts& facts_;
  double ratio_ = 0, greatest_ratio_ = 0, stable_ = 0, time_ = 0;
  int particle_ = -1;
  bool has_warned_of_step_ = false, has_warned_of_overlap_ = false;
  std::string warning_;
};

}  // namespace fixdem::program
