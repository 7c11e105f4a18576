// The gas of the slice model in its textbook form: bed geometry, eqs. (33)-(38) by bisection, drag on a lone sphere.
//
// The pipe is cut into equal slices. In each, the bed fills a circular segment of the cross section and the rest is
// free; the gas divides itself so that the pressure gradient through the bed (Ergun, eqs. 33-35) equals the one above
// it (Blasius, eqs. 36, 37) and the two flows add up to the given one (eq. 38). Written independently of the kernel,
// with the standard library's acos and pow; the whole flow grows with the velocity above the bed, so bisection for that
// velocity, to the last bit, finds the division whatever the state. SI units, z along the pipe; the gradient is
// positive when it pushes towards +z.
//
// Spheres of several sizes, k for each in the bed of a slice:
//   (46)   eps = 1 - sum V_k/(A_d dz), V_s = sum V_k v_k/sum V_k, d_32 = sum d_k^3/sum d_k^2
//   (32')  F_k = G dz A_d (V_k/sum V) (eps d_32/d_k + 1 - eps)
// and d_32 is the d of the rule for a full slice, and d_g where none is given. Sums are in units of the largest sphere,
// so that with equal ones they are numbers of particles. A steep pipe: gas_steep_reference.hpp; gas that changes along
// the pipe and in time: gas_pressure_reference.hpp.
#pragma once

#include <algorithm>
#include <cmath>

#include "contact_reference.hpp"

namespace fixdem::reference {

/// What the flow in a slice depends on.
template <class Scalar>
struct SliceBed {
  Scalar count = 0;     ///< volume of its bed particles over that of the largest sphere; of equal ones, their number
  Scalar velocity = 0;  ///< V_s, their mean axial velocity
  Scalar top = 0;       ///< h, height of the highest top of a bed particle above the bottom of the pipe
  Scalar sauter_diameter = 1;  ///< d_32 over the largest diameter
};

/// Sums of eq. (46) over the bed particles of a slice; diameters over the largest one.
template <class Scalar>
struct BedSums {
  Scalar volume = 0, surface = 0, velocity = 0, top = 0;

  void add(Scalar diameter, Scalar axial_velocity, Scalar top_of_particle) {
    const Scalar cube = diameter * diameter * diameter;
    volume += cube;
    surface += diameter * diameter;
    velocity += cube * axial_velocity;
    top = std::max(top, top_of_particle);
  }
  SliceBed<Scalar> bed() const {
    if (volume == 0) return {};
    return {volume, velocity / volume, top, volume / surface};
  }
};

/// The gas that comes to a slice: bulk velocity, density, kinematic viscosity.
template <class Scalar>
struct Gas {
  Scalar velocity, density, viscosity;
};
template <class Case, class Scalar>
Gas<Scalar> gas_of_case() {
  return {Case::gas_velocity, Case::gas_density, Case::gas_viscosity};
}

template <class Scalar>
struct SliceFlow {
  Gas<Scalar> gas{};
  Scalar pressure_gradient = 0;
  Scalar bed_area = 0;         ///< A_d
  Scalar void_fraction = 1;    ///< eps
  Scalar velocity_above = 0;   ///< U_a
  Scalar velocity_in_bed = 0;  ///< U_d, superficial
  Scalar mean_force = 0;       ///< along z, per volume of the largest sphere: eq. (32) for equal ones
  Scalar sauter_diameter = 1;  ///< d_32 over the largest diameter
  bool full = false;
};

/// Eq. (32'), along z, on a bed particle of a diameter over the largest one.
template <class Scalar>
Scalar force_in_bed(const SliceFlow<Scalar>& flow, Scalar diameter) {
  const Scalar eps = flow.void_fraction, share = eps * (flow.sauter_diameter / diameter) + (1 - eps);
  return flow.mean_force * (diameter * diameter * diameter) * share;
}

/// Height at which the bed counts: a slice is full when no further particle, of diameter d, fits above it. A case may
/// say another gap instead of d.
template <class Case, class Scalar>
Scalar effective_height(Scalar h, Scalar d) {
  const Scalar D = Case::pipe_diameter;
  if constexpr (requires { Case::gas_full_gap; }) d = Case::gas_full_gap;
  h = std::min(h, D);
  if (Case::gas_bed_height == BedHeight::strict) return h;
  if (Case::gas_bed_height == BedHeight::hard) return D - h < d ? D : h;
  return std::min(D, h + d * std::clamp((h - (D - 2 * d)) / d, Scalar(0), Scalar(1)));
}

/// Blasius, eqs. (36) and (37), for a velocity of either sign.
template <class Scalar>
Scalar free_gradient(Scalar U, Scalar D_h, const Gas<Scalar>& gas) {
  if (U == 0) return 0;
  const Scalar Re = std::abs(U) * D_h / gas.viscosity;
  const Scalar lambda = Scalar(0.3164L) * std::pow(Re, Scalar(-0.25L));
  return lambda / D_h * gas.density * U * std::abs(U) / 2;
}

/// Ergun, eqs. (33)-(35), multiplied out so that w = 0 is no division by zero; w = U_d - V_s.
template <class Scalar>
Scalar bed_gradient(Scalar w, Scalar eps, Scalar d_g, const Gas<Scalar>& gas) {
  const Scalar rho = gas.density, nu = gas.viscosity;
  const Scalar c = (1 - eps) / (eps * eps * eps);
  return c * (150 * (1 - eps) * nu * rho / (d_g * d_g) * w + Scalar(1.75L) * rho / d_g * w * std::abs(w));
}

/// The velocity w >= 0 through the bed at a gradient >= 0: the root of the quadratic above, without cancellation.
template <class Scalar>
Scalar bed_velocity(Scalar gradient, Scalar eps, Scalar d_g, const Gas<Scalar>& gas) {
  const Scalar rho = gas.density, nu = gas.viscosity;
  const Scalar c = (1 - eps) / (eps * eps * eps);
  const Scalar a = c * Scalar(1.75L) * rho / d_g, b = c * 150 * (1 - eps) * nu * rho / (d_g * d_g);
  return 2 * gradient / (b + std::sqrt(b * b + 4 * a * gradient));
}

/// The x in [0, upper] at which the increasing function f reaches `value`, to neighbouring numbers.
template <class Scalar, class Function>
Scalar bisection(Scalar upper, Scalar value, Function f) {
  Scalar low = 0, high = upper;
  for (int i = 0; i < 20000; ++i) {
    const Scalar middle = low + (high - low) / 2;
    if (middle <= low || middle >= high) break;
    (f(middle) < value ? low : high) = middle;
  }
  return high;
}

/// Of a pipe in which a bed can lie.
template <class Case, class Scalar>
SliceFlow<Scalar> slice_flow(const SliceBed<Scalar>& bed, const Gas<Scalar>& gas = gas_of_case<Case, Scalar>()) {
  const Scalar pi = std::acos(Scalar(-1));
  const Scalar D = Case::pipe_diameter, R = D / 2, d = 2 * largest_radius<Case, Scalar>(), U = gas.velocity;
  const Scalar dz = Scalar(Case::pipe_length) / Case::slice_count, A = pi * R * R, V_p = pi * d * d * d / 6;
  const Scalar d_32 = bed.sauter_diameter * d;
  const Scalar d_g = Case::gas_bed_diameter > 0 ? Scalar(Case::gas_bed_diameter) : d_32;
  const Scalar least_void_fraction = lists_sizes<Case> ? Scalar(0.20L) : Scalar(0.35L);  // mixtures pack closer

  SliceFlow<Scalar> flow;
  flow.gas = gas;
  if (bed.count == 0) {
    flow.velocity_above = U;
    flow.pressure_gradient = free_gradient(U, D, gas);
    return flow;
  }
  const Scalar h = effective_height<Case>(bed.top, d_32);
  flow.full = D - h < Scalar(1e-6L) * D;
  const Scalar half_angle = std::acos((R - h) / R), half_chord = std::sqrt(std::max(Scalar(0), 2 * R * h - h * h));
  flow.bed_area = flow.full ? A : R * R * half_angle - (R - h) * half_chord;
  flow.void_fraction = std::clamp(1 - bed.count * V_p / (flow.bed_area * dz), least_void_fraction, Scalar(0.95L));

  if (flow.full) {
    flow.velocity_in_bed = U;
    flow.velocity_above = U;
    flow.pressure_gradient = bed_gradient(U - bed.velocity, flow.void_fraction, d_g, gas);
  } else {
    const Scalar A_d = flow.bed_area, A_a = A - A_d;
    const Scalar D_h = 4 * A_a / (2 * R * (pi - half_angle) + 2 * half_chord);
    const Scalar excess = A * U - A_d * bed.velocity;  // flow relative to a pipe whose bed rests
    const Scalar sign = excess < 0 ? -1 : 1;
    const auto through = [&](Scalar u) {
      return bed_velocity(free_gradient(u, D_h, gas), flow.void_fraction, d_g, gas);
    };
    const Scalar above =
        bisection(std::abs(excess) / A_a, std::abs(excess), [&](Scalar u) { return A_a * u + A_d * through(u); });
    flow.pressure_gradient = sign * free_gradient(above, D_h, gas);
    flow.velocity_above = sign * above;
    flow.velocity_in_bed = sign * through(above) + bed.velocity;
  }
  flow.mean_force = flow.pressure_gradient * dz * flow.bed_area / bed.count;
  flow.sauter_diameter = bed.sauter_diameter;
  return flow;
}

/// Drag on a sphere that floats in gas of velocity u relative to it: on particle `id`, or where all are equal, on any.
template <class Case, class Scalar>
Vector<Scalar> lone_sphere_drag(const Vector<Scalar>& u, int id = 0,
                                const Gas<Scalar>& gas = gas_of_case<Case, Scalar>()) {
  const Scalar pi = std::acos(Scalar(-1)), d = 2 * sphere_properties<Case, Scalar>(id).radius, speed = u.norm();
  if (speed == 0) return Vector<Scalar>::Zero();
  const Scalar Re = speed * d / gas.viscosity;
  const Scalar C_d = Re < 1000 ? 24 / Re * (1 + Scalar(0.15L) * std::pow(Re, Scalar(0.687L))) : Scalar(0.44L);
  return C_d * pi * d * d / 8 * gas.density * speed * u;
}

}  // namespace fixdem::reference
