// The SIMD vocabulary: W doubles that are computed on together, with a scalar twin.
//
// Contact data comes in batches of 8 on every machine; a register holds W = 8 (AVX-512), 4 (AVX2) or 1 (scalar) of
// them, and a batch is worked off in 8 / W parts. Lanes never mix within an operation, `fused` multiply-adds are
// written out and roots and quotients are the hardware's correctly rounded ones, so every width gives the same bits
// (build with -ffp-contract=off). Vector extensions carry the arithmetic; intrinsics stand only in this file, for what
// the extensions lack: fused multiply-add, square root, maximum, and the question whether any lane is set.
#pragma once

#if defined(__AVX2__) || defined(__AVX512F__)
#include <immintrin.h>
#endif

/// Everything between loads and stores of the hot loop must be inlined, or lanes travel through memory: gcc 12 left the
/// law of a batch a function of its own, which cost a quarter of the time of a step.
#define FIXDEM_INLINE inline __attribute__((always_inline))

namespace fixdem {

#if defined(FIXDEM_LANES)
inline constexpr int native_lanes = FIXDEM_LANES;
#elif defined(__AVX512F__) && defined(__AVX512DQ__)
inline constexpr int native_lanes = 8;
#elif defined(__AVX2__) && defined(__FMA__)
inline constexpr int native_lanes = 4;
#else
inline constexpr int native_lanes = 1;
#endif

namespace detail {
template <int W>
struct LanesOf {
  typedef double type __attribute__((vector_size(8 * W)));
};
template <>
struct LanesOf<1> {
  using type = double;
};
}  // namespace detail

template <int W>
using Lanes = typename detail::LanesOf<W>::type;

/// Three components, each of them lanes (or a plain double).
template <class V>
struct Vec3 {
  V x, y, z;
};

// ---- one lane: plain doubles -------------------------------------------------------------------------------------
FIXDEM_INLINE double fused(double a, double b, double c) { return __builtin_fma(a, b, c); }  // a b + c
FIXDEM_INLINE double sqrt(double a) { return __builtin_sqrt(a); }
FIXDEM_INLINE double max(double a, double b) { return a > b ? a : b; }
FIXDEM_INLINE double abs(double a) { return __builtin_fabs(a); }
FIXDEM_INLINE bool any(bool mask) { return mask; }
FIXDEM_INLINE double select(bool mask, double a, double b) { return mask ? a : b; }

// ---- four lanes --------------------------------------------------------------------------------------------------
#if defined(__AVX2__) && defined(__FMA__)
using Lanes4 = Lanes<4>;
using Mask4 = decltype(Lanes4{} < Lanes4{});
FIXDEM_INLINE Lanes4 fused(Lanes4 a, Lanes4 b, Lanes4 c) { return Lanes4(_mm256_fmadd_pd(a, b, c)); }
FIXDEM_INLINE Lanes4 sqrt(Lanes4 a) { return Lanes4(_mm256_sqrt_pd(a)); }
FIXDEM_INLINE Lanes4 max(Lanes4 a, Lanes4 b) { return a > b ? a : b; }
FIXDEM_INLINE Lanes4 abs(Lanes4 a) { return Lanes4(_mm256_andnot_pd(_mm256_set1_pd(-0.0), a)); }
FIXDEM_INLINE bool any(Mask4 mask) { return _mm256_movemask_pd(__m256d(mask)) != 0; }
FIXDEM_INLINE Lanes4 select(Mask4 mask, Lanes4 a, Lanes4 b) { return mask ? a : b; }
#endif

// ---- eight lanes -------------------------------------------------------------------------------------------------
#if defined(__AVX512F__) && defined(__AVX512DQ__)
using Lanes8 = Lanes<8>;
using Mask8 = decltype(Lanes8{} < Lanes8{});
FIXDEM_INLINE Lanes8 fused(Lanes8 a, Lanes8 b, Lanes8 c) { return Lanes8(_mm512_fmadd_pd(a, b, c)); }
FIXDEM_INLINE Lanes8 sqrt(Lanes8 a) { return Lanes8(_mm512_maskz_sqrt_pd(0xff, a)); }
FIXDEM_INLINE Lanes8 max(Lanes8 a, Lanes8 b) { return a > b ? a : b; }
FIXDEM_INLINE Lanes8 abs(Lanes8 a) { return Lanes8(_mm512_andnot_pd(_mm512_set1_pd(-0.0), a)); }
FIXDEM_INLINE bool any(Mask8 mask) { return _mm512_movepi64_mask(__m512i(mask)) != 0; }
FIXDEM_INLINE Lanes8 select(Mask8 mask, Lanes8 a, Lanes8 b) { return mask ? a : b; }
#endif

// ---- any width ---------------------------------------------------------------------------------------------------
template <class V>
FIXDEM_INLINE V splat(double a) {
  return V{} + a;
}

/// Aligned to the register.
template <class V>
FIXDEM_INLINE V load(const double* p) {
  return *reinterpret_cast<const V __attribute__((may_alias))*>(p);
}

template <class V>
FIXDEM_INLINE void store(double* p, V a) {
  *reinterpret_cast<V __attribute__((may_alias))*>(p) = a;
}

/// Unaligned.
template <class V>
FIXDEM_INLINE V load_any(const double* p) {
  V a;
  __builtin_memcpy(&a, p, sizeof a);
  return a;
}

/// -(a b) + c
template <class V>
FIXDEM_INLINE V fused_minus(V a, V b, V c) {
  return fused(-a, b, c);
}

/// The lanes of `a` where the mask is set, zero elsewhere.
template <class Mask, class V>
FIXDEM_INLINE V keep(Mask mask, V a) {
  return select(mask, a, V{});
}

template <class V>
FIXDEM_INLINE V dot(const Vec3<V>& a, const Vec3<V>& b) {
  return fused(a.z, b.z, fused(a.y, b.y, a.x * b.x));
}

/// a + s b
template <class V>
FIXDEM_INLINE Vec3<V> add_scaled(const Vec3<V>& a, V s, const Vec3<V>& b) {
  return {fused(s, b.x, a.x), fused(s, b.y, a.y), fused(s, b.z, a.z)};
}

template <class V>
FIXDEM_INLINE Vec3<V> scale(V s, const Vec3<V>& a) {
  return {s * a.x, s * a.y, s * a.z};
}

template <class V>
FIXDEM_INLINE Vec3<V> cross(const Vec3<V>& a, const Vec3<V>& b) {
  return {fused(a.y, b.z, -(a.z * b.y)), fused(a.z, b.x, -(a.x * b.z)), fused(a.x, b.y, -(a.y * b.x))};
}

/// a + b x c
template <class V>
FIXDEM_INLINE Vec3<V> add_cross(const Vec3<V>& a, const Vec3<V>& b, const Vec3<V>& c) {
  return {fused_minus(b.z, c.y, fused(b.y, c.z, a.x)), fused_minus(b.x, c.z, fused(b.z, c.x, a.y)),
          fused_minus(b.y, c.x, fused(b.x, c.y, a.z))};
}

template <class Mask, class V>
FIXDEM_INLINE Vec3<V> select(Mask mask, const Vec3<V>& a, const Vec3<V>& b) {
  return {select(mask, a.x, b.x), select(mask, a.y, b.y), select(mask, a.z, b.z)};
}

/// Lane numbers counted from `first`.
template <int W>
FIXDEM_INLINE Lanes<W> lane_numbers(int first) {
  if constexpr (W == 8) {
    return Lanes<W>{0, 1, 2, 3, 4, 5, 6, 7} + first;
  } else if constexpr (W == 4) {
    return Lanes<W>{0, 1, 2, 3} + first;
  } else {
    return first;
  }
}

}  // namespace fixdem
