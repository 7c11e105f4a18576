// Measures the first collision of a scene of one or two particles, from the state after every single step.
//
// The state before is that of the last step without overlap, the state after that of the first one. n is the normal at
// that moment, from the particle with the lower number to its partner (a wall: outwards), t the direction of the
// tangential velocity before (between centres; where there is none, of the surfaces), v the relative velocity.
//   restitution             -(v . n) after / (v . n) before
//   tangential_restitution  (v . t) after / (v . t) before, of the centres
//   angular_velocity        of the lower-numbered particle after, along n x t: friction against t makes it negative,
//                           -(5/2) mu (1 + e) v_n / R when a sphere without spin slides throughout on a wall
//   contact_time            between the zero crossings of the overlap, each interpolated linearly between two steps
//   max_overlap, max_normal_force   of the parabola through the maximum value and its neighbours
// Particles that overlap from the start are not a collision until they have parted. SI units.
#pragma once

#include <optional>
#include <vector>

#include "case_facts.hpp"
#include "contact_motion.hpp"
#include "simulation_view.hpp"

namespace fixdem::program {

struct Collision {
  double restitution, tangential_restitution, angular_velocity;  ///< not a number until it is over, or not defined
  double contact_time, max_overlap, max_normal_force;
  template <class Archive>
  void transfer(Archive& archive) {
    archive(restitution, tangential_restitution, angular_velocity, contact_time, max_overlap, max_normal_force);
  }
};

/// Maximum value of a curve known at equal intervals.
class ParabolicMaximum {
 public:
  void add(double value);
  double value() const { return best_; }
  template <class Archive>
  void transfer(Archive& archive) {
    archive(before_, middle_, best_);
  }

 private:
  double before_ = 0, middle_ = 0, best_ = 0;
};

class CollisionTracker {
 public:
  explicit CollisionTracker(const CaseFacts&);

  /// To be called after the start and after every step.
  void observe(const SimulationView&);
  std::optional<Collision> result() const { return result_; }
  /// What a checkpoint says of a collision must be of these particles.
  bool is_consistent() const;
  /// For checkpoints.
  template <class Archive>
  void transfer(Archive& archive) {
    for (Candidate& c : candidates_) archive(c.overlap, c.last_overlap, c.normal);
    archive(particles_, last_particles_, time_, touching_, started_, finished_, begin_time_);
    archive(before_.normal, before_.velocity, before_.slip, overlap_, force_, result_);
  }

 private:
  struct Candidate {
    int owner, partner;  ///< as in Contact: -1 pipe wall, -2 and -3 ends
    double overlap, last_overlap;
    double normal[3];
  };
  struct Encounter : ContactMotion {
    double normal[3];
  };

  void locate(Candidate&) const;
  Encounter encounter(const Candidate&, const double normal[3]) const;
  void begin(const Candidate&, double crossing);
  void follow(const SimulationView&, double step_begin);
  void end();

  CaseFacts facts_;
  std::vector<Candidate> candidates_;
  std::vector<Particle> particles_, last_particles_;
  double time_ = 0;
  int touching_ = -1;  ///< the candidate in contact
  bool started_ = false, finished_ = false;
  double begin_time_ = 0;
  Encounter before_{};
  ParabolicMaximum overlap_, force_;
  std::optional<Collision> result_;
};

}  // namespace fixdem::program
