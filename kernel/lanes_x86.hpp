// What the vector extensions lack, on x86: SSE2, AVX2 with FMA, AVX-512.
//
// Per width: fused multiply-add, correctly rounded square root, absolute value, the question whether any lane is set,
// and the conversion of two registers of doubles into one of floats, to nearest. Without hardware for it (SSE2 alone)
// a fused multiply-add is the C library's, lane by lane: as exact, and much slower.
//
// These are the builtins of the compilers, not the intrinsics of <immintrin.h>, which takes longer to read than the
// whole kernel, and which with gcc includes mm_malloc.h: it wants malloc and free, and a freestanding program has
// none. gcc and older clangs agree on most names; newer clangs give them up for builtins of any width. In those of 512
// bits, 4 is the rounding that the machine is set to (to nearest).
#pragma once

#include "lanes_type.hpp"

#if __has_builtin(__builtin_elementwise_fma) && __has_builtin(__builtin_elementwise_sqrt)
#define FIXDEM_ELEMENTWISE 1
#else
#define FIXDEM_ELEMENTWISE 0
#endif

namespace fixdem {

namespace detail {
/// The sign bit of each lane cleared; V{} is +0, so the sign is that of -V{}.
template <class V>
FIXDEM_INLINE V without_sign(V a) {
  using Mask = decltype(a < a);
  return V(Mask(a) & ~Mask(-V{}));
}
}  // namespace detail

// ---- 128 bits: two doubles, four floats --------------------------------------------------------------------------
using Lanes2 = Lanes<2>;
using Mask2 = decltype(Lanes2{} < Lanes2{});
using Floats4 = Lanes<4, float>;
using FloatMask4 = decltype(Floats4{} < Floats4{});
#if !defined(__FMA__)
FIXDEM_INLINE Lanes2 fused(Lanes2 a, Lanes2 b, Lanes2 c) {
  return Lanes2{__builtin_fma(a[0], b[0], c[0]), __builtin_fma(a[1], b[1], c[1])};
}
FIXDEM_INLINE Floats4 fused(Floats4 a, Floats4 b, Floats4 c) {
  return Floats4{__builtin_fmaf(a[0], b[0], c[0]), __builtin_fmaf(a[1], b[1], c[1]), __builtin_fmaf(a[2], b[2], c[2]),
                 __builtin_fmaf(a[3], b[3], c[3])};
}
#elif FIXDEM_ELEMENTWISE
FIXDEM_INLINE Lanes2 fused(Lanes2 a, Lanes2 b, Lanes2 c) { return __builtin_elementwise_fma(a, b, c); }
FIXDEM_INLINE Floats4 fused(Floats4 a, Floats4 b, Floats4 c) { return __builtin_elementwise_fma(a, b, c); }
#else
FIXDEM_INLINE Lanes2 fused(Lanes2 a, Lanes2 b, Lanes2 c) { return __builtin_ia32_vfmaddpd(a, b, c); }
FIXDEM_INLINE Floats4 fused(Floats4 a, Floats4 b, Floats4 c) { return __builtin_ia32_vfmaddps(a, b, c); }
#endif
#if defined(__FMA__) && !defined(__clang__)
FIXDEM_INLINE Lanes2 fused_minus(Lanes2 a, Lanes2 b, Lanes2 c) { return __builtin_ia32_vfnmaddpd(a, b, c); }
FIXDEM_INLINE Floats4 fused_minus(Floats4 a, Floats4 b, Floats4 c) { return __builtin_ia32_vfnmaddps(a, b, c); }
#endif
#if FIXDEM_ELEMENTWISE
FIXDEM_INLINE Lanes2 sqrt(Lanes2 a) { return __builtin_elementwise_sqrt(a); }
FIXDEM_INLINE Floats4 sqrt(Floats4 a) { return __builtin_elementwise_sqrt(a); }
#else
FIXDEM_INLINE Lanes2 sqrt(Lanes2 a) { return __builtin_ia32_sqrtpd(a); }
FIXDEM_INLINE Floats4 sqrt(Floats4 a) { return __builtin_ia32_sqrtps(a); }
#endif
FIXDEM_INLINE Lanes2 abs(Lanes2 a) { return detail::without_sign(a); }
FIXDEM_INLINE Floats4 abs(Floats4 a) { return detail::without_sign(a); }
FIXDEM_INLINE unsigned bits(Mask2 mask) { return static_cast<unsigned>(__builtin_ia32_movmskpd(Lanes2(mask))); }
FIXDEM_INLINE unsigned bits(FloatMask4 mask) { return static_cast<unsigned>(__builtin_ia32_movmskps(Floats4(mask))); }
FIXDEM_INLINE bool any(Mask2 mask) { return bits(mask) != 0; }
FIXDEM_INLINE bool any(FloatMask4 mask) { return bits(mask) != 0; }
FIXDEM_INLINE Floats4 narrow(Lanes2 low, Lanes2 high) {
  return __builtin_shufflevector(__builtin_ia32_cvtpd2ps(low), __builtin_ia32_cvtpd2ps(high), 0, 1, 4, 5);
}

// ---- 256 bits: four doubles, eight floats ------------------------------------------------------------------------
#if FIXDEM_WIDEST_LANES >= 4
using Lanes4 = Lanes<4>;
using Mask4 = decltype(Lanes4{} < Lanes4{});
using Floats8 = Lanes<8, float>;
using FloatMask8 = decltype(Floats8{} < Floats8{});
#if FIXDEM_ELEMENTWISE
FIXDEM_INLINE Lanes4 fused(Lanes4 a, Lanes4 b, Lanes4 c) { return __builtin_elementwise_fma(a, b, c); }
FIXDEM_INLINE Floats8 fused(Floats8 a, Floats8 b, Floats8 c) { return __builtin_elementwise_fma(a, b, c); }
FIXDEM_INLINE Lanes4 sqrt(Lanes4 a) { return __builtin_elementwise_sqrt(a); }
FIXDEM_INLINE Floats8 sqrt(Floats8 a) { return __builtin_elementwise_sqrt(a); }
#else
FIXDEM_INLINE Lanes4 fused(Lanes4 a, Lanes4 b, Lanes4 c) { return __builtin_ia32_vfmaddpd256(a, b, c); }
FIXDEM_INLINE Floats8 fused(Floats8 a, Floats8 b, Floats8 c) { return __builtin_ia32_vfmaddps256(a, b, c); }
FIXDEM_INLINE Lanes4 sqrt(Lanes4 a) { return __builtin_ia32_sqrtpd256(a); }
FIXDEM_INLINE Floats8 sqrt(Floats8 a) { return __builtin_ia32_sqrtps256(a); }
#endif
#if !defined(__clang__)
FIXDEM_INLINE Lanes4 fused_minus(Lanes4 a, Lanes4 b, Lanes4 c) { return __builtin_ia32_vfnmaddpd256(a, b, c); }
FIXDEM_INLINE Floats8 fused_minus(Floats8 a, Floats8 b, Floats8 c) { return __builtin_ia32_vfnmaddps256(a, b, c); }
#endif
FIXDEM_INLINE Lanes4 abs(Lanes4 a) { return detail::without_sign(a); }
FIXDEM_INLINE Floats8 abs(Floats8 a) { return detail::without_sign(a); }
FIXDEM_INLINE unsigned bits(Mask4 mask) { return static_cast<unsigned>(__builtin_ia32_movmskpd256(Lanes4(mask))); }
FIXDEM_INLINE unsigned bits(FloatMask8 mask) {
  return static_cast<unsigned>(__builtin_ia32_movmskps256(Floats8(mask)));
}
FIXDEM_INLINE bool any(Mask4 mask) { return bits(mask) != 0; }
FIXDEM_INLINE bool any(FloatMask8 mask) { return bits(mask) != 0; }
FIXDEM_INLINE Floats8 narrow(Lanes4 low, Lanes4 high) {
  return __builtin_shufflevector(__builtin_ia32_cvtpd2ps256(low), __builtin_ia32_cvtpd2ps256(high), 0, 1, 2, 3, 4, 5, 6,
                                 7);
}
#endif

// ---- 512 bits: eight doubles, sixteen floats ---------------------------------------------------------------------
#if FIXDEM_WIDEST_LANES >= 8
using Lanes8 = Lanes<8>;
using Mask8 = decltype(Lanes8{} < Lanes8{});
using Floats16 = Lanes<16, float>;
using FloatMask16 = decltype(Floats16{} < Floats16{});
#if defined(__AVX512F__) && defined(__AVX512DQ__)
namespace detail {
using LongLongs8 = Lanes<8, long long>;  // the integers that the builtins take: a Mask8 has those of the comparison
using Ints16 = Lanes<16, int>;
// Masks of all lanes: gcc's builtins take some as signed and some as unsigned numbers.
#if defined(__clang__)
inline constexpr int all8 = 0xff, all16 = 0xffff;
#else
inline constexpr int all8 = -1, all16 = -1;
#endif
}  // namespace detail
FIXDEM_INLINE unsigned bits(Mask8 mask) {
  return static_cast<unsigned char>(__builtin_ia32_cvtq2mask512(detail::LongLongs8(mask)));
}
FIXDEM_INLINE unsigned bits(FloatMask16 mask) {
  return static_cast<unsigned short>(__builtin_ia32_cvtd2mask512(detail::Ints16(mask)));
}
#if FIXDEM_ELEMENTWISE
FIXDEM_INLINE Lanes8 fused(Lanes8 a, Lanes8 b, Lanes8 c) { return __builtin_elementwise_fma(a, b, c); }
FIXDEM_INLINE Floats16 fused(Floats16 a, Floats16 b, Floats16 c) { return __builtin_elementwise_fma(a, b, c); }
FIXDEM_INLINE Lanes8 sqrt(Lanes8 a) { return __builtin_elementwise_sqrt(a); }
FIXDEM_INLINE Floats16 sqrt(Floats16 a) { return __builtin_elementwise_sqrt(a); }
#else
FIXDEM_INLINE Lanes8 fused(Lanes8 a, Lanes8 b, Lanes8 c) {
  return __builtin_ia32_vfmaddpd512_mask(a, b, c, detail::all8, 4);
}
FIXDEM_INLINE Floats16 fused(Floats16 a, Floats16 b, Floats16 c) {
  return __builtin_ia32_vfmaddps512_mask(a, b, c, detail::all16, 4);
}
#endif
// gcc has better code for some in its own builtins than in the vector extensions.
#if defined(__clang__)
#if !FIXDEM_ELEMENTWISE
FIXDEM_INLINE Lanes8 sqrt(Lanes8 a) { return __builtin_ia32_sqrtpd512(a, 4); }
FIXDEM_INLINE Floats16 sqrt(Floats16 a) { return __builtin_ia32_sqrtps512(a, 4); }
#endif
FIXDEM_INLINE Lanes8 abs(Lanes8 a) { return detail::without_sign(a); }
FIXDEM_INLINE Floats16 abs(Floats16 a) { return detail::without_sign(a); }
FIXDEM_INLINE bool any(Mask8 mask) { return bits(mask) != 0; }
FIXDEM_INLINE bool any(FloatMask16 mask) { return bits(mask) != 0; }
FIXDEM_INLINE Lanes8 join(Lanes4 low, Lanes4 high) {
  return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
}
#else
FIXDEM_INLINE Lanes8 fused_minus(Lanes8 a, Lanes8 b, Lanes8 c) {
  return __builtin_ia32_vfnmaddpd512_mask(a, b, c, detail::all8, 4);
}
FIXDEM_INLINE Floats16 fused_minus(Floats16 a, Floats16 b, Floats16 c) {
  return __builtin_ia32_vfnmaddps512_mask(a, b, c, detail::all16, 4);
}
FIXDEM_INLINE Lanes8 sqrt(Lanes8 a) { return __builtin_ia32_sqrtpd512_mask(a, Lanes8{}, detail::all8, 4); }
FIXDEM_INLINE Floats16 sqrt(Floats16 a) { return __builtin_ia32_sqrtps512_mask(a, Floats16{}, detail::all16, 4); }
FIXDEM_INLINE Lanes8 abs(Lanes8 a) { return __builtin_ia32_andnpd512_mask(-Lanes8{}, a, Lanes8{}, detail::all8); }
FIXDEM_INLINE Floats16 abs(Floats16 a) {
  return __builtin_ia32_andnps512_mask(-Floats16{}, a, Floats16{}, detail::all16);
}
FIXDEM_INLINE bool any(Mask8 mask) {
  const auto a = detail::LongLongs8(mask);
  return __builtin_ia32_ptestmq512(a, a, detail::all8) != 0;
}
FIXDEM_INLINE bool any(FloatMask16 mask) {
  const auto a = detail::Ints16(mask);
  return __builtin_ia32_ptestmd512(a, a, detail::all16) != 0;
}
// It turns a mask into a vector and back before it looks at its bits; a comparison of its own leaves them where they
// are.
FIXDEM_INLINE unsigned bits_below(Lanes8 a, Lanes8 b) {
  constexpr int less = 17;  // and false for what is no number, without a signal
  return static_cast<unsigned char>(__builtin_ia32_cmppd512_mask(a, b, less, detail::all8, 4));
}
FIXDEM_INLINE unsigned bits_below(Floats16 a, Floats16 b) {
  constexpr int less = 17;
  return static_cast<unsigned short>(__builtin_ia32_cmpps512_mask(a, b, less, detail::all16, 4));
}
FIXDEM_INLINE bool any_below(Lanes8 a, Lanes8 b) { return bits_below(a, b) != 0; }
FIXDEM_INLINE bool any_below(Floats16 a, Floats16 b) { return bits_below(a, b) != 0; }
FIXDEM_INLINE Lanes8 join(Lanes4 low, Lanes4 high) {
  return __builtin_ia32_insertf64x4_mask(__builtin_ia32_pd512_256pd(low), high, 1, Lanes8{}, detail::all8);
}
#endif
FIXDEM_INLINE Floats16 narrow(Lanes8 low, Lanes8 high) {
  const Floats8 first = __builtin_convertvector(low, Floats8), second = __builtin_convertvector(high, Floats8);
  return __builtin_shufflevector(first, second, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
}
#else
// The same as pairs of 256-bit registers.
namespace detail {
template <class Half, class V>
FIXDEM_INLINE Half half(const V& a, unsigned which) {
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
