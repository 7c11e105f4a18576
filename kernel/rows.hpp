// Rows of the particle arrays, looked up by number and turned into lanes, and back.
//
// What a contact needs of its two particles lies at random places. A particle's values are one padded row (4 doubles:
// a vector and a pad; 8 doubles: velocity, pad, r times angular velocity, pad); W rows are loaded whole and transposed
// in registers, which costs a third of as many gathers. Force rows go the other way. Rows are named by offsets relative
// to the first row of the chunk, 8 times the row's number, so that no address needs a shift.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "lanes.hpp"

namespace fixdem {

/// Offset of a row among `rows` of them: 16 bits up to 8192 rows, which serves pipes up to 17 particles wide.
template <int rows>
using RowOffset = std::conditional_t<(rows <= 8192), std::uint16_t, std::uint32_t>;

/// The row of an array with rows of 4 or 8 doubles.
template <int Width, class Offset>
FIXDEM_INLINE const double* row_at(const double* rows, Offset offset) {
  static_assert(Width == 4 || Width == 8);
  return reinterpret_cast<const double*>(reinterpret_cast<const char*>(rows) +
                                         (Width == 8 ? 8 : 4) * std::size_t{offset});
}

/// Translation and rotation of W particles, or their difference and sum.
template <class V>
struct Motion {
  Vec3<V> velocity;  ///< m/s
  Vec3<V> spin;      ///< radius times angular velocity, m/s
};

/// Transposition between W rows and lanes; `row(k)` yields row k. One specialisation for each width.
template <int W>
struct RowLanes;

template <>
struct RowLanes<1> {
  static FIXDEM_INLINE void store_row(double* row, const Vec3<double>& a) {
    row[0] = a.x, row[1] = a.y, row[2] = a.z, row[3] = 0;
  }
  static FIXDEM_INLINE void store_rows(double* rows, const Vec3<double>& a) { store_row(rows, a); }
  static FIXDEM_INLINE void store_rows(double* rows, const Vec3<double>& a, const Vec3<double>& b) {
    store_row(rows, a);
    store_row(rows + 4, b);
  }
};

#if defined(__AVX2__) && defined(__FMA__)
template <>
struct RowLanes<4> {
  /// Four rows of 4 into three vectors; the pads are dropped.
  template <class Row>
  static FIXDEM_INLINE Vec3<Lanes4> vectors(Row&& row) {
    const Lanes4 r0 = row(0), r1 = row(1), r2 = row(2), r3 = row(3);
    const Lanes4 low01 = __builtin_shufflevector(r0, r1, 0, 4, 2, 6);  // x0 x1 z0 z1
    const Lanes4 low23 = __builtin_shufflevector(r2, r3, 0, 4, 2, 6);
    const Lanes4 high01 = __builtin_shufflevector(r0, r1, 1, 5, 3, 7);  // y0 y1, pads
    const Lanes4 high23 = __builtin_shufflevector(r2, r3, 1, 5, 3, 7);
    return {__builtin_shufflevector(low01, low23, 0, 1, 4, 5), __builtin_shufflevector(high01, high23, 0, 1, 4, 5),
            __builtin_shufflevector(low01, low23, 2, 3, 6, 7)};
  }
  static FIXDEM_INLINE void store_rows(double* rows, const Vec3<Lanes4>& a, int stride = 4) {
    const Lanes4 low = __builtin_shufflevector(a.x, a.y, 0, 4, 2, 6);   // x0 y0 x2 y2
    const Lanes4 high = __builtin_shufflevector(a.x, a.y, 1, 5, 3, 7);  // x1 y1 x3 y3
    const Lanes4 even = __builtin_shufflevector(a.z, Lanes4{}, 0, 4, 2, 6);
    const Lanes4 odd = __builtin_shufflevector(a.z, Lanes4{}, 1, 5, 3, 7);
    store(rows, __builtin_shufflevector(low, even, 0, 1, 4, 5));
    store(rows + stride, __builtin_shufflevector(high, odd, 0, 1, 4, 5));
    store(rows + 2 * stride, __builtin_shufflevector(low, even, 2, 3, 6, 7));
    store(rows + 3 * stride, __builtin_shufflevector(high, odd, 2, 3, 6, 7));
  }
  static FIXDEM_INLINE void store_rows(double* rows, const Vec3<Lanes4>& a, const Vec3<Lanes4>& b) {
    store_rows(rows, a, 8);
    store_rows(rows + 4, b, 8);
  }
};
#endif

#if defined(__AVX512F__) && defined(__AVX512DQ__)
template <>
struct RowLanes<8> {
  static FIXDEM_INLINE Lanes8 low_of_pairs(Lanes8 a, Lanes8 b) {
    return __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14);
  }
  static FIXDEM_INLINE Lanes8 high_of_pairs(Lanes8 a, Lanes8 b) {
    return __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
  }
  static FIXDEM_INLINE Lanes8 even_blocks(Lanes8 a, Lanes8 b) {
    return __builtin_shufflevector(a, b, 0, 1, 4, 5, 8, 9, 12, 13);
  }
  static FIXDEM_INLINE Lanes8 odd_blocks(Lanes8 a, Lanes8 b) {
    return __builtin_shufflevector(a, b, 2, 3, 6, 7, 10, 11, 14, 15);
  }
  static FIXDEM_INLINE Lanes8 join(Lanes4 a, Lanes4 b) { return __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7); }

  /// Eight rows of 4 into three vectors; the pads are dropped.
  template <class Row>
  static FIXDEM_INLINE Vec3<Lanes8> vectors(Row&& row) {
    const Lanes8 r02 = join(row(0), row(2)), r13 = join(row(1), row(3));
    const Lanes8 r46 = join(row(4), row(6)), r57 = join(row(5), row(7));
    const Lanes8 low_a = low_of_pairs(r02, r13), low_b = low_of_pairs(r46, r57);  // x0 x1 z0 z1 x2 x3 z2 z3
    return {even_blocks(low_a, low_b), even_blocks(high_of_pairs(r02, r13), high_of_pairs(r46, r57)),
            odd_blocks(low_a, low_b)};
  }

  /// Eight rows of 8 into six vectors; the pads (columns 3 and 7) are dropped.
  template <class Row>
  static FIXDEM_INLINE Motion<Lanes8> motions(Row&& row) {
    const Lanes8 r0 = row(0), r1 = row(1), r2 = row(2), r3 = row(3), r4 = row(4), r5 = row(5), r6 = row(6), r7 = row(7);
    const Lanes8 low01 = low_of_pairs(r0, r1), low23 = low_of_pairs(r2, r3);
    const Lanes8 low45 = low_of_pairs(r4, r5), low67 = low_of_pairs(r6, r7);
    const Lanes8 x_a = even_blocks(low01, low23), x_b = even_blocks(low45, low67);
    const Lanes8 z_a = odd_blocks(low01, low23), z_b = odd_blocks(low45, low67);
    const Lanes8 y_a = even_blocks(high_of_pairs(r0, r1), high_of_pairs(r2, r3));
    const Lanes8 y_b = even_blocks(high_of_pairs(r4, r5), high_of_pairs(r6, r7));
    return {{even_blocks(x_a, x_b), even_blocks(y_a, y_b), even_blocks(z_a, z_b)},
            {odd_blocks(x_a, x_b), odd_blocks(y_a, y_b), odd_blocks(z_a, z_b)}};
  }

  static FIXDEM_INLINE void store_rows(double* rows, const Vec3<Lanes8>& a) {
    const Lanes8 low = low_of_pairs(a.x, a.y), high = high_of_pairs(a.x, a.y);  // x0 y0 x2 y2 .. | x1 y1 x3 y3 ..
    const Lanes8 low_z = low_of_pairs(a.z, Lanes8{}), high_z = high_of_pairs(a.z, Lanes8{});
    const Lanes8 rows_04 = even_blocks(low, low_z), rows_26 = odd_blocks(low, low_z);
    const Lanes8 rows_15 = even_blocks(high, high_z), rows_37 = odd_blocks(high, high_z);
    store(rows, even_blocks(rows_04, rows_15));
    store(rows + 8, even_blocks(rows_26, rows_37));
    store(rows + 16, odd_blocks(rows_04, rows_15));
    store(rows + 24, odd_blocks(rows_26, rows_37));
  }

  static FIXDEM_INLINE void store_rows(double* rows, const Vec3<Lanes8>& a, const Vec3<Lanes8>& b) {
    const auto half = [](const Vec3<Lanes8>& v, Lanes8& r04, Lanes8& r26, Lanes8& r15, Lanes8& r37) {
      const Lanes8 low = low_of_pairs(v.x, v.y), low_z = low_of_pairs(v.z, Lanes8{});
      const Lanes8 high = high_of_pairs(v.x, v.y), high_z = high_of_pairs(v.z, Lanes8{});
      r04 = even_blocks(low, low_z), r26 = odd_blocks(low, low_z);
      r15 = even_blocks(high, high_z), r37 = odd_blocks(high, high_z);
    };
    Lanes8 a04, a26, a15, a37, b04, b26, b15, b37;
    half(a, a04, a26, a15, a37);
    half(b, b04, b26, b15, b37);
    store(rows, even_blocks(a04, b04));
    store(rows + 8, even_blocks(a15, b15));
    store(rows + 16, even_blocks(a26, b26));
    store(rows + 24, even_blocks(a37, b37));
    store(rows + 32, odd_blocks(a04, b04));
    store(rows + 40, odd_blocks(a15, b15));
    store(rows + 48, odd_blocks(a26, b26));
    store(rows + 56, odd_blocks(a37, b37));
  }
};
#endif

/// Vectors of the rows `offset` of an array with rows of 4.
template <int W, class Offset>
FIXDEM_INLINE Vec3<Lanes<W>> load_vectors(const double* rows, const Offset* offset) {
  if constexpr (W == 1) {
    const double* r = row_at<4>(rows, offset[0]);
    return {r[0], r[1], r[2]};
  } else {
    return RowLanes<W>::vectors([&](int k) { return load<Lanes<4>>(row_at<4>(rows, offset[k])); });
  }
}

/// Vectors a - b of two sets of rows of 4.
template <int W, class Offset>
FIXDEM_INLINE Vec3<Lanes<W>> load_differences(const double* rows_a, const Offset* a, const double* rows_b,
                                              const Offset* b) {
  if constexpr (W == 1) {
    const double *p = row_at<4>(rows_a, a[0]), *q = row_at<4>(rows_b, b[0]);
    return {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
  } else {
    return RowLanes<W>::vectors(
        [&](int k) { return load<Lanes<4>>(row_at<4>(rows_a, a[k])) - load<Lanes<4>>(row_at<4>(rows_b, b[k])); });
  }
}

/// Motion of the rows `offset` of an array with rows of 8.
template <int W, class Offset>
FIXDEM_INLINE Motion<Lanes<W>> load_motion(const double* rows, const Offset* offset) {
  if constexpr (W == 8) {
    return RowLanes<W>::motions([&](int k) { return load<Lanes<W>>(row_at<8>(rows, offset[k])); });
  } else if constexpr (W == 4) {
    return {RowLanes<W>::vectors([&](int k) { return load<Lanes<W>>(row_at<8>(rows, offset[k])); }),
            RowLanes<W>::vectors([&](int k) { return load<Lanes<W>>(row_at<8>(rows, offset[k]) + 4); })};
  } else {
    const double* r = row_at<8>(rows, offset[0]);
    return {{r[0], r[1], r[2]}, {r[4], r[5], r[6]}};
  }
}

/// Velocity a - b and spin a + b of two sets of rows of 8: what the surface velocity of a contact is made of.
template <int W, class Offset>
FIXDEM_INLINE Motion<Lanes<W>> load_motion_of_pairs(const double* rows_a, const Offset* a, const double* rows_b,
                                                    const Offset* b) {
  using V = Lanes<W>;
  if constexpr (W == 8) {
    const V sign{-1, -1, -1, -1, 1, 1, 1, 1};
    return RowLanes<W>::motions(
        [&](int k) { return fused(sign, load<V>(row_at<8>(rows_b, b[k])), load<V>(row_at<8>(rows_a, a[k]))); });
  } else if constexpr (W == 4) {
    return {RowLanes<W>::vectors(
                [&](int k) { return load<V>(row_at<8>(rows_a, a[k])) - load<V>(row_at<8>(rows_b, b[k])); }),
            RowLanes<W>::vectors(
                [&](int k) { return load<V>(row_at<8>(rows_a, a[k]) + 4) + load<V>(row_at<8>(rows_b, b[k]) + 4); })};
  } else {
    const double *p = row_at<8>(rows_a, a[0]), *q = row_at<8>(rows_b, b[0]);
    return {{p[0] - q[0], p[1] - q[1], p[2] - q[2]}, {p[4] + q[4], p[5] + q[5], p[6] + q[6]}};
  }
}

}  // namespace fixdem
