// Square root, logarithm and exponential for constant expressions.
//
// The coefficients of a case are evaluated by the compiler, where the standard library offers no constexpr roots or
// logarithms before C++26. Newton and series iterations to full double precision; never called in a step.
#pragma once

namespace fixdem {

constexpr double square_root(double x) {
  if (!(x > 0)) return 0;
  double y = x > 1 ? x : 1;
  for (int i = 0; i < 2000; ++i) {
    const double next = 0.5 * (y + x / y);
    if (!(next < y)) break;  // Newton from above decreases until it is exact
    y = next;
  }
  return y;
}

/// Natural logarithm: powers of two taken out, then the series of artanh on [1/sqrt2, sqrt2].
constexpr double logarithm(double x) {
  constexpr double ln2 = 0.693147180559945309417;
  int exponent = 0;
  while (x > 1.4142135623730951) x /= 2, ++exponent;
  while (x < 0.7071067811865476) x *= 2, --exponent;
  const double t = (x - 1) / (x + 1);
  double power = t, sum = 0;
  for (int k = 1; k < 60; k += 2, power *= t * t) sum += power / k;
  return 2 * sum + exponent * ln2;
}

/// Exponential: halved until small, then the Taylor series, then squared back.
constexpr double exponential(double x) {
  int halvings = 0;
  while (x > 0.25 || x < -0.25) x /= 2, ++halvings;
  double term = 1, sum = 1;
  for (int k = 1; k < 20; ++k) sum += term *= x / k;
  for (; halvings > 0; --halvings) sum *= sum;
  return sum;
}

}  // namespace fixdem
