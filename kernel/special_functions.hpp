// Arc cosine and a fractional power without a mathematics library.
//
// A step must be the same on every machine and run where there is no library, so the two transcendental functions of
// the gas model are made of products, quotients and square roots. Accuracy: relative error below 1e-12 on the whole
// range (tests/gas_test.cpp measures it). Both take lanes or doubles.
#pragma once

#include <cstdint>

#include "constant_math.hpp"
#include "lanes.hpp"

namespace fixdem {

namespace detail {

/// Coefficient n of arcsin(y) = y (c_0 + c_1 y^2 + ...): c_n = c_{n-1} (2n-1)^2 / (2n (2n+1)).
constexpr double arcsine_coefficient(int n) {
  double c = 1;
  for (int k = 1; k <= n; ++k) c *= (2.0 * k - 1) * (2.0 * k - 1) / (2.0 * k * (2.0 * k + 1));
  return c;
}
struct ArcsineSeries {
  static constexpr int terms = 15;  // sin^2(pi/8) = 0.146 to the 15th power times c_15 = 5e-3: 2e-15
  double c[terms] = {};
  constexpr ArcsineSeries() {
    for (int n = 0; n < terms; ++n) c[n] = arcsine_coefficient(n);
  }
};
inline constexpr ArcsineSeries arcsine_series;

/// arcsin(y) for 0 <= y <= sin(pi/4): half the angle first, then the Taylor series up to sin(pi/8).
template <class V>
V arcsine_to_45_degrees(V y) {
  const V cosine = sqrt(max(1.0 - y * y, V{}));
  const V half = y / sqrt(2.0 + 2.0 * cosine);  // sin(angle / 2)
  const V square = half * half;
  V sum = splat<V>(arcsine_series.c[ArcsineSeries::terms - 1]);
  for (int n = ArcsineSeries::terms - 2; n >= 0; --n) sum = fused(sum, square, splat<V>(arcsine_series.c[n]));
  return 2.0 * half * sum;
}

}  // namespace detail

/// arccos(x) for -1 <= x <= 1, with small relative error near x = 1.
template <class V>
V arc_cosine(V x) {
  const V angle = 2.0 * detail::arcsine_to_45_degrees(sqrt(max(0.5 - 0.5 * abs(x), V{})));
  return select(x < 0.0, 3.14159265358979323846 - angle, angle);
}

namespace detail {

/// Table for m^p, 1 <= m < 2: values at 32 midpoints, and 2^(p e) for the exponents of use.
template <int numerator, int denominator>
struct PowerTable {
  static constexpr double p = static_cast<double>(numerator) / denominator;
  static constexpr int cells = 32, least = -128, maximum = 127;
  double midpoint[cells] = {}, binary[maximum - least + 1] = {}, binomial[9] = {};
  constexpr PowerTable() {
    for (int k = 0; k < cells; ++k) midpoint[k] = exponential(p * logarithm(1 + (k + 0.5) / cells));
    const double up = exponential(p * 0.693147180559945309417);
    binary[-least] = 1;
    for (int e = 1; e <= maximum; ++e) binary[e - least] = binary[e - 1 - least] * up;
    for (int e = -1; e >= least; --e) binary[e - least] = binary[e + 1 - least] / up;
    binomial[0] = 1;
    for (int n = 1; n < 9; ++n) binomial[n] = binomial[n - 1] * (p - n + 1) / n;
  }
};

}  // namespace detail

/// x^(numerator/denominator) for 2^-128 <= x < 2^128 (clamped outside; zero gives the smallest value, not zero):
/// x = 2^e m, then the binomial series about the midpoint of one of 32 cells of m: (1/64)^9 is the first term left out.
template <int numerator, int denominator>
double power(double x) {
  static constexpr detail::PowerTable<numerator, denominator> table;
  std::uint64_t bits;
  __builtin_memcpy(&bits, &x, sizeof bits);
  int exponent = static_cast<int>(bits >> 52 & 2047) - 1023;
  if (exponent < table.least) exponent = table.least;
  if (exponent > table.maximum) exponent = table.maximum;
  const int cell = static_cast<int>(bits >> 47 & 31);
  bits = (bits & ((std::uint64_t{1} << 52) - 1)) | std::uint64_t{1023} << 52;
  double m;
  __builtin_memcpy(&m, &bits, sizeof m);
  const double centre = 1 + (cell + 0.5) / table.cells;
  const double t = (m - centre) / centre;
  double sum = table.binomial[8];
  for (int n = 7; n >= 0; --n) sum = fused(sum, t, table.binomial[n]);
  return table.midpoint[cell] * sum * table.binary[exponent - table.least];
}

}  // namespace fixdem
