// The exact return of Coulomb's slider: how a tangential spring moves during one step in which it slides.
//
// The spring h grows with the slip and is never longer than the limit L = mu |f_n| / k_t. A cap along the trial vector
// (`clip`) is a step of backward Euler for the direction of h, of first order however good the integrator. Here the
// motion is solved. Over the step, slip D (constant velocity), L linear from L_0 to L_1, s from 0 to 1:
//
//   inside   h = h_0 + s D until, at s_1, |h| = L. |h_0 + s D| - L(s) is convex and not positive at 0, so there is one
//            such place if the trial h_0 + D is longer than L_1, and none otherwise.
//   sliding  h keeps the length L, and what D adds beyond it is lost. The angle theta between h and D then obeys
//            L dtheta/ds = -|D| sin(theta), whatever L does, so that
//            tan(theta_1/2) = tan(theta(s_1)/2) exp(-x),  x = |D| (1 - s_1) / (mean of L(s_1) and L_1).
//
// With E = exp(-x), C = h(s_1).D, A = L(s_1) |D| + C and B = E^2 (L(s_1) |D| - C) the half angles drop out, and all
// inverse lengths but one:
//   h = L_1 ((A - B - 2 E C) D + 2 E |D|^2 h(s_1)) / (|D| (A + B)).
// Roots and quotients are what this costs. Most contacts that slide did so in the step before, where s_1 = 0 unless the
// slip has turned back; the root of the place is left out where all do: a moving bed takes 16.3 ns per particle and
// step instead of 18.4 (`impulse`, Zen 5 with AVX-512), and 13.4 with `clip`. Lengths are in units of the history,
// metres or scaled force.
#pragma once

#include "exponential.hpp"

namespace fixdem {

/// The spring after the step, of length `limit`.
template <class V>
struct SlidSpring {
  Vec3<V> spring;
  V limit;
};

/// Where kept + path is longer than the limit (`slides`). `kept`: the spring before; `path`: growth by the slip of the
/// step; `last_limit`: the limit before, which `stays_on_limit` means that `kept` still has, or zero where it is not
/// known because the spring did not slide: then it was as now, or the spring's own length where that is more;
/// `friction`, `stiffness`: the limit is their quotient. In lanes that do not slide the result is any number.
template <bool stays_on_limit, class V, class Mask>
FIXDEM_INLINE SlidSpring<V> exact_return(const Vec3<V>& kept, const Vec3<V>& path, V last_limit, V friction,
                                         V stiffness, Mask slides) {
  // Products of several lengths are formed: in units of 2^-30 m floats hold them, too.
  constexpr double unit = 0x1p30;
  constexpr bool is_double = sizeof(Element<V>) == sizeof(double);
  const V least = splat<V>(least_square<V>), least_path = splat<V>(is_double ? 0x1p-200 : 0x1p-30);
  const V one = splat<V>(1), two = splat<V>(2);
  const Vec3<V> h = scale(splat<V>(unit), kept), D = scale(splat<V>(unit), path);
  const V path_square = dot(D, D), path_length = max(sqrt(path_square), least_path);
  const V last = constant<V>(unit) * last_limit, force = constant<V>(unit) * friction, along = dot(h, D);

  // Whoever slid in the last step begins on the limit, and goes on sliding at once unless the spring turns inwards.
  const Mask slid = last > V{}, began = last <= V{};
  V start{}, at_start = last;
  Vec3<V> h_start = h;
  Mask enters = slides;
  if constexpr (stays_on_limit)
    enters = slides & (began | (stiffness * along < last * fused_minus(stiffness, last, force)));
  if (any(enters)) {
    // |h + s D|^2 = (first + s growth)^2: a s^2 + 2 b s + c = 0, the root at which the spring comes out.
    const V square = dot(h, h), limit = force / max(stiffness, least);
    V first = max(select(slid, last, limit), sqrt(square));
    if constexpr (stays_on_limit) first = select(slid, last, first);
    const V growth = limit - first, a = fused_minus(growth, growth, path_square), b = fused_minus(first, growth, along);
    V c = fused_minus(first, first, square);
    if constexpr (stays_on_limit) c = where(began, c);
    const V root = sqrt(max(fused_minus(a, c, b * b), V{}));
    const Mask outwards = b > V{};
    const V s = max(select(outwards, -c, root - b) / max(select(outwards, b + root, a), least), V{});
    start = where(enters, s < one ? s : one);
    at_start = select(enters, fused(start, growth, first), at_start);
    h_start = add_scaled(h, start, D);
  }

  const V E = falling_exponential(two * path_length * (one - start) * stiffness /
                                  max(fused(at_start, stiffness, force), least));
  const V C = dot(h_start, D), lengths = at_start * path_length;
  const V A = lengths + C, B = E * E * max(lengths - C, V{});
  const V whole = path_length * (A + B);
  const V scale_to = friction / max(whole * stiffness, least);
  const V along_path = scale_to * (A - B - two * E * C);
  return {add_scaled(scale(along_path, D), scale_to * two * E * path_length * path_length, h_start), scale_to * whole};
}

}  // namespace fixdem
