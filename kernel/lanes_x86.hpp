// What the vector extensions lack, on x86: SSE2, AVX2 with FMA, AVX-512.
//
// Per width: fused multiply-add, correctly rounded square root, absolute value, the question whether any lane is set,
// and the conversion of two registers of doubles into one of floats, to nearest. Without hardware for it (SSE2 alone)
// a fused multiply-add is the C library's, lane by lane: as exact, and much slower.
#pragma once

#include <immintrin.h>

#include "lanes_type.hpp"

namespace fixdem {

// ---- 128 bits: two doubles, four floats --------------------------------------------------------------------------
using Lanes2 = Lanes<2>;
using Mask2 = decltype(Lanes2{} < Lanes2{});
using Floats4 = Lanes<4, float>;
using FloatMask4 = decltype(Floats4{} < Floats4{});
#if defined(__FMA__)
FIXDEM_INLINE Lanes2 fused(Lanes2 a, Lanes2 b, Lanes2 c) { return Lanes2(_mm_fmadd_pd(a, b, c)); }
FIXDEM_INLINE Lanes2 fused_minus(Lanes2 a, Lanes2 b, Lanes2 c) { return Lanes2(_mm_fnmadd_pd(a, b, c)); }
FIXDEM_INLINE Floats4 fused(Floats4 a, Floats4 b, Floats4 c) { return Floats4(_mm_fmadd_ps(a, b, c)); }
FIXDEM_INLINE Floats4 fused_minus(Floats4 a, Floats4 b, Floats4 c) { return Floats4(_mm_fnmadd_ps(a, b, c)); }
#else
FIXDEM_INLINE Lanes2 fused(Lanes2 a, Lanes2 b, Lanes2 c) {
  return Lanes2{__builtin_fma(a[0], b[0], c[0]), __builtin_fma(a[1], b[1], c[1])};
}
FIXDEM_INLINE Floats4 fused(Floats4 a, Floats4 b, Floats4 c) {
  return Floats4{__builtin_fmaf(a[0], b[0], c[0]), __builtin_fmaf(a[1], b[1], c[1]), __builtin_fmaf(a[2], b[2], c[2]),
                 __builtin_fmaf(a[3], b[3], c[3])};
}
#endif
FIXDEM_INLINE Lanes2 sqrt(Lanes2 a) { return Lanes2(_mm_sqrt_pd(a)); }
FIXDEM_INLINE Lanes2 abs(Lanes2 a) { return Lanes2(_mm_andnot_pd(_mm_set1_pd(-0.0), a)); }
FIXDEM_INLINE unsigned bits(Mask2 mask) { return static_cast<unsigned>(_mm_movemask_pd(__m128d(mask))); }
FIXDEM_INLINE bool any(Mask2 mask) { return bits(mask) != 0; }
FIXDEM_INLINE Floats4 sqrt(Floats4 a) { return Floats4(_mm_sqrt_ps(a)); }
FIXDEM_INLINE Floats4 abs(Floats4 a) { return Floats4(_mm_andnot_ps(_mm_set1_ps(-0.0f), a)); }
FIXDEM_INLINE unsigned bits(FloatMask4 mask) { return static_cast<unsigned>(_mm_movemask_ps(__m128(mask))); }
FIXDEM_INLINE bool any(FloatMask4 mask) { return bits(mask) != 0; }
FIXDEM_INLINE Floats4 narrow(Lanes2 low, Lanes2 high) {
  return Floats4(_mm_movelh_ps(_mm_cvtpd_ps(low), _mm_cvtpd_ps(high)));
}

// ---- 256 bits: four doubles, eight floats ------------------------------------------------------------------------
#if FIXDEM_WIDEST_LANES >= 4
using Lanes4 = Lanes<4>;
using Mask4 = decltype(Lanes4{} < Lanes4{});
using Floats8 = Lanes<8, float>;
using FloatMask8 = decltype(Floats8{} < Floats8{});
FIXDEM_INLINE Lanes4 fused(Lanes4 a, Lanes4 b, Lanes4 c) { return Lanes4(_mm256_fmadd_pd(a, b, c)); }
FIXDEM_INLINE Lanes4 fused_minus(Lanes4 a, Lanes4 b, Lanes4 c) { return Lanes4(_mm256_fnmadd_pd(a, b, c)); }
FIXDEM_INLINE Lanes4 sqrt(Lanes4 a) { return Lanes4(_mm256_sqrt_pd(a)); }
FIXDEM_INLINE Lanes4 abs(Lanes4 a) { return Lanes4(_mm256_andnot_pd(_mm256_set1_pd(-0.0), a)); }
FIXDEM_INLINE unsigned bits(Mask4 mask) { return static_cast<unsigned>(_mm256_movemask_pd(__m256d(mask))); }
FIXDEM_INLINE bool any(Mask4 mask) { return bits(mask) != 0; }
FIXDEM_INLINE Floats8 fused(Floats8 a, Floats8 b, Floats8 c) { return Floats8(_mm256_fmadd_ps(a, b, c)); }
FIXDEM_INLINE Floats8 fused_minus(Floats8 a, Floats8 b, Floats8 c) { return Floats8(_mm256_fnmadd_ps(a, b, c)); }
FIXDEM_INLINE Floats8 sqrt(Floats8 a) { return Floats8(_mm256_sqrt_ps(a)); }
FIXDEM_INLINE Floats8 abs(Floats8 a) { return Floats8(_mm256_andnot_ps(_mm256_set1_ps(-0.0f), a)); }
FIXDEM_INLINE unsigned bits(FloatMask8 mask) { return static_cast<unsigned>(_mm256_movemask_ps(__m256(mask))); }
FIXDEM_INLINE bool any(FloatMask8 mask) { return bits(mask) != 0; }
FIXDEM_INLINE Floats8 narrow(Lanes4 low, Lanes4 high) {
  return Floats8(_mm256_set_m128(_mm256_cvtpd_ps(high), _mm256_cvtpd_ps(low)));
}
#endif

// ---- 512 bits: eight doubles, sixteen floats. The masked forms of gcc's roots carry no undefined register. ---------
#if FIXDEM_WIDEST_LANES >= 8
using Lanes8 = Lanes<8>;
using Mask8 = decltype(Lanes8{} < Lanes8{});
using Floats16 = Lanes<16, float>;
using FloatMask16 = decltype(Floats16{} < Floats16{});
#if defined(__AVX512F__) && defined(__AVX512DQ__)
FIXDEM_INLINE Lanes8 fused(Lanes8 a, Lanes8 b, Lanes8 c) { return Lanes8(_mm512_fmadd_pd(a, b, c)); }
FIXDEM_INLINE Lanes8 fused_minus(Lanes8 a, Lanes8 b, Lanes8 c) { return Lanes8(_mm512_fnmadd_pd(a, b, c)); }
FIXDEM_INLINE Lanes8 sqrt(Lanes8 a) { return Lanes8(_mm512_maskz_sqrt_pd(0xff, a)); }
FIXDEM_INLINE Lanes8 abs(Lanes8 a) { return Lanes8(_mm512_andnot_pd(_mm512_set1_pd(-0.0), a)); }
FIXDEM_INLINE unsigned bits(Mask8 mask) { return _mm512_movepi64_mask(__m512i(mask)); }
FIXDEM_INLINE bool any(Mask8 mask) { return _mm512_test_epi64_mask(__m512i(mask), __m512i(mask)) != 0; }
FIXDEM_INLINE Lanes8 join(Lanes4 low, Lanes4 high) {
  return Lanes8(_mm512_maskz_insertf64x4(0xff, _mm512_castpd256_pd512(__m256d(low)), __m256d(high), 1));
}
FIXDEM_INLINE Floats16 fused(Floats16 a, Floats16 b, Floats16 c) { return Floats16(_mm512_fmadd_ps(a, b, c)); }
FIXDEM_INLINE Floats16 fused_minus(Floats16 a, Floats16 b, Floats16 c) { return Floats16(_mm512_fnmadd_ps(a, b, c)); }
FIXDEM_INLINE Floats16 sqrt(Floats16 a) { return Floats16(_mm512_maskz_sqrt_ps(0xffff, a)); }
FIXDEM_INLINE Floats16 abs(Floats16 a) { return Floats16(_mm512_andnot_ps(_mm512_set1_ps(-0.0f), a)); }
FIXDEM_INLINE unsigned bits(FloatMask16 mask) { return _mm512_movepi32_mask(__m512i(mask)); }
FIXDEM_INLINE bool any(FloatMask16 mask) { return _mm512_test_epi32_mask(__m512i(mask), __m512i(mask)) != 0; }
FIXDEM_INLINE Floats16 narrow(Lanes8 low, Lanes8 high) {
  const Floats8 first = Floats8(_mm512_maskz_cvtpd_ps(0xff, low)), second = Floats8(_mm512_maskz_cvtpd_ps(0xff, high));
  return __builtin_shufflevector(first, second, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
}
#else
// The same as pairs of 256-bit registers.
namespace detail {
template <class Half, class V>
FIXDEM_INLINE Half half(const V& a, int which) {
  Half h;
  __builtin_memcpy(&h, reinterpret_cast<const char*>(&a) + which * sizeof h, sizeof h);
  return h;
}
template <class V, class Half>
FIXDEM_INLINE V both(Half low, Half high) {
  V a;
  __builtin_memcpy(&a, &low, sizeof low);
  __builtin_memcpy(reinterpret_cast<char*>(&a) + sizeof low, &high, sizeof high);
  return a;
}
template <class Half, class V>
FIXDEM_INLINE V fused_pair(const V& a, const V& b, const V& c) {
  return both<V>(fused(half<Half>(a, 0), half<Half>(b, 0), half<Half>(c, 0)),
                 fused(half<Half>(a, 1), half<Half>(b, 1), half<Half>(c, 1)));
}
}  // namespace detail
FIXDEM_INLINE Lanes8 fused(Lanes8 a, Lanes8 b, Lanes8 c) { return detail::fused_pair<Lanes4>(a, b, c); }
FIXDEM_INLINE Floats16 fused(Floats16 a, Floats16 b, Floats16 c) { return detail::fused_pair<Floats8>(a, b, c); }
FIXDEM_INLINE Lanes8 sqrt(Lanes8 a) {
  return detail::both<Lanes8>(sqrt(detail::half<Lanes4>(a, 0)), sqrt(detail::half<Lanes4>(a, 1)));
}
FIXDEM_INLINE Floats16 sqrt(Floats16 a) {
  return detail::both<Floats16>(sqrt(detail::half<Floats8>(a, 0)), sqrt(detail::half<Floats8>(a, 1)));
}
FIXDEM_INLINE Lanes8 abs(Lanes8 a) {
  return detail::both<Lanes8>(abs(detail::half<Lanes4>(a, 0)), abs(detail::half<Lanes4>(a, 1)));
}
FIXDEM_INLINE Floats16 abs(Floats16 a) {
  return detail::both<Floats16>(abs(detail::half<Floats8>(a, 0)), abs(detail::half<Floats8>(a, 1)));
}
FIXDEM_INLINE Lanes8 join(Lanes4 low, Lanes4 high) { return detail::both<Lanes8>(low, high); }
FIXDEM_INLINE bool any(Mask8 mask) { return any(detail::half<Mask4>(mask, 0) | detail::half<Mask4>(mask, 1)); }
FIXDEM_INLINE unsigned bits(Mask8 mask) {
  return bits(detail::half<Mask4>(mask, 0)) | bits(detail::half<Mask4>(mask, 1)) << 4;
}
FIXDEM_INLINE unsigned bits(FloatMask16 mask) {
  return bits(detail::half<FloatMask8>(mask, 0)) | bits(detail::half<FloatMask8>(mask, 1)) << 8;
}
FIXDEM_INLINE bool any(FloatMask16 mask) {
  return any(detail::half<FloatMask8>(mask, 0) | detail::half<FloatMask8>(mask, 1));
}
FIXDEM_INLINE Floats16 narrow(Lanes8 low, Lanes8 high) {
  return detail::both<Floats16>(narrow(detail::half<Lanes4>(low, 0), detail::half<Lanes4>(low, 1)),
                                narrow(detail::half<Lanes4>(high, 0), detail::half<Lanes4>(high, 1)));
}
#endif
#endif

}  // namespace fixdem
