// The laws of pressure loss that a slice takes, each for a gas of its own density and viscosity (Stream,
// gas_arrays.hpp).
//
//   Ergun, eqs. (33)-(35)    G = a w|w| + b w,  a = 1.75 c rho/d_g,  b = 150 c (1 - eps) nu rho/d_g^2,
//                            c = (1 - eps)/eps^3: through a bed, w the velocity past its particles
//   Blasius, eqs. (36), (37) G = c_b y^7, y^4 = U_a, c_b = 0.3164 (nu/D_h)^(1/4) rho/(2 D_h): along a wall
//   Wen & Yu                 F = C_d (pi d^2/8) rho w|w| eps^(-4.65) on each particle, the pressure's share included:
//                            G = F n, n particles per volume
// In the last one w is the superficial slip U - V_s, and Re = |w| d/nu with it, as Wen & Yu have it; C_d is that of a
// single sphere, 24/Re (1 + 0.15 Re^0.687), but not below 0.44. (A switch at Re = 1000 would be a jump of 0.4 %, in
// which Newton's method finds no solution.) `V`: lanes or a number.
#pragma once

#include "gas_arrays.hpp"
#include "special_functions.hpp"

namespace fixdem::detail {

template <class V>
struct Ergun {
  V a, b;
  template <class Diameter, class Gas>
  FIXDEM_INLINE Ergun(V eps, Diameter d_g, const Gas& gas) {
    const V c = (1.0 - eps) / (eps * eps * eps);
    a = c * (1.75 * gas.density / d_g), b = c * (1.0 - eps) * (150 * gas.viscosity * gas.density / (d_g * d_g));
  }
  FIXDEM_INLINE V gradient(V w) const { return a * w * abs(w) + b * w; }
  FIXDEM_INLINE V slope(V w) const { return 2.0 * a * abs(w) + b; }
};

/// c_b of Blasius' law.
template <class V, class Gas>
FIXDEM_INLINE V blasius(V hydraulic_diameter, const Gas& gas) {
  return 0.3164 * sqrt(sqrt(gas.viscosity / hydraulic_diameter)) * gas.density / (2.0 * hydraulic_diameter);
}

/// A function of numbers in every lane.
template <int W, class F>
FIXDEM_INLINE Lanes<W> lane_by_lane(Lanes<W> x, F f) {
  alignas(64) double values[W];
  store(values, x);
  for (double& value : values) value = f(value);
  return load<Lanes<W>>(values);
}

/// The maximum of all lanes; a NaN is kept.
template <int W>
FIXDEM_INLINE double largest_lane(Lanes<W> x) {
  alignas(64) double values[W];
  store(values, x);
  double maximum = 0;
  for (double v : values) maximum = maximum >= v || maximum != maximum ? maximum : v;
  return maximum;
}

/// Wen & Yu's pressure gradient and its slope. `number`: particles per volume.
template <int W>
struct WenYu {
  using V = Lanes<W>;
  V gradient, slope;
  template <class Diameter, class Gas>
  FIXDEM_INLINE WenYu(V w, V eps, V number, Diameter d, const Gas& gas) {
    const V speed = abs(w);
    const V inertia = lane_by_lane<W>(speed * d / gas.viscosity, [](double re) { return 0.15 * power<687, 1000>(re); });
    const V crowding = lane_by_lane<W>(eps, [](double e) { return power<-465, 100>(e); });
    const V viscous = 24.0 * gas.viscosity / d * (1.0 + inertia), blunt = 0.44 * speed;  // C_d |w|
    const V factor = number * crowding * (3.14159265358979323846 / 8 * gas.density * d * d);
    const V viscous_slope = 24.0 * gas.viscosity / d * (1.0 + 1.687 * inertia);
    gradient = factor * max(viscous, blunt) * w;
    slope = factor * select(viscous > blunt, viscous_slope, 2.0 * blunt);
  }
};

}  // namespace fixdem::detail
