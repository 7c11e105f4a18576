// The type of W lanes, and how many of them the machine computes on at once.
//
// `Lanes<W>` are W doubles, `Lanes<W, float>` W floats, as vector extensions of the compiler; one lane is the plain
// number. A register of 128 bits holds 2 doubles or 4 floats (SSE2, NEON), one of 256 bits 4 or 8 (AVX2), one of 512
// bits 8 or 16 (AVX-512). Lanes of all widths up to the widest of the build are available in one program. Eight lanes
// can also be had as pairs of 256-bit registers (FIXDEM_LANES=8 with AVX2): slower than four, but what is written for
// 512 bits can then be tested without AVX-512.
#pragma once

#include <type_traits>

/// Everything between loads and stores of the hot loop must be inlined, or lanes travel through memory: gcc 12 left the
/// law of a batch a function of its own, which cost a quarter of the time of a step.
/// Under a sanitizer speed does not matter, and a test file would take minutes to compile.
#if defined(__SANITIZE_ADDRESS__)
#define FIXDEM_INLINE inline
#else
#define FIXDEM_INLINE inline __attribute__((always_inline))
#endif

/// Doubles in the widest register of the build.
#if (defined(__AVX512F__) && defined(__AVX512DQ__)) || (FIXDEM_LANES + 0 == 8 && defined(__AVX2__) && defined(__FMA__))
#define FIXDEM_WIDEST_LANES 8
#elif defined(__AVX2__) && defined(__FMA__)
#define FIXDEM_WIDEST_LANES 4
#elif defined(__SSE2__) || defined(__aarch64__)
#define FIXDEM_WIDEST_LANES 2
#else
#define FIXDEM_WIDEST_LANES 1
#endif

namespace fixdem {

/// Lanes that the simulation uses: the widest, or what the build asks for.
#if defined(FIXDEM_LANES)
inline constexpr int native_lanes = FIXDEM_LANES;
#else
inline constexpr int native_lanes = FIXDEM_WIDEST_LANES;
#endif
static_assert(native_lanes == 1 || native_lanes == 2 || native_lanes == 4 || native_lanes == 8,
              "fixdem: FIXDEM_LANES must be 1, 2, 4 or 8");
static_assert(native_lanes <= FIXDEM_WIDEST_LANES,
              "fixdem: FIXDEM_LANES is more than the instruction set has: 2 needs SSE2 or NEON, 4 and 8 need "
              "AVX2 with FMA; choose another -march or fewer lanes");

namespace detail {
template <int W, class T>
struct LanesOf {
  typedef T type __attribute__((vector_size(sizeof(T) * W)));
};
template <class T>
struct LanesOf<1, T> {
  using type = T;
};

template <class V, bool is_number = std::is_arithmetic_v<V>>
struct ElementOf {
  using type = V;
};
template <class V>
struct ElementOf<V, false> {
  using type = std::remove_cvref_t<decltype(V{}[0])>;
};
}  // namespace detail

template <int W, class T = double>
using Lanes = typename detail::LanesOf<W, T>::type;

/// double or float: what the lanes of V are.
template <class V>
using Element = typename detail::ElementOf<V>::type;

}  // namespace fixdem
