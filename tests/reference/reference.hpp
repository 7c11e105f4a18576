// The reference: the whole model once more, as slowly and plainly as possible, to hold the kernel against.
//
// Written from the equations of Tsuji, Tanaka & Ishida (1992) and not from the kernel; the two share the constants of
// a case and the names of its choices, nothing else. All pairs are visited every step (only a difference along the
// pipe greater than a diameter is skipped early) unless a list is asked for (near_pairs.hpp), contacts live in a map,
// forces are summed in the order they are found. `Scalar` may be long double, to see what rounding does. The public
// functions are named as the kernel's, so that a test can be written once for both. SI units; positions along z lie in
// [0, length) when the pipe is periodic.
//
// One step: of a line, feeding; floaters and gas (at their intervals), forces from current positions and velocities,
// then v, omega with the force and x with the new v (eqs. 3-5), and of a line the outlet. `leapfrog` holds positions
// half a step ahead of the velocities and damps the normal motion at velocities predicted with the acceleration of the
// step before; `impulse` holds them ahead too.
#pragma once

#include <Eigen/Core>
#include <map>
#include <vector>

#include "impulse_reference.hpp"
#include "line_reference.hpp"
#include "near_pairs.hpp"
#include "spheres_in_gas_reference.hpp"

namespace fixdem::reference {

template <class Case, class Scalar = double>
class Reference {
 public:
  using Vector3 = Vector<Scalar>;

  void place(int id, const Particle& p) {
    spheres_.resize(count_at_start<Case>());
    Sphere& s = spheres_[id];
    s = Sphere{};
    s.own = sphere_properties<Case, Scalar>(id), s.kind = id;
    s.x = from_array(p.position), s.v = from_array(p.velocity), s.omega = from_array(p.angular_velocity);
  }

  void start() {
    contacts_.clear();
    if constexpr (is_line<Case>) spheres_.resize(Case::start_count), line_.start();
    energy_ = {};
    step_ = 0;
    for (Sphere& s : spheres_) {
      if (Case::integrator != Integrator::euler) s.x += s.v * dt / 2;
      wrap(s);
    }
  }

  /// Hands over the histories of a contact, seen from `owner`, before the first step. That of rolling is the same from
  /// either side.
  void restore_history(int owner, int partner, const double h[3], const double* rolling = nullptr) {
    const bool swapped = partner >= 0 && partner < owner;
    Memory<Scalar>& memory = contacts_[swapped ? Key{partner, owner} : Key{owner, partner}].memory;
    memory.history = from_array(h) * Scalar(swapped ? -1 : 1);
    if (rolling != nullptr) memory.rolling.history = from_array(rolling);
  }

  /// Visits listed pairs only: the same results, sooner.
  void look_ahead(Scalar margin) { near_.look_ahead(2 * largest, margin); }

  void run(long long steps) {
    for (; steps > 0; --steps) step_once();
  }

  long long step() const { return step_; }

  Particle particle(int id) const {
    Sphere s = spheres_[id];
    if (Case::integrator != Integrator::euler) s.x -= s.v * dt / 2;
    wrap(s);
    Particle p;
    for (int k = 0; k < 3; ++k) {
      p.position[k] = static_cast<double>(s.x[k]);
      p.velocity[k] = static_cast<double>(s.v[k]);
      p.angular_velocity[k] = static_cast<double>(s.omega[k]);
    }
    return p;
  }

  /// Visits the contacts of the last force evaluation.
  template <class F>
  void for_each_contact(F&& visit) const {
    for (const auto& [key, contact] : contacts_)
      if (contact.overlap > 0) visit(shown(key, contact));
  }

  /// Kinetic energy now, elastic energy at the last force evaluation, the rest since the start.
  Energy energy() const {
    Energy e = energy_;
    e.kinetic = e.elastic = 0;
    for (const Sphere& s : spheres_)
      if (s.is_present) e.kinetic += static_cast<double>(kinetic_energy(s));
    for (const auto& [key, contact] : contacts_) e.elastic += static_cast<double>(contact.force.elastic_energy);
    return e;
  }

  /// Flow in each slice at the last update of the gas.
  const std::vector<SliceFlow<Scalar>>& slices() const { return slices_; }
  const GasInPipe<Case, Scalar>& gas() const { return gas_; }
  bool floats(int id) const { return spheres_[id].floats; }

  /// Particles so far, of a line: numbers go on, whoever leaves.
  int count() const { return static_cast<int>(spheres_.size()); }
  bool is_present(int id) const { return spheres_[id].is_present; }
  int kind(int id) const { return spheres_[id].kind; }
  LineTotals line() const { return line_.totals(); }

 private:
  using Key = std::pair<int, int>;
  using Sphere = SphereState<Scalar>;
  using Touching = ContactState<Scalar>;

  static Vector3 from_array(const double a[3]) { return {Scalar(a[0]), Scalar(a[1]), Scalar(a[2])}; }

  static void wrap(Sphere& s) {
    if (Case::ends != Ends::periodic) return;
    if (s.x.z() < 0) s.x.z() += length;
    if (s.x.z() >= length) s.x.z() -= length;
  }

  Vector3 between(int i, int j) const {
    const Vector3 &from = spheres_[i].x, &to = spheres_[j].x;
    return {to.x() - from.x(), to.y() - from.y(), axial_difference<Case>(to.z(), from.z())};
  }

  /// Calls f(i, j, vector from i to j, distance) for every pair closer than a multiple of the sum of its radii.
  template <class F>
  void for_each_pair(Scalar multiple, F f) {
    const auto visit = [&](int i, int j) {
      if (!(spheres_[i].is_present && spheres_[j].is_present)) return;
      const Vector3 r = between(i, j);
      const Scalar reach = multiple * (spheres_[i].own.radius + spheres_[j].own.radius);
      if (std::abs(r.z()) >= reach) return;
      if (const Scalar distance = r.norm(); distance < reach) f(i, j, r, distance);
    };
    if (near_.serve(multiple * 2 * largest)) {
      near_.renew(count(), [this](int i, int j) { return between(i, j).squaredNorm(); });
      for (const auto& [i, j] : near_.pairs()) visit(i, j);
    } else {
      for (int i = 0; i < count(); ++i)
        for (int j = i + 1; j < count(); ++j) visit(i, j);
    }
  }

  Vector3 predicted_velocity(const Sphere& s) const {
    return Case::integrator == Integrator::leapfrog ? Vector3(s.v + s.acceleration * dt / 2) : s.v;
  }

  ContactForce<Scalar> touch(Key key, Scalar overlap, const Vector3& n, const Vector3& relative_velocity,
                             const Vector3& predicted, const Vector3& spin, const Vector3& spin_of_partner) {
    Touching& contact = contacts_[key];
    if (contact.last_step < 0) {
      const int first = kind(key.first), second = key.second < 0 ? key.second : kind(key.second);
      contact.bodies = bodies_of_contact<Case, Scalar>(first, second);
      contact.coefficients = contact_coefficients<Case, Scalar>(first, second);
    }
    const Encounter<Scalar> at{overlap, n, relative_velocity, predicted.dot(n), spin, spin_of_partner, contact.bodies};
    if (Case::integrator == Integrator::impulse) {
      if (step_ == 0) contact.memory.state = -1;
      contact.force = contact_impulse<Case>(contact.coefficients, at, contact.memory);
    } else {
      contact.force = contact_force<Case>(contact.coefficients, at, contact.memory);
    }
    contact.n = n, contact.overlap = overlap, contact.last_step = step_;
    book(contact.force, energy_);
    return contact.force;
  }

  /// With impulses a contact that has opened gets the rest of its last half step.
  bool has_just_opened(Key key) const {
    if (Case::integrator != Integrator::impulse) return false;
    const auto found = contacts_.find(key);
    return found != contacts_.end() && found->second.memory.state > 0;
  }

  void touch_wall(int i, int wall, Scalar overlap, const Vector3& n) {
    if (!(overlap > 0 || has_just_opened({i, wall}))) return;
    Sphere& s = spheres_[i];
    const auto f = touch({i, wall}, overlap, n, s.v, predicted_velocity(s), s.omega, Vector3::Zero());
    s.force += f.normal_force * n + f.tangential_force;
    s.torque += f.torque + f.rolling_torque;
  }

  void contact_forces() {
    for (Sphere& s : spheres_) s.force = s.torque = Vector3::Zero();
    const Scalar reach = Case::integrator == Integrator::impulse ? Scalar(1.1L) : Scalar(1);
    for_each_pair(reach, [this](int i, int j, const Vector3& between, Scalar distance) {
      Sphere &a = spheres_[i], &b = spheres_[j];
      const Scalar overlap = a.own.radius + b.own.radius - distance;
      if (!(overlap > 0 || has_just_opened({i, j}))) return;
      const Vector3 n = between / distance;
      const auto f =
          touch({i, j}, overlap, n, a.v - b.v, predicted_velocity(a) - predicted_velocity(b), a.omega, b.omega);
      const Vector3 force = f.normal_force * n + f.tangential_force;  // eq. (13)
      a.force += force, b.force -= force;
      a.torque += f.torque + f.rolling_torque, b.torque += f.torque_on_partner - f.rolling_torque;  // eqs. (14), (49)
    });
    for (int i = 0; i < count(); ++i) {
      if (!is_present(i)) continue;
      const Vector3 x = spheres_[i].x;
      const Scalar r = spheres_[i].own.radius;
      if (Case::has_wall) {
        const Scalar q = std::sqrt(x.x() * x.x() + x.y() * x.y());
        const Scalar overlap = q - (Scalar(Case::pipe_diameter) / 2 - r);
        if (q > 0) touch_wall(i, pipe_wall, overlap, Vector3(x.x() / q, x.y() / q, 0));
      }
      const bool is_closed = Case::ends == Ends::closed;
      if (is_closed || is_line<Case>) touch_wall(i, lower_end, r - x.z(), Vector3(0, 0, -1));
      if (is_closed) touch_wall(i, upper_end, x.z() - (length - r), Vector3(0, 0, 1));
    }
    std::erase_if(contacts_, [this](const auto& entry) {
      if (entry.second.last_step == step_) return false;
      book_end(entry.second.memory, energy_);
      return true;
    });
  }

  /// A sphere floats when no other centre is within 1.1 (r_i + r_j) and it does not touch the lower half of the wall.
  void tell_floaters() {
    for (Sphere& s : spheres_) s.floats = may_float<Case>(s);
    for_each_pair(Scalar(1.1L),
                  [this](int i, int j, const Vector3&, Scalar) { spheres_[i].floats = spheres_[j].floats = false; });
  }

  void move() {
    const Vector3 g = from_array(Case::gravity);
    Scalar maximum_way = 0;
    for (Sphere& s : spheres_) {
      if (!s.is_present) continue;
      s.acceleration = (s.force + s.gas_force) / s.own.mass + g;  // eq. (1)
      const Vector3 old_v = s.v;
      s.v += s.acceleration * dt;                          // eq. (3)
      s.omega += s.torque / s.own.moment_of_inertia * dt;  // eqs. (2), (5)
      const Vector3 path = s.v * dt;
      s.x += path;  // eq. (4)
      maximum_way = std::max(maximum_way, path.norm());
      wrap(s);
      energy_.gravity_work += static_cast<double>(s.own.mass * g.dot(path));
      energy_.gas_work += static_cast<double>(s.gas_force.dot((old_v + s.v) / 2) * dt);
    }
    near_.move(maximum_way);
  }

  /// Feeding, of a line.
  void let_in() {
    const int before = count();
    line_.feed(step_, spheres_, energy_);
    if (count() > before) near_.forget();
  }

  /// Outlet, of a line: contacts with those that leave are cut, and take what their springs held along.
  void let_out() {
    bool any = false;
    for (Sphere& s : spheres_) any = line_.takes(s, energy_) || any;
    if (!any) return;
    near_.forget();
    std::erase_if(contacts_, [this](const auto& entry) {
      const auto [owner, partner] = entry.first;
      if (is_present(owner) && (partner < 0 || is_present(partner))) return false;
      energy_.left_with += static_cast<double>(entry.second.force.elastic_energy);
      return true;
    });
  }

  void step_once() {
    if constexpr (is_line<Case>) let_in();
    if (Case::has_gas && step_ % Case::gas_floater_interval == 0) tell_floaters();
    if (Case::has_gas && step_ % Case::gas_update_interval == 0) slices_ = update_gas<Case>(spheres_, gas_, step_);
    contact_forces();
    move();
    if constexpr (is_line<Case>) let_out();
    ++step_;
  }

  static inline const Scalar length = Case::pipe_length;

  // Members, because the values of a case may be variables (tools/stability tries one time step after another).
  Scalar dt = Case::time_step;
  Scalar largest = largest_radius<Case, Scalar>();

  std::vector<Sphere> spheres_;
  std::map<Key, Touching> contacts_;
  GasInPipe<Case, Scalar> gas_;
  std::vector<SliceFlow<Scalar>> slices_;
  NearPairs<Scalar> near_;
  Line<Case, Scalar> line_;
  Energy energy_;
  long long step_ = 0;
};

}  // namespace fixdem::reference
