// The SIMD vocabulary: W doubles or floats that are computed on together, with a scalar twin.
//
// Contact data comes in batches of 8 on every machine; a register holds W of them (lanes_type.hpp), and a batch is
// worked off in 8 / W parts. Lanes never mix within an operation, `fused` multiply-adds are written out and roots and
// quotients are the hardware's correctly rounded ones, so every width gives the same bits (build with
// -ffp-contract=off). Vector extensions carry the arithmetic; builtins and intrinsics stand only in lanes_x86.hpp
// and lanes_neon.hpp, for what the extensions lack. Formulas are written once for both element types: a number in one
// is `constant<V>(0.5)`, zero is `V{}`.
#pragma once

#include "lanes_type.hpp"
#if defined(__SSE2__)
#include "lanes_x86.hpp"
#elif defined(__aarch64__)
#include "lanes_neon.hpp"
#endif

namespace fixdem {

/// Three components, each of them lanes (or a plain double).
template <class V>
struct Vec3 {
  V x, y, z;
};

/// Four of them: a row of numbers.
template <class V>
struct Vec4 {
  V x, y, z, w;
};

template <class V>
FIXDEM_INLINE Vec4<V> padded(const Vec3<V>& a) {
  return {a.x, a.y, a.z, V{}};
}

// ---- one lane: plain numbers -------------------------------------------------------------------------------------
FIXDEM_INLINE double fused(double a, double b, double c) { return __builtin_fma(a, b, c); }  // a b + c
FIXDEM_INLINE double sqrt(double a) { return __builtin_sqrt(a); }
FIXDEM_INLINE double abs(double a) { return __builtin_fabs(a); }
FIXDEM_INLINE float fused(float a, float b, float c) { return __builtin_fmaf(a, b, c); }
FIXDEM_INLINE float sqrt(float a) { return __builtin_sqrtf(a); }
FIXDEM_INLINE float abs(float a) { return __builtin_fabsf(a); }
FIXDEM_INLINE float narrow(double a) { return static_cast<float>(a); }
FIXDEM_INLINE bool any(bool mask) { return mask; }
FIXDEM_INLINE unsigned bits(bool mask) { return mask; }

// ---- any width ---------------------------------------------------------------------------------------------------
/// A number in a formula of lanes; the compiler repeats it in all of them.
template <class V>
FIXDEM_INLINE constexpr Element<V> constant(double a) {
  return static_cast<Element<V>>(a);
}

template <class V>
FIXDEM_INLINE V splat(double a) {
  return V{} + constant<V>(a);
}

template <class V>
FIXDEM_INLINE V max(V a, V b) {
  return a > b ? a : b;
}

template <class V>
FIXDEM_INLINE V min(V a, V b) {
  return a < b ? a : b;
}

template <class Mask, class V>
FIXDEM_INLINE V select(Mask mask, V a, V b) {
  return mask ? a : b;
}

/// Lanes in which a < b, and whether there is one.
template <class V>
FIXDEM_INLINE unsigned bits_below(V a, V b) {
  return bits(a < b);
}
template <class V>
FIXDEM_INLINE bool any_below(V a, V b) {
  return any(a < b);
}

/// Aligned to the register.
template <class V>
FIXDEM_INLINE V load(const Element<V>* p) {
  return *reinterpret_cast<const V __attribute__((may_alias))*>(p);
}

template <class V>
FIXDEM_INLINE void store(Element<V>* p, V a) {
  *reinterpret_cast<V __attribute__((may_alias))*>(p) = a;
}

/// Unaligned.
template <class V>
FIXDEM_INLINE V load_any(const Element<V>* p) {
  V a;
  __builtin_memcpy(&a, p, sizeof a);
  return a;
}

/// W floats as lanes of doubles; aligned to W floats.
template <int W>
FIXDEM_INLINE Lanes<W> load_wide(const float* p) {
  if constexpr (W == 1)
    return *p;
  else
    return __builtin_convertvector(load<Lanes<W, float>>(p), Lanes<W>);
}

/// Lanes of doubles as W floats, rounded to nearest; aligned to W floats.
template <int W>
FIXDEM_INLINE void store_narrow(float* p, Lanes<W> a) {
  if constexpr (W == 1)
    *p = narrow(a);
  else
    store(p, __builtin_convertvector(a, Lanes<W, float>));
}

/// -(a b) + c, where a register has no instruction of its own for it.
template <class V>
FIXDEM_INLINE V fused_minus(V a, V b, V c) {
  return fused(-a, b, c);
}

/// The lanes of `a` where the mask is set, zero elsewhere.
template <class Mask, class V>
FIXDEM_INLINE V where(Mask mask, V a) {
  return select(mask, a, V{});
}

/// A divisor that is not zero where a vector or a force vanishes.
template <class V>
inline constexpr double least_square = sizeof(Element<V>) == sizeof(double) ? 0x1p-1000 : 0x1p-120;

template <class V>
FIXDEM_INLINE V dot(const Vec3<V>& a, const Vec3<V>& b) {
  return fused(a.z, b.z, fused(a.y, b.y, a.x * b.x));
}

/// Two components, the third known to be zero: the normal of the pipe's wall.
template <class V>
struct Vec2 {
  V x, y;
};
template <class V>
FIXDEM_INLINE V dot(const Vec3<V>& a, const Vec2<V>& b) {
  return fused(a.y, b.y, a.x * b.x);
}

/// a + s b
template <class V>
FIXDEM_INLINE Vec3<V> add_scaled(const Vec3<V>& a, V s, const Vec3<V>& b) {
  return {fused(s, b.x, a.x), fused(s, b.y, a.y), fused(s, b.z, a.z)};
}

/// a - s b
template <class V>
FIXDEM_INLINE Vec3<V> subtract_scaled(const Vec3<V>& a, V s, const Vec3<V>& b) {
  return {fused_minus(s, b.x, a.x), fused_minus(s, b.y, a.y), fused_minus(s, b.z, a.z)};
}

template <class V>
FIXDEM_INLINE Vec3<V> subtract_scaled(const Vec3<V>& a, V s, const Vec2<V>& b) {
  return {fused_minus(s, b.x, a.x), fused_minus(s, b.y, a.y), a.z};
}

template <class V>
FIXDEM_INLINE Vec3<V> scale(V s, const Vec3<V>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class V>
FIXDEM_INLINE Vec3<V> scale(V s, const Vec2<V>& a) {
  return {s * a.x, s * a.y, V{}};
}

template <class V>
FIXDEM_INLINE Vec3<V> cross(const Vec3<V>& a, const Vec3<V>& b) {
  return {fused(a.y, b.z, -(a.z * b.y)), fused(a.z, b.x, -(a.x * b.z)), fused(a.x, b.y, -(a.y * b.x))};
}

template <class V>
FIXDEM_INLINE Vec3<V> cross(const Vec2<V>& a, const Vec3<V>& b) {
  return {a.y * b.z, -(a.x * b.z), fused(a.x, b.y, -(a.y * b.x))};
}

/// a + b x c
template <class V>
FIXDEM_INLINE Vec3<V> add_cross(const Vec3<V>& a, const Vec3<V>& b, const Vec3<V>& c) {
  return {fused_minus(b.z, c.y, fused(b.y, c.z, a.x)), fused_minus(b.x, c.z, fused(b.z, c.x, a.y)),
          fused_minus(b.y, c.x, fused(b.x, c.y, a.z))};
}

template <class V>
FIXDEM_INLINE Vec3<V> add_cross(const Vec3<V>& a, const Vec3<V>& b, const Vec2<V>& c) {
  return {fused_minus(b.z, c.y, a.x), fused(b.z, c.x, a.y), fused_minus(b.y, c.x, fused(b.x, c.y, a.z))};
}

template <class Mask, class V>
FIXDEM_INLINE Vec3<V> where(Mask mask, const Vec3<V>& a) {
  return {where(mask, a.x), where(mask, a.y), where(mask, a.z)};
}

template <class Mask, class V>
FIXDEM_INLINE Vec3<V> select(Mask mask, const Vec3<V>& a, const Vec3<V>& b) {
  return {select(mask, a.x, b.x), select(mask, a.y, b.y), select(mask, a.z, b.z)};
}

/// Lane numbers counted from `first`.
template <int W, class T = double>
FIXDEM_INLINE Lanes<W, T> lane_numbers(int first) {
  using V = Lanes<W, T>;
  const T start = static_cast<T>(first);
  if constexpr (W == 16) {
    return V{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15} + start;
  } else if constexpr (W == 8) {
    return V{0, 1, 2, 3, 4, 5, 6, 7} + start;
  } else if constexpr (W == 4) {
    return V{0, 1, 2, 3} + start;
  } else if constexpr (W == 2) {
    return V{0, 1} + start;
  } else {
    return start;
  }
}

}  // namespace fixdem
