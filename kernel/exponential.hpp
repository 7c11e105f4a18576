// exp(-x) for x >= 0 on lanes, without a mathematics library.
//
// x = k ln 2 + r with a whole number k and |r| <= ln(2)/2; a cut series of exp(-r); the exponent bits of 2^-k. In
// double the relative error is below 2e-12, in float below 2e-7 (tests/impulse_parts_test.cpp measures it); every width
// gives the same bits. Beyond x = 700 (float: 80) it stays at the value there, which is no denormal number.
#pragma once

#include "cut_series.hpp"

namespace fixdem {

namespace detail {
/// Signed whole numbers as wide as the lanes of V.
template <class V, bool is_number = std::is_arithmetic_v<V>>
struct WholeLanes {
  using type = std::conditional_t<sizeof(V) == 8, long long, int>;
};
template <class V>
struct WholeLanes<V, false> {
  using type = decltype(V{} < V{});
};
}  // namespace detail

template <class V>
FIXDEM_INLINE V falling_exponential(V x) {
  using Whole = typename detail::WholeLanes<V>::type;
  constexpr bool is_double = sizeof(Element<V>) == sizeof(double);
  constexpr int mantissa_bits = is_double ? 52 : 23, bias = is_double ? 1023 : 127;
  constexpr double to_whole = is_double ? 0x1.8p52 : 0x1.8p23;  // added, it leaves the nearest whole number in the bits
  constexpr double ln2_high = is_double ? 0x1.62e42fefa0000p-1 : 0x1.62e000p-1;  // exact products with k
  constexpr double ln2_low = is_double ? 0x1.cf79abc9e3b3ap-40 : 0x1.0bfbe8p-15;
  const V maximum = splat<V>(is_double ? 700 : 80);
  const V y = x < maximum ? x : maximum;

  const V shifted = y * constant<V>(1.4426950408889634) + constant<V>(to_whole), k = shifted - constant<V>(to_whole);
  const V r = fused_minus(k, splat<V>(ln2_low), fused_minus(k, splat<V>(ln2_high), y));
  struct Series {
    double c[detail::CutSeries<9>::given] = {1};
    constexpr Series() {
      for (int k = 1; k < detail::CutSeries<9>::given; ++k) c[k] = -c[k - 1] / k;
    }
  };
  static constexpr detail::CutSeries<9> series(Series().c, -0.3466, 0.3466);
  const V sum = detail::polynomial(series.c, r);

  const V zero = splat<V>(to_whole);
  Whole bits, zero_bits;
  __builtin_memcpy(&bits, &shifted, sizeof bits);
  __builtin_memcpy(&zero_bits, &zero, sizeof zero_bits);
  bits = (zero_bits - bits + bias) << mantissa_bits;
  V power;
  __builtin_memcpy(&power, &bits, sizeof power);
  return sum * power;
}

}  // namespace fixdem
