// Coulomb's slider: how the tangential spring of a contact moves while it slides.
//
// The spring grows with the slip and is no longer than mu |f_n| / k_t. `clip` cuts the grown spring to that length.
// `exact` follows it: straight on while it is inside the limit; from there on it keeps the length of the limit, and
// with theta its angle to the slip, d(theta) = -sin(theta) |d(slip)| / length, so tan(theta/2) falls as exp(-slip /
// length). The limit goes linearly from its last value to the present one. Lengths are in units of the history: metres,
// or newtons.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "kernel/case.hpp"

namespace fixdem::reference {

template <class Scalar>
using Vector = Eigen::Matrix<Scalar, 3, 1>;

/// Where the spring is after a step in which it grows by `way` while its limit goes from `first` to `last`, linearly.
template <class Scalar>
Vector<Scalar> spring_after_sliding(const Vector<Scalar>& kept, const Vector<Scalar>& way, Scalar first, Scalar last) {
  if ((kept + way).norm() <= last) return kept + way;
  const Scalar growth = last - first;
  const Scalar a = way.squaredNorm() - growth * growth, b = kept.dot(way) - first * growth;
  const Scalar c = kept.squaredNorm() - first * first;
  const Scalar root = std::sqrt(std::max(b * b - a * c, Scalar(0)));
  const Scalar out = b > 0 ? -c / (b + root) : a > 0 ? (root - b) / a : Scalar(0);
  const Scalar s = std::min(std::max(out, Scalar(0)), Scalar(1));
  const Vector<Scalar> at_limit = kept + s * way;
  if (at_limit.norm() == 0 || way.norm() == 0) return last * at_limit.normalized();
  const Vector<Scalar> along = way.normalized();
  const Vector<Scalar> across = at_limit - at_limit.dot(along) * along;
  if (across.norm() == 0) return last * at_limit.normalized();
  const Scalar angle = std::atan2(across.norm(), at_limit.dot(along));
  const Scalar mean_limit = (first + s * growth + last) / 2;
  const Scalar turned = 2 * std::atan(std::tan(angle / 2) * std::exp(-way.norm() * (1 - s) / mean_limit));
  return last * (std::cos(turned) * along + std::sin(turned) * across.normalized());
}

/// The spring grown by `way` and brought back under its limit by `clip` or `exact`; `last_limit` is the limit of the
/// step before if it slid then, or zero, and becomes the present one.
template <class Case, class Scalar>
Vector<Scalar> spring_within_limit(const Vector<Scalar>& kept, const Vector<Scalar>& way, Scalar limit,
                                   Scalar& last_limit) {
  const Vector<Scalar> trial = kept + way;
  const bool slides = trial.norm() > limit;
  const Scalar before = std::max(last_limit > 0 ? last_limit : limit, kept.norm());
  last_limit = slides ? limit : Scalar(0);
  if (!slides) return trial;
  if (Case::slider == Slider::exact) return spring_after_sliding<Scalar>(kept, way, before, limit);
  return trial * (limit / trial.norm());
}

}  // namespace fixdem::reference
