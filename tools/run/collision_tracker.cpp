#include "collision_tracker.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace fixdem::program {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
using Vector = std::array<double, 3>;

double dot(const double* a, const double* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector cross(const double* a, const double* b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vector tangential(const double* v, const double* n) {
  const double along = dot(v, n);
  return {v[0] - along * n[0], v[1] - along * n[1], v[2] - along * n[2]};
}
double length(const Vector& v) { return std::sqrt(dot(v.data(), v.data())); }

}  // namespace

void ParabolicMaximum::add(double value) {
  best_ = std::max(best_, value);
  const double bend = before_ - 2 * middle_ + value;
  if (middle_ >= before_ && middle_ >= value && bend < 0)
    best_ = std::max(best_, middle_ - (value - before_) * (value - before_) / (8 * bend));
  before_ = middle_;
  middle_ = value;
}

CollisionTracker::CollisionTracker(const CaseFacts& facts) : facts_(facts) {
  for (int i = 0; i < facts.particle_count; ++i) {
    if (facts.has_wall) candidates_.push_back({i, -1, 0, 0, {}});
    if (!facts.is_periodic) {
      candidates_.push_back({i, -2, 0, 0, {}});
      candidates_.push_back({i, -3, 0, 0, {}});
    }
    for (int j = i + 1; j < facts.particle_count; ++j) candidates_.push_back({i, j, 0, 0, {}});
  }
}

/// Overlap and normal from the positions.
void CollisionTracker::locate(Candidate& c) const {
  const double* x = particles_[static_cast<std::size_t>(c.owner)].position;
  const double radius = facts_.radius_of(c.owner);
  const auto set = [&c](double overlap, double nx, double ny, double nz) {
    c.overlap = overlap;
    c.normal[0] = nx, c.normal[1] = ny, c.normal[2] = nz;
  };
  if (c.partner == -1) {
    const double q = std::sqrt(x[0] * x[0] + x[1] * x[1]);
    set(q - (facts_.pipe_diameter / 2 - radius), q > 0 ? x[0] / q : 1, q > 0 ? x[1] / q : 0, 0);
  } else if (c.partner == -2) {
    set(radius - x[2], 0, 0, -1);
  } else if (c.partner == -3) {
    set(x[2] - (facts_.pipe_length - radius), 0, 0, 1);
  } else {
    const double* y = particles_[static_cast<std::size_t>(c.partner)].position;
    Vector d{y[0] - x[0], y[1] - x[1], y[2] - x[2]};
    if (facts_.is_periodic) d[2] -= facts_.pipe_length * std::round(d[2] / facts_.pipe_length);
    const double distance = length(d), touching = radius + facts_.radius_of(c.partner);
    if (distance > 0)
      set(touching - distance, d[0] / distance, d[1] / distance, d[2] / distance);
    else
      set(touching, 0, 0, 1);
  }
}

CollisionTracker::Encounter CollisionTracker::encounter(const Candidate& c, const double normal[3]) const {
  const double radius = facts_.radius_of(c.owner);
  const bool is_pair = c.partner >= 0;
  return {contact_motion(particles_[static_cast<std::size_t>(c.owner)], radius,
                         is_pair ? &particles_[static_cast<std::size_t>(c.partner)] : nullptr,
                         is_pair ? facts_.radius_of(c.partner) : radius, normal),
          {normal[0], normal[1], normal[2]}};
}

void CollisionTracker::begin(const Candidate& c, double crossing) {
  begin_time_ = crossing;
  // The state before belongs to the step before: locate the contact there.
  std::swap(particles_, last_particles_);
  Candidate before = c;
  locate(before);
  before_ = encounter(before, before.normal);
  std::swap(particles_, last_particles_);
  overlap_.add(before.overlap);
  force_.add(0);
  result_ = Collision{nan, nan, nan, nan, 0, 0};
}

void CollisionTracker::end() {
  const Candidate& c = candidates_[static_cast<std::size_t>(touching_)];
  const Encounter after = encounter(c, c.normal);
  result_->restitution = -dot(after.velocity, after.normal) / dot(before_.velocity, before_.normal);
  const double speed = std::sqrt(dot(before_.velocity, before_.velocity));
  const Vector sideways = tangential(before_.velocity, before_.normal);
  Vector t{before_.slip[0], before_.slip[1], before_.slip[2]};
  if (length(sideways) > 1e-9 * speed) {
    t = sideways;
    const Vector sideways_after = tangential(after.velocity, after.normal);
    result_->tangential_restitution = dot(sideways_after.data(), t.data()) / dot(t.data(), t.data());
  }
  if (const double size = length(t); size > 1e-9 * speed) {
    const Vector axis = cross(before_.normal, t.data());
    const Particle& owner = particles_[static_cast<std::size_t>(c.owner)];
    result_->angular_velocity = dot(owner.angular_velocity, axis.data()) / size;
  }
  finished_ = true;
}

void CollisionTracker::follow(const SimulationView& view, double step_begin) {
  const Candidate& c = candidates_[static_cast<std::size_t>(touching_)];
  double force = 0;
  for (const Contact& contact : view.contacts())
    if ((contact.owner == c.owner && contact.partner == c.partner) ||
        (contact.owner == c.partner && contact.partner == c.owner))
      force = contact.normal_force;
  overlap_.add(c.overlap);
  force_.add(force);
  result_->max_overlap = overlap_.value();
  result_->max_normal_force = force_.value();
  if (c.overlap > 0) return;
  const double part = c.last_overlap / (c.last_overlap - c.overlap);
  result_->contact_time = step_begin + part * (time_ - step_begin) - begin_time_;
  end();
}

bool CollisionTracker::is_consistent() const {
  const auto count = static_cast<std::size_t>(facts_.particle_count);
  if (finished_) return true;
  if (started_ && particles_.size() != count) return false;
  return touching_ == -1 ||
         (started_ && result_ && touching_ >= 0 && static_cast<std::size_t>(touching_) < candidates_.size());
}

void CollisionTracker::observe(const SimulationView& view) {
  if (finished_) return;
  const double step_begin = time_;
  time_ = view.time();
  std::swap(particles_, last_particles_);
  particles_.clear();
  for (int id = 0; id < facts_.particle_count; ++id) particles_.push_back(view.particle(id));

  for (Candidate& c : candidates_) {
    c.last_overlap = c.overlap;
    locate(c);
    if (!started_ || touching_ >= 0 || !(c.last_overlap <= 0 && c.overlap > 0)) continue;
    touching_ = static_cast<int>(&c - candidates_.data());
    begin(c, step_begin + (time_ - step_begin) * c.last_overlap / (c.last_overlap - c.overlap));
  }
  started_ = true;
  if (touching_ >= 0) follow(view, step_begin);
}

}  // namespace fixdem::program
