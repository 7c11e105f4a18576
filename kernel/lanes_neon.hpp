// What the vector extensions lack, on aarch64: two doubles or four floats in a NEON register.
//
// Fused multiply-add, correctly rounded square root, absolute value, the question whether any lane is set, and the
// conversion of two registers of doubles into one of floats, to nearest.
#pragma once

#include <arm_neon.h>

#include "lanes_type.hpp"

namespace fixdem {

using Lanes2 = Lanes<2>;
using Mask2 = decltype(Lanes2{} < Lanes2{});
using Floats4 = Lanes<4, float>;
using FloatMask4 = decltype(Floats4{} < Floats4{});
FIXDEM_INLINE Lanes2 fused(Lanes2 a, Lanes2 b, Lanes2 c) {
  return Lanes2(vfmaq_f64(float64x2_t(c), float64x2_t(a), float64x2_t(b)));
}
FIXDEM_INLINE Lanes2 fused_minus(Lanes2 a, Lanes2 b, Lanes2 c) {
  return Lanes2(vfmsq_f64(float64x2_t(c), float64x2_t(a), float64x2_t(b)));
}
FIXDEM_INLINE Lanes2 sqrt(Lanes2 a) { return Lanes2(vsqrtq_f64(float64x2_t(a))); }
FIXDEM_INLINE Lanes2 abs(Lanes2 a) { return Lanes2(vabsq_f64(float64x2_t(a))); }
FIXDEM_INLINE unsigned bits(Mask2 mask) { return static_cast<unsigned>((mask[0] & 1) | (mask[1] & 2)); }
FIXDEM_INLINE bool any(Mask2 mask) { return vmaxvq_u32(uint32x4_t(mask)) != 0; }
FIXDEM_INLINE Floats4 fused(Floats4 a, Floats4 b, Floats4 c) {
  return Floats4(vfmaq_f32(float32x4_t(c), float32x4_t(a), float32x4_t(b)));
}
FIXDEM_INLINE Floats4 fused_minus(Floats4 a, Floats4 b, Floats4 c) {
  return Floats4(vfmsq_f32(float32x4_t(c), float32x4_t(a), float32x4_t(b)));
}
FIXDEM_INLINE Floats4 sqrt(Floats4 a) { return Floats4(vsqrtq_f32(float32x4_t(a))); }
FIXDEM_INLINE Floats4 abs(Floats4 a) { return Floats4(vabsq_f32(float32x4_t(a))); }
FIXDEM_INLINE unsigned bits(FloatMask4 mask) {
  return static_cast<unsigned>((mask[0] & 1) | (mask[1] & 2) | (mask[2] & 4) | (mask[3] & 8));
}
FIXDEM_INLINE bool any(FloatMask4 mask) { return vmaxvq_u32(uint32x4_t(mask)) != 0; }
FIXDEM_INLINE Floats4 narrow(Lanes2 low, Lanes2 high) {
  return Floats4(vcvt_high_f32_f64(vcvt_f32_f64(float64x2_t(low)), float64x2_t(high)));
}

}  // namespace fixdem
