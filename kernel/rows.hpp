// Rows of the particle arrays, looked up by number and turned into lanes, and back.
//
// What a contact needs of its two particles lies at random places. A particle's values are one padded row (4 numbers:
// a vector and a pad; 8 numbers: velocity, pad, r times angular velocity, pad; doubles or floats); W rows are loaded
// whole and transposed in registers (row_lanes.hpp, row_lanes_float.hpp), which costs a third of as many gathers. Force
// rows go the other way. Rows are named by offsets relative to the first row of the chunk, 8 times the row's number, so
// that no address needs a shift.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "row_lanes.hpp"
#include "row_lanes_float.hpp"

namespace fixdem {

/// Offset of a row among `rows` of them: 16 bits up to 8192 rows, which serves pipes up to 17 particles wide.
template <int rows>
using RowOffset = std::conditional_t<(rows <= 8192), std::uint16_t, std::uint32_t>;

/// The row of an array with rows of 4 or 8 doubles or floats, or more of them.
template <int Width, class T, class Offset>
FIXDEM_INLINE T* row_at(T* rows, Offset offset) {
  static_assert(Width % 4 == 0);
  using Byte = std::conditional_t<std::is_const_v<T>, const char, char>;
  return reinterpret_cast<T*>(reinterpret_cast<Byte*>(rows) + Width * sizeof(T) / 8 * std::size_t{offset});
}

/// Offsets as numbers in registers.
template <int Count>
struct Offsets {
  std::size_t value[Count];
};

/// Those from `from` on, four of 16 bits with one load; it may be read up to the next multiple of 4.
template <int Count, class Offset>
FIXDEM_INLINE Offsets<Count> load_offsets(const Offset* from) {
  Offsets<Count> offsets;
  if constexpr (sizeof(Offset) == 2) {
    for (int k = 0; k < Count; k += 4) {
      std::uint64_t four;
      __builtin_memcpy(&four, from + k, sizeof four);
      asm("" : "+r"(four));  // else the compiler takes it apart into loads again
      for (int j = 0; j < 4 && k + j < Count; ++j) offsets.value[k + j] = static_cast<std::uint16_t>(four >> 16 * j);
    }
  } else {
    for (int k = 0; k < Count; ++k) offsets.value[k] = from[k];
  }
  return offsets;
}

/// Whether a register holds two rows of 4.
template <int W, class T>
inline constexpr bool joins_rows = W == 8 && sizeof(T) == sizeof(double);

/// Eight numbers out of two rows of four.
template <class V, class T>
FIXDEM_INLINE V joined(const T* low, const T* high) {
  using Half = Lanes<4, T>;
  return __builtin_shufflevector(load<Half>(low), load<Half>(high), 0, 1, 2, 3, 4, 5, 6, 7);
}

/// Four columns of the rows `offset` of an array with rows of `Width`.
template <int W, int Width = 4, class T, class Offset>
FIXDEM_INLINE Vec4<Lanes<W, T>> load_columns(const T* rows, const Offset* offset) {
  using Rows = RowLanes<W, T>;
  if constexpr (joins_rows<W, T>)
    return Rows::columns([&](int k, int l) FIXDEM_INLINE_LAMBDA {
      return Rows::two(row_at<Width>(rows, offset[k]), row_at<Width>(rows, offset[l]));
    });
  else
    return Rows::columns([&](int k, int column) FIXDEM_INLINE_LAMBDA {
      return load<typename Rows::Part>(row_at<Width>(rows, offset[k]) + column);
    });
}

/// The other way.
template <int W, int Width = 4, class T, class Offset>
FIXDEM_INLINE void store_columns(T* rows, const Offset* offset, const Vec4<Lanes<W, T>>& a) {
  alignas(64) T row[W][4];
  RowLanes<W, T>::store_rows(row[0], a);
  for (int k = 0; k < W; ++k) __builtin_memcpy(row_at<Width>(rows, offset[k]), row[k], sizeof row[k]);
}

/// Vectors of the rows `offset` of an array with rows of `Width`.
template <int W, int Width = 4, class T, class Offset>
FIXDEM_INLINE Vec3<Lanes<W, T>> load_vectors(const T* rows, const Offset* offset) {
  const Vec4<Lanes<W, T>> a = load_columns<W, Width>(rows, offset);
  return {a.x, a.y, a.z};
}

/// Vectors a - b of two sets of rows of `Width`.
template <int W, int Width = 4, class T, class Offset>
FIXDEM_INLINE Vec3<Lanes<W, T>> load_differences(const T* rows_a, const Offset* a, const T* rows_b, const Offset* b) {
  using Rows = RowLanes<W, T>;
  using Part = typename Rows::Part;
  if constexpr (joins_rows<W, T>)
    return Rows::vectors([&](int k, int l) FIXDEM_INLINE_LAMBDA {
      return Rows::two(row_at<Width>(rows_a, a[k]), row_at<Width>(rows_a, a[l])) -
             Rows::two(row_at<Width>(rows_b, b[k]), row_at<Width>(rows_b, b[l]));
    });
  else
    return Rows::vectors([&](int k, int column) FIXDEM_INLINE_LAMBDA {
      return load<Part>(row_at<Width>(rows_a, a[k]) + column) - load<Part>(row_at<Width>(rows_b, b[k]) + column);
    });
}

/// By what row b counts beside row a for the relative motion of two spheres: translation less, but spins and pads more
/// (with several sizes pads hold what adds up: radii, or their inverses and those of masses).
template <class T>
alignas(64) inline constexpr T relative_sign[8] = {-1, -1, -1, 1, 1, 1, 1, 1};

/// Places a - b of two sets of rows of 4, and the sum of their pads.
template <int W, class T, class Offset>
FIXDEM_INLINE Vec4<Lanes<W, T>> load_separations(const T* rows_a, const Offset* a, const T* rows_b, const Offset* b) {
  using Rows = RowLanes<W, T>;
  using Part = typename Rows::Part;
  if constexpr (joins_rows<W, T>)
    return Rows::columns([&](int k, int l) FIXDEM_INLINE_LAMBDA {
      return fused(joined<Lanes<8, T>>(relative_sign<T>, relative_sign<T>),
                   Rows::two(row_at<4>(rows_b, b[k]), row_at<4>(rows_b, b[l])),
                   Rows::two(row_at<4>(rows_a, a[k]), row_at<4>(rows_a, a[l])));
    });
  else
    return Rows::columns([&](int k, int column) FIXDEM_INLINE_LAMBDA {
      return fused(load<Part>(relative_sign<T> + column), load<Part>(row_at<4>(rows_b, b[k]) + column),
                   load<Part>(row_at<4>(rows_a, a[k]) + column));
    });
}

/// Motion of the rows `offset` of an array with rows of 8.
template <int W, class T, class Offset>
FIXDEM_INLINE Motion<Lanes<W, T>> load_motion(const T* rows, const Offset* offset) {
  using Rows = RowLanes<W, T>;
  return Rows::motions([&](int k, int column) FIXDEM_INLINE_LAMBDA {
    return load<typename Rows::MotionPart>(row_at<8>(rows, offset[k]) + column);
  });
}

/// Velocity a - b and spin a + b of two sets of rows of 8: what the surface velocity of a contact is made of. With
/// `sums_pads` the sums of their pads, too; without them what is there instead does not count.
template <int W, bool sums_pads, class T, class Offset>
FIXDEM_INLINE Motion<Lanes<W, T>> load_motion_of_pairs(const T* rows_a, const Offset* a, const T* rows_b,
                                                       const Offset* b) {
  using Rows = RowLanes<W, T>;
  using Part = typename Rows::MotionPart;
  return Rows::motions([&](int k, int column) FIXDEM_INLINE_LAMBDA {
    const Part p = load<Part>(row_at<8>(rows_a, a[k]) + column), q = load<Part>(row_at<8>(rows_b, b[k]) + column);
    if constexpr (sums_pads)
      return fused(load<Part>(relative_sign<T> + column), q, p);
    else if constexpr (sizeof(Part) == 8 * sizeof(T))
      return fused(Part{-1, -1, -1, -1, 1, 1, 1, 1}, q, p);  // the whole row at once, rounded as a sum is
    else
      return column < 4 ? p - q : p + q;
  });
}

/// The same, and half of spin b - a: with rolling resistance. Three transpositions of 4 columns instead of one of 8.
/// With several sizes it is R*/r of each, which takes the pads of each: four transpositions.
template <int W, bool sums_pads, class T, class Offset>
FIXDEM_INLINE Motion<Lanes<W, T>> load_rolling_of_pairs(const T* rows_a, const Offset* a, const T* rows_b,
                                                        const Offset* b) {
  using V = Lanes<W, T>;
  if constexpr (sums_pads) {
    const Motion<V> p = load_motion<W>(rows_a, a), q = load_motion<W>(rows_b, b);
    Motion<V> m{};
    m.velocity = {p.velocity.x - q.velocity.x, p.velocity.y - q.velocity.y, p.velocity.z - q.velocity.z};
    m.spin = {p.spin.x + q.spin.x, p.spin.y + q.spin.y, p.spin.z + q.spin.z};
    m.inverse_mass = p.inverse_mass + q.inverse_mass, m.inverse_radius = p.inverse_radius + q.inverse_radius;
    m.owner_inverse_mass = p.inverse_mass, m.owner_inverse_radius = p.inverse_radius;
    const V own = p.inverse_radius / m.inverse_radius, others = splat<V>(1) - own;
    m.rolling = subtract_scaled(scale(others, q.spin), own, p.spin);
    return m;
  }
  const Vec3<V> p = load_vectors<W, 8>(rows_a + 4, a), q = load_vectors<W, 8>(rows_b + 4, b);
  Motion<V> m{load_differences<W, 8>(rows_a, a, rows_b, b), {p.x + q.x, p.y + q.y, p.z + q.z}};
  m.rolling = scale(splat<V>(0.5), Vec3<V>{q.x - p.x, q.y - p.y, q.z - p.z});
  return m;
}

}  // namespace fixdem
