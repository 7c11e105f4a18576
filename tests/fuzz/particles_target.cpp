// Particles in any state: the widest lanes, one lane and the reference program, step by step.
//
// Lanes must agree in every byte and in what stops them; the reference within rounding, as long as nothing has stopped.
// The state is read off the bytes from a palette of what is known to hurt: coincident centres, denormal distances and
// speeds, spheres that just touch or just do not, overlaps beyond a radius, places outside the pipe, infinities, and
// what is no number. Near lists hold so few neighbours that crowds overflow them.
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <memory>

#include "cases/plug_u24.hpp"
#include "kernel/fixdem.hpp"
#include "targets.hpp"
#include "tests/reference/reference.hpp"

namespace fixdem::tests {
namespace {

struct crowd : cases::plug_u24 {
  static constexpr int particle_count = 12;
  static constexpr double pipe_length = 0.08;
  static constexpr int slice_count = 8;
  static constexpr int neighbour_capacity = 6;
};

/// Bytes one by one, zeros when there are no more.
class Bytes {
 public:
  explicit Bytes(std::string_view rest) : rest_(rest) {}
  unsigned next() {
    if (rest_.empty()) return 0;
    const auto byte = static_cast<unsigned char>(rest_.front());
    rest_.remove_prefix(1);
    return byte;
  }
  /// -1 .. 1
  double fraction() { return (static_cast<double>(next()) - 127.5) / 127.5; }

 private:
  std::string_view rest_;
};

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double denormal = std::numeric_limits<double>::denorm_min();

double any_speed(Bytes& bytes) {
  constexpr double palette[] = {0, denormal, 1e-300, 1e-9, 1e-3, 0.1, 1, 10, 100, 1e4, 1e300, infinity, NAN};
  const unsigned which = bytes.next();
  constexpr unsigned size = sizeof palette / sizeof palette[0];
  // Mostly speeds that a run survives for a while.
  const double size_of = palette[which < 128 ? which % 8 : which % size];
  return size_of * (which % 2 == 0 ? 1 : -1) * (bytes.next() % 16 == 0 ? 1.0 : std::abs(bytes.fraction()));
}

void any_position(Bytes& bytes, const Particle* before, Particle& p) {
  const double d = crowd::diameter, room = (crowd::pipe_diameter - d) / 2;
  for (double& x : p.position) x = bytes.fraction() * room * 0.7;
  p.position[2] = (bytes.fraction() + 1) / 2 * crowd::pipe_length * (1 - 1e-12);
  const unsigned how = bytes.next();
  const double* at = before != nullptr ? before->position : p.position;
  const int axis = static_cast<int>(how / 16 % 3);
  const auto beside = [&](double distance) {
    for (int c = 0; c < 3; ++c) p.position[c] = at[c];
    p.position[axis] += distance;
  };
  switch (how % 16) {
    case 0:
      return beside(0);  // coincident centres
    case 1:
      return beside(denormal);
    case 2:
      return beside(d * (1 - 1e-15));  // the least overlap
    case 3:
      return beside(d);
    case 4:
      return beside(d * (1 - std::abs(bytes.fraction())));  // any overlap
    case 5:
      return beside(-d * (1 - 0.02 * std::abs(bytes.fraction())));
    case 6:
      p.position[axis] = NAN;
      return;
    case 7:
      p.position[axis] = bytes.next() % 2 != 0 ? infinity : 1e300;
      return;
    case 8:
      p.position[0] = room * (1 + 1e-3 * bytes.fraction()), p.position[1] = 0;
      return;  // touches the wall
    case 9:
      p.position[2] = crowd::pipe_length * bytes.fraction() * 2;
      return;  // perhaps outside
    default:
      return;  // anywhere
  }
}

bool same(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0 || (std::isnan(a) && std::isnan(b)); }

bool same(const Particle& a, const Particle& b) {
  bool all = true;
  for (int c = 0; c < 3; ++c)
    all = all && same(a.position[c], b.position[c]) && same(a.velocity[c], b.velocity[c]) &&
          same(a.angular_velocity[c], b.angular_velocity[c]);
  return all;
}

bool same(const Status& a, const Status& b) {
  return a.fault == b.fault && a.step == b.step && a.particle == b.particle && same(a.value, b.value) &&
         same(a.limit, b.limit);
}

/// Maximum difference of two places, in diameters, and never less than one that is no number.
template <class A, class B>
double difference(const A& a, const B& b) {
  double maximum = 0;
  for (int id = 0; id < crowd::particle_count; ++id)
    for (int c = 0; c < 3; ++c) {
      double dx = a.particle(id).position[c] - b.particle(id).position[c];
      if (c == 2) dx -= crowd::pipe_length * std::round(dx / crowd::pipe_length);
      if (!(std::abs(dx) <= maximum)) maximum = std::abs(dx);
    }
  return maximum / crowd::diameter;
}

}  // namespace

std::string fuzz_particles(std::string_view input) {
  static const auto wide = std::make_unique<Simulation<crowd>>();
  static const auto narrow = std::make_unique<Simulation<crowd, 1>>();
  reference::Reference<crowd> reference;

  Bytes bytes(input);
  const int steps = 1 + static_cast<int>(bytes.next() % 64);
  Particle placed[crowd::particle_count];
  for (int id = 0; id < crowd::particle_count; ++id) {
    Particle& p = placed[id];
    p = {};
    any_position(bytes, id > 0 ? &placed[id - 1] : nullptr, p);
    for (double& v : p.velocity) v = any_speed(bytes);
    for (double& v : p.angular_velocity) v = 100 * any_speed(bytes);
    wide->place(id, p);
    narrow->place(id, p);
  }
  Status a = wide->start(), b = narrow->start();
  // The reference wants places inside the periodic pipe, where the kernel has put them.
  for (int id = 0; id < crowd::particle_count; ++id) {
    const Particle p = wide->particle(id);
    reference.place(id, {{p.position[0], p.position[1], p.position[2]},
                         {p.velocity[0], p.velocity[1], p.velocity[2]},
                         {p.angular_velocity[0], p.angular_velocity[1], p.angular_velocity[2]}});
  }
  if (a.ok()) reference.start();
  for (int step = 0;; ++step) {
    const std::string when = " at step " + std::to_string(step);
    if (!same(a, b))
      return std::string("lanes stop otherwise than one lane") + when + ": " + describe(a.fault) + " and " +
             describe(b.fault);
    for (int id = 0; id < crowd::particle_count; ++id)
      if (!same(wide->particle(id), narrow->particle(id)))
        return "lanes differ from one lane" + when + " in particle " + std::to_string(id);
    if (a.ok())
      for (int id = 0; id < crowd::particle_count; ++id)
        for (const double x : wide->particle(id).position)
          if (!std::isfinite(x)) return "no fault, and a place that is not finite" + when;
    if (a.ok() && step > 0) {
      reference.run(1);
      // A rounding error grows e-fold in a contact's time, some ten steps of deep overlaps.
      if (const double d = difference(*wide, reference); !(d < 1e-9)) {
        char text[32];
        std::snprintf(text, sizeof text, "%.2e", d);
        return "the reference is " + std::string(text) + " diameters away" + when;
      }
    }
    if (!a.ok() || step == steps) return "";
    a = wide->run(1), b = narrow->run(1);
  }
}

}  // namespace fixdem::tests
