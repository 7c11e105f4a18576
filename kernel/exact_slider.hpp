// The exact return of Coulomb's slider: how a tangential spring moves during one step in which it slides.
//
// The spring h grows with the slip and is never longer than the limit L = mu |f_n| / k_t. A cap along the trial vector
// (`clip`) is a step of backward Euler for the direction of h, of first order however good the integrator. Here the
// motion is solved. Over the step, slip D (constant velocity), L linear from L_0 to L_1, s from 0 to 1:
//
//   inside   h = h_0 + s D until, at s_1, |h| = L. |h_0 + s D| - L(s) is convex and not positive at 0, so there is one
//   such
//            place if the trial h_0 + D is longer than L_1, and none otherwise.
//   sliding  h keeps the length L, and what D adds beyond it is lost. The angle theta between h and D then obeys
//            L dtheta/ds = -|D| sin(theta), whatever L does, so that
//            tan(theta_1/2) = tan(theta(s_1)/2) exp(-x),  x = |D| (1 - s_1) / (mean of L(s_1) and L_1).
//
// With c = cos(theta(s_1)), E = exp(-x) and unit vectors e along D, g along h(s_1), the half angles drop out:
//   h = L_1 ((1 + c - E^2 (1 - c) - 2 E c) e + 2 E g) / (1 + c + E^2 (1 - c)).
// Lengths are in units of the history, metres or scaled force.
#pragma once

#include "exponential.hpp"

namespace fixdem {

/// The spring after the step, of length `limit`, where kept + way is longer than that. `kept`: the spring before;
/// `way`: growth by the slip of the step; `last_limit`: the limit before, or zero where it is not known because the
/// spring did not slide: then it was as now, or the spring's own length where that is more.
template <class V>
FIXDEM_INLINE Vec3<V> exact_return(const Vec3<V>& kept, const Vec3<V>& way, V last_limit, V limit) {
  const V least = splat<V>(sizeof(Element<V>) == sizeof(double) ? 0x1p-500 : 0x1p-60);
  const V one = splat<V>(1), square = dot(kept, kept), way_square = dot(way, way);
  const V first = max(select(last_limit > V{}, last_limit, limit), sqrt(square)), growth = limit - first;

  // |kept + s way|^2 = (first + s growth)^2: a s^2 + 2 b s + c = 0, the root at which the spring comes out.
  const V a = way_square - growth * growth, b = fused_minus(first, growth, dot(kept, way));
  const V c = fused_minus(first, first, square);
  const V root = sqrt(max(fused_minus(a, c, b * b), V{}));
  const auto outwards = b > V{};
  const V s = max(select(outwards, -c, root - b) / max(select(outwards, b + root, a), least * least), V{});
  const V start = s < one ? s : one;

  const Vec3<V> at_limit = add_scaled(kept, start, way);
  const V way_length = sqrt(way_square), inverse_way = one / max(way_length, least);
  const V inverse_length = one / max(sqrt(dot(at_limit, at_limit)), least);
  const V mean_limit = constant<V>(0.5) * (fused(start, growth, first) + limit);
  const V E = falling_exponential(way_length * (one - start) / max(mean_limit, least));
  const V cosine = dot(at_limit, way) * inverse_length * inverse_way;
  const V share = E * E * (one - cosine);
  const V scale_to = limit / max(one + cosine + share, least);
  const V along_way = scale_to * inverse_way * (one + cosine - share - constant<V>(2) * E * cosine);
  return add_scaled(scale(along_way, way), scale_to * constant<V>(2) * E * inverse_length, at_limit);
}

}  // namespace fixdem
