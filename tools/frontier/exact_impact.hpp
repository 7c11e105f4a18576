// One impact by an adaptive solver with event location: the truth for the kernel's impacts.
//
// A sphere meets a flat wall or, head on, an equal one. Unknowns: overlap x, its rate v, history h (tangential
// displacement, or spring force in the incremental forms), tangential velocity w of the centre, surface velocity y
// of the rotation, and the history of rolling; slip u = w + y. With R = K x^p + eta v (repulsion, eqs. 6, 18), c = k_t
// or 1, and B = mu |R| / c:
//
//   sticking   h' = u  |  k_t u  |  k_t u + h k_t'/k_t while k_t falls (`rescale`)         while |h| <= B
//   sliding    h  = +-B                                                       while that growth would exceed B'
//   f_t = -(c h + eta u), capped at mu |R|;  v' = -R/M,  w' = f_t/m,  y' = 5/2 (f_t + q)/m
//
// and rolling, q, is the same once more with y for u and mu_r K x^p for mu |R| (a head-on pair does not turn).
//
// This is the limit for vanishing steps of eqs. (6)-(12) with slider "clip". Runge-Kutta-Fehlberg 7(8) of Boost.Odeint
// in long double with step-size control; a step in which any regime changes (end of contact, stick and slip, cap of the
// total force, sign of R) is cut there by bisection, so no step straddles a kink. Scaled to the maximum overlap of an
// undamped impact and to the impact speed, so the tolerance is relative to those. Coefficients are those of the
// tests' reference, not of the kernel.
#pragma once

#include <algorithm>
#include <array>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <cmath>
#include <stdexcept>

#include "tests/reference/contact_reference.hpp"

namespace fixdem::frontier {

struct Outcome {
  long double normal, tangential;  ///< velocities after the impact, m/s; the normal one away from the partner
  long double surface_spin;        ///< radius times angular velocity, m/s, positive where it adds to the slip
  long double contact_time, maximum_overlap;
};

class ExactImpact {
  using Scalar = long double;
  /// Overlap, its rate, history, tangential velocity, surface velocity of the spin, history of rolling.
  using State = std::array<Scalar, 6>;

 public:
  /// `mass`: that of a sphere; `effective_mass`: M of the normal motion.
  ExactImpact(const reference::Coefficients<Scalar>& c, bool is_hertz, TangentialLaw law, FrictionLimit limit,
              Scalar mass, Scalar effective_mass, Scalar tolerance)
      : law_(law),
        limit_(limit),
        hertz_(is_hertz),
        mu_{c.friction, c.rolling_friction},
        mass_(mass),
        effective_(effective_mass),
        tolerance_(tolerance) {
    unscaled_ = c;
  }

  /// `surface_spin`: radius times the angular velocity before the impact.
  Outcome solve(Scalar normal_speed, Scalar tangential_speed, Scalar surface_spin = 0) {
    scale(normal_speed);
    State x{0, 1, 0, tangential_speed / normal_speed, surface_spin / normal_speed, 0};
    sliding_ = {};
    peak_ = 0;
    Scalar time = 0, step = 1e-12L;
    // make_controlled copies the scratch space of a stepper, too. One of static storage has some; g++ 14 warns of
    // others.
    static const Fehlberg fresh;
    auto stepper = boost::numeric::odeint::make_controlled(tolerance_, tolerance_, fresh);
    const auto rhs = [this](const State& s, State& d, Scalar) { derivative(s, d); };
    for (long long taken = 0;; ++taken) {
      if (taken > 10'000'000) throw std::runtime_error("the exact impact does not end");
      const State before = x;
      const Scalar begin = time;
      regime_ = regime(x);
      if (x[0] > 0)
        step = std::min(step, x[0] / (2 * std::abs(x[1]) + x[0]));  // overlap^(1/4) is not smooth at its ends
      while (stepper.try_step(rhs, x, time, step) == boost::numeric::odeint::fail) {
      }
      step = std::min(step, maximum_step);
      if (!changes(before, x)) {
        settle(x);
        note_peak(before, x, time - begin);
        continue;
      }
      // The earliest change: bisection for the length of the step, to neighbouring numbers.
      Scalar low = 0, high = time - begin;
      for (int i = 0; i < 200; ++i) {
        const Scalar middle = low + (high - low) / 2;
        if (middle <= low || middle >= high) break;
        (changes(before, advanced(before, middle)) ? high : low) = middle;
      }
      x = advanced(before, high);
      time = begin + high;
      if (x[1] < 0 && x[0] <= opened) break;  // a spring with an elastic limit may slide from the first touch on
      settle(x);
      note_peak(before, x, high);
      change_regime(x);
      step = std::max(high * Scalar(1e-3L), Scalar(1e-15L));
    }
    return {-x[1] * speed_, x[3] * speed_, x[4] * speed_, time * length_ / speed_, peak_ * length_};
  }

 private:
  static constexpr Scalar maximum_step = 0.02L;
  static constexpr Scalar opened = 1e-15L;  ///< an overlap that counts as none, in largest ones

  using Fehlberg = boost::numeric::odeint::runge_kutta_fehlberg78<State, Scalar>;

  /// Length: maximum overlap without damping; mass: the sphere's.
  void scale(Scalar speed) {
    speed_ = speed;
    const Scalar K = unscaled_.normal_stiffness, energy = effective_ * speed * speed / 2;
    length_ = hertz_ ? std::pow(energy * 5 / (2 * K), Scalar(0.4L)) : std::sqrt(2 * energy / K);
    const Scalar unit = length_ / (speed * speed) / mass_;  // acceleration by a force of 1 N
    const Scalar root = hertz_ ? std::sqrt(length_) : 1;
    scaled_.normal_stiffness = K * length_ * root * unit;
    scaled_.tangential_stiffness = unscaled_.tangential_stiffness * root * length_ * unit;
    scaled_.normal_damping = unscaled_.normal_damping * std::sqrt(root) * speed * unit;
    scaled_.tangential_damping = unscaled_.tangential_damping * std::sqrt(root) * speed * unit;
  }

  /// The two springs that stick or slide: that of sliding, and that of rolling.
  enum Spring : std::size_t { of_slip, of_rolling };
  static constexpr Spring springs[] = {of_slip, of_rolling};
  static constexpr std::size_t history_at[] = {2, 5};  ///< place in the State

  struct Forces {
    Scalar repulsion, stiffness, damping;  ///< R, k_t, eta_t
    Scalar cap[2];                         ///< mu |R| or mu times the elastic part of R; mu_r times the elastic part
    Scalar cap_rate[2], stiffness_rate;
  };

  Forces forces(const State& s) const {
    const Scalar x = std::max(s[0], Scalar(0)), v = s[1], root = hertz_ ? std::sqrt(x) : 1, fourth = std::sqrt(root);
    Forces f{};
    f.damping = scaled_.tangential_damping * fourth;
    const Scalar eta = scaled_.normal_damping * fourth;
    f.repulsion = scaled_.normal_stiffness * x * root + eta * v;
    f.stiffness = scaled_.tangential_stiffness * root;
    const Scalar acceleration = -f.repulsion * mass_ / effective_;
    const Scalar elastic_rate = scaled_.normal_stiffness * root * v * (hertz_ ? Scalar(1.5L) : 1);
    Scalar repulsion_rate = elastic_rate + eta * acceleration;
    if (hertz_ && x > 0) {
      repulsion_rate += eta * v * v / (4 * x);
      f.stiffness_rate = f.stiffness * v / (2 * x);
    }
    for (const Spring k : springs)
      f.cap[k] = mu_[k] * scaled_.normal_stiffness * x * root, f.cap_rate[k] = mu_[k] * elastic_rate;
    if (limit_ == FrictionLimit::total) {
      f.cap[of_slip] = mu_[of_slip] * std::abs(f.repulsion);
      f.cap_rate[of_slip] = mu_[of_slip] * (f.repulsion < 0 ? -repulsion_rate : repulsion_rate);
    }
    return f;
  }
  bool keeps_displacement() const { return law_ == TangentialLaw::displacement; }
  Scalar to_force(const Forces& f) const { return keeps_displacement() ? f.stiffness : 1; }
  Scalar bound(const Forces& f, Spring k) const { return f.cap[k] / std::max(to_force(f), Scalar(1e-300L)); }
  Scalar bound_rate(const Forces& f, Spring k) const {
    const Scalar c = to_force(f);
    return keeps_displacement() ? f.cap_rate[k] / c - f.cap[k] * f.stiffness_rate / (c * c) : f.cap_rate[k];
  }
  /// Slip, or what rolls.
  static Scalar rate(const State& s, Spring k) { return k == of_slip ? s[3] + s[4] : s[4]; }
  Scalar growth(const Forces& f, const State& s, Spring k, Scalar h) const {
    const Scalar u = rate(s, k);
    if (keeps_displacement()) return u;
    const bool shrinks = law_ == TangentialLaw::rescale && f.stiffness_rate < 0;
    return f.stiffness * u + (shrinks ? h * f.stiffness_rate / f.stiffness : 0);
  }
  Scalar history(const Forces& f, const State& s, Spring k) const {
    return sliding_[k] == 0 ? s[history_at[k]] : sliding_[k] * bound(f, k);
  }
  /// The force of a spring with its damper before it is capped, with the other sign.
  Scalar trial(const Forces& f, const State& s, Spring k) const {
    return to_force(f) * history(f, s, k) + f.damping * rate(s, k);
  }

  void derivative(const State& s, State& d) const {
    const Forces f = forces(s);
    Scalar pull[2];
    d[1] = -f.repulsion * mass_ / effective_;
    for (const Spring k : springs) {
      pull[k] = -std::clamp(trial(f, s, k), -f.cap[k], f.cap[k]);
      d[history_at[k]] = sliding_[k] == 0 ? growth(f, s, k, history(f, s, k)) : 0;
    }
    d[0] = s[1], d[3] = pull[of_slip], d[4] = (pull[of_slip] + pull[of_rolling]) * 5 / 2;
  }

  /// Which branch each choice of the law takes.
  struct Regime {
    int slip_cap, rolling_cap;
    bool repels, shrinks;
    bool operator==(const Regime&) const = default;
  };
  Regime regime(const State& s) const {
    const Forces f = forces(s);
    const auto cap = [&](Spring k) { return trial(f, s, k) > f.cap[k] ? 1 : trial(f, s, k) < -f.cap[k] ? -1 : 0; };
    return {cap(of_slip), mu_[of_rolling] > 0 ? cap(of_rolling) : 0, f.repulsion >= 0, s[1] < 0};
  }
  bool leaves_mode(const State& s, Spring k) const {
    if (mu_[k] == 0) return false;
    const Forces f = forces(s);
    if (sliding_[k] == 0) return std::abs(s[history_at[k]]) > bound(f, k) * (1 + Scalar(1e-17L));
    return sliding_[k] * growth(f, s, k, sliding_[k] * bound(f, k)) < bound_rate(f, k);
  }
  bool changes(const State& before, const State& after) const {
    if (after[1] < 0 && after[0] <= opened) return true;
    return !(regime(after) == (before[0] > 0 ? regime_ : regime(after))) || leaves_mode(after, of_slip) ||
           leaves_mode(after, of_rolling);
  }
  void change_regime(const State& s) {
    for (const Spring k : springs)
      if (leaves_mode(s, k)) sliding_[k] = sliding_[k] != 0 ? 0 : (s[history_at[k]] > 0 ? 1 : -1);
  }
  /// While sliding, the history is not integrated but follows the cap.
  void settle(State& s) const {
    for (const Spring k : springs) {
      if (mu_[k] == 0) s[history_at[k]] = 0;
      if (sliding_[k] != 0) s[history_at[k]] = sliding_[k] * bound(forces(s), k);
    }
  }

  State advanced(const State& from, Scalar step) const {
    State x = from;
    Fehlberg stepper;
    stepper.do_step([this](const State& s, State& d, Scalar) { derivative(s, d); }, x, Scalar(0), step);
    return x;
  }

  /// Where the rate changes sign, the top of the overlap, by bisection for the rate.
  void note_peak(const State& before, const State& after, Scalar step) {
    peak_ = std::max(peak_, after[0]);
    if (!(before[1] > 0 && after[1] <= 0)) return;
    Scalar low = 0, high = step;
    for (int i = 0; i < 100; ++i) {
      const Scalar middle = low + (high - low) / 2;
      (advanced(before, middle)[1] > 0 ? low : high) = middle;
    }
    peak_ = std::max(peak_, advanced(before, high)[0]);
  }

  reference::Coefficients<Scalar> unscaled_, scaled_{};
  TangentialLaw law_;
  FrictionLimit limit_;
  bool hertz_;
  Scalar mu_[2], mass_, effective_, tolerance_;
  Scalar speed_ = 1, length_ = 1, peak_ = 0;
  std::array<int, 2> sliding_{};  ///< 0: sticks; else the sign of the history
  Regime regime_{};
};

}  // namespace fixdem::frontier
