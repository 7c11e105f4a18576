// How near a run is to instability: a cheap bound on the time step from the contacts of the moment, never above the
// true limit, and the maximum overlap. Looked at for every row of the log.
//
// Each contact is a normal and a tangential spring with a damper each, and one of each for rolling where that is
// resisted, taken at its present overlap (d force / d overlap; contacts that slide or roll count as sticking, which is
// stiffer). For vectors a, b and any q > 0, |a + b|^2 is at most
// (1 + q) |a|^2 + (1 + 1/q) |b|^2, so a pair is at most as stiff as its two particles each held by a wall in its place,
// 1 + q and 1 + 1/q times as stiff: 6 x 6 blocks of single particles bound the whole matrix. Each is over the mass of
// its particle, so that a sphere of another size takes its own share of a spring; its radius matters for rolling alone
// (rolling_lever). With A(h) = h^2 K + h C of
// a block (C with the integrator's factors, step_criteria.hpp), row sums of absolute values bound its maximum
// eigenvalue, and so does the sixteenth root of those of A^16, much more tightly. The step starts where row sums a of K
// and b of C give a h^2 + b h = 4; since A(t h) is at most t^2 A(h) for t > 1, it may then be raised to h sqrt(4 /
// bound(h)), again and again. The smallest step of all particles is the stable step: never above the true limit, and
// 0.7 to 0.9 of it on a settled bed (`make stability`).
//
// Every comparison is written so that a value that is no number fails it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "case_facts.hpp"
#include "contact_kinds.hpp"
#include "kernel/fixdem.hpp"
#include "snapshot.hpp"
#include "step_criteria.hpp"

namespace fixdem::program {

/// Stiffness (N/m) and damping (kg/s) of one contact at its present overlap. Those of rolling belong to the rolling
/// displacement, whose rate is R* (omega_i - omega_j) x n.
struct TangentSpring {
  double stiffness, tangential_stiffness, damping, tangential_damping;
  double rolling_stiffness = 0, rolling_damping = 0;
};
TangentSpring tangent_spring(NormalLaw, const ContactCoefficients&, double overlap);

struct StableStep {
  double seconds;  ///< infinite without contacts
  int particle;    ///< whose contacts allow no more; -1 without contacts
};
/// `of`: what the contacts are of, to know kinds and number of the particles of a line.
StableStep stable_step(const CaseFacts&, const StepCriterion&, const std::vector<Contact>&,
                       const Snapshot* of = nullptr);

class StabilityWatch {
 public:
  explicit StabilityWatch(const CaseFacts& facts) : facts_(facts) {}

  /// Looks at the contacts of one moment. True: the time step is beyond the limit, the run must not go on.
  bool look(double time, const std::vector<Contact>&, double max_overlap, const Snapshot* of = nullptr);

  double ratio() const { return ratio_; }                  ///< time step / stable step at the last look
  double maximum_ratio() const { return maximum_ratio_; }  ///< of all looks
  /// A warning that has just become due, or empty; each kind comes once.
  std::string take_warning();
  /// What is wrong and what to change, after look() has returned true.
  std::string stop_message() const;
  long long particle() const { return particle_; }  ///< its serial number; -1: none
  /// For checkpoints.
  template <class Archive>
  void transfer(Archive& archive) {
    archive(ratio_, maximum_ratio_, stable_, time_, particle_, has_warned_of_step_, has_warned_of_overlap_);
  }

 private:
  std::string excess(double time) const;

  const CaseFacts& facts_;
  double ratio_ = 0, maximum_ratio_ = 0, stable_ = 0, time_ = 0;
  long long particle_ = -1;
  bool has_warned_of_step_ = false, has_warned_of_overlap_ = false;
  std::string warning_;
};

}  // namespace fixdem::program
