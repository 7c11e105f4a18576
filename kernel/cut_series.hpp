// Power series cut short without losing more accuracy than must be: polynomials for a bounded argument.
//
// A Taylor series is best at its centre and worst at the ends of the interval it is used on. Taking its highest powers
// off one by one, each as the Chebyshev polynomial of that degree, spreads the error evenly: with six terms the means
// of impulse_means.hpp are good to 6e-12, for which the series itself needs eight (tests/impulse_parts_test.cpp). The
// compiler does that; a step evaluates the polynomial only.
#pragma once

#include "lanes.hpp"

namespace fixdem::detail {

/// A power series cut short: the polynomial of `terms` coefficients that differs least, or nearly so, from the series
/// between `low` and `high`. Higher powers are taken off one by one, each as its Chebyshev polynomial of that interval.
template <int terms>
struct CutSeries {
  static constexpr int given = 24;
  double c[terms] = {};
  constexpr CutSeries(const double (&series)[given], double low, double high) {
    double rest[given] = {}, chebyshev[given][given] = {};
    const double slope = 2 / (high - low), offset = -(low + high) / (high - low);
    chebyshev[0][0] = 1, chebyshev[1][0] = offset, chebyshev[1][1] = slope;
    for (int n = 2; n < given; ++n)
      for (int k = 0; k <= n; ++k)
        chebyshev[n][k] =
            2 * (offset * chebyshev[n - 1][k] + (k > 0 ? slope * chebyshev[n - 1][k - 1] : 0)) - chebyshev[n - 2][k];
    for (int k = 0; k < given; ++k) rest[k] = series[k];
    for (int n = given - 1; n >= terms; --n) {
      const double share = rest[n] / chebyshev[n][n];
      for (int k = 0; k <= n; ++k) rest[k] -= share * chebyshev[n][k];
    }
    for (int k = 0; k < terms; ++k) c[k] = rest[k];
  }
};

/// c_0 + c_1 x + c_2 x^2 + ..., by pairs of terms: the law waits for it, and Horner's rule would take twice as long.
template <int terms, class V>
FIXDEM_INLINE V polynomial(const double (&c)[terms], V x) {
  const V square = x * x;
  constexpr int last = (terms - 1) / 2 * 2;
  V sum = last + 1 < terms ? fused(splat<V>(c[terms - 1]), x, splat<V>(c[last])) : splat<V>(c[last]);
  for (int k = last - 2; k >= 0; k -= 2) sum = fused(sum, square, fused(splat<V>(c[k + 1]), x, splat<V>(c[k])));
  return sum;
}

}  // namespace fixdem::detail
