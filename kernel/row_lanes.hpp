// Transposition between W rows of doubles and lanes.
//
// `columns(row)` takes rows of 4, `motions(row)` rows of 8; `row(k, column)` yields the part of
// row k that begins at that column, and `Part` (`MotionPart`) says how much of it: what fits a register, or one number
// for one lane. `store_rows` writes row k from lane k. One specialisation for each width, present only where the
// instruction set has it.
#pragma once

#include "lanes.hpp"

/// A lambda that is part of a hot loop.
#define FIXDEM_INLINE_LAMBDA __attribute__((always_inline))

namespace fixdem {

/// Translation and rotation of W particles, or their difference and sum.
template <class V>
struct Motion {
  Vec3<V> velocity;  ///< m/s
  Vec3<V> spin;      ///< radius times angular velocity, m/s
  // With several sizes the pads (particles.hpp): m_0/m and r_0/r, sums over both bodies; with rolling the owner's, too.
  V inverse_mass{}, inverse_radius{};
  Vec3<V> rolling{};  ///< with rolling resistance: R*/r times spin, partner's less own; n x this is eq. (47)
  V owner_inverse_mass{}, owner_inverse_radius{};
};

template <int W, class T = double>
struct RowLanes;

/// Rows of 4 that are a vector and a pad.
template <int W, class T>
struct VectorRows {
  template <class Row>
  static FIXDEM_INLINE Vec3<Lanes<W, T>> vectors(Row&& row) {
    const Vec4<Lanes<W, T>> c = RowLanes<W, T>::columns(row);
    return {c.x, c.y, c.z};
  }
};

/// Motions where a row of 8 takes more than one register: two halves, each transposed as a row of 4.
template <int W, class T>
struct MotionsByHalves : VectorRows<W, T> {
  template <class Row>
  static FIXDEM_INLINE Motion<Lanes<W, T>> motions(Row&& row) {
    using Rows = RowLanes<W, T>;
    const auto v = Rows::columns(row);
    const auto s = Rows::columns([&](int k, int column) FIXDEM_INLINE_LAMBDA { return row(k, column + 4); });
    return {{v.x, v.y, v.z}, {s.x, s.y, s.z}, v.w, s.w};
  }
};

template <class T>
struct RowLanes<1, T> : MotionsByHalves<1, T> {
  using Part = T;
  using MotionPart = T;
  template <class Row>
  static FIXDEM_INLINE Vec4<T> columns(Row&& row) {
    return {row(0, 0), row(0, 1), row(0, 2), row(0, 3)};
  }
  static FIXDEM_INLINE void store_rows(T* row, const Vec4<T>& a) {
    row[0] = a.x, row[1] = a.y, row[2] = a.z, row[3] = a.w;
  }
  static FIXDEM_INLINE void store_rows(T* rows, const Vec4<T>& a, const Vec4<T>& b) {
    store_rows(rows, a);
    store_rows(rows + 4, b);
  }
};

#if FIXDEM_WIDEST_LANES >= 2
template <>
struct RowLanes<2> : MotionsByHalves<2, double> {
  using Part = Lanes2;
  using MotionPart = Lanes2;
  template <class Row>
  static FIXDEM_INLINE Vec4<Lanes2> columns(Row&& row) {
    const Lanes2 xy0 = row(0, 0), xy1 = row(1, 0), zw0 = row(0, 2), zw1 = row(1, 2);
    return {__builtin_shufflevector(xy0, xy1, 0, 2), __builtin_shufflevector(xy0, xy1, 1, 3),
            __builtin_shufflevector(zw0, zw1, 0, 2), __builtin_shufflevector(zw0, zw1, 1, 3)};
  }
  static FIXDEM_INLINE void store_rows(double* rows, const Vec4<Lanes2>& a, int stride = 4) {
    store(rows, __builtin_shufflevector(a.x, a.y, 0, 2));
    store(rows + 2, __builtin_shufflevector(a.z, a.w, 0, 2));
    store(rows + stride, __builtin_shufflevector(a.x, a.y, 1, 3));
    store(rows + stride + 2, __builtin_shufflevector(a.z, a.w, 1, 3));
  }
  static FIXDEM_INLINE void store_rows(double* rows, const Vec4<Lanes2>& a, const Vec4<Lanes2>& b) {
    store_rows(rows, a, 8);
    store_rows(rows + 4, b, 8);
  }
};
#endif

#if FIXDEM_WIDEST_LANES >= 4
template <>
struct RowLanes<4> : MotionsByHalves<4, double> {
  using Part = Lanes4;
  using MotionPart = Lanes4;
  template <class Row>
  static FIXDEM_INLINE Vec4<Lanes4> columns(Row&& row) {
    const Lanes4 r0 = row(0, 0), r1 = row(1, 0), r2 = row(2, 0), r3 = row(3, 0);
    const Lanes4 low01 = __builtin_shufflevector(r0, r1, 0, 4, 2, 6);  // x0 x1 z0 z1
    const Lanes4 low23 = __builtin_shufflevector(r2, r3, 0, 4, 2, 6);
    const Lanes4 high01 = __builtin_shufflevector(r0, r1, 1, 5, 3, 7);  // y0 y1 w0 w1
    const Lanes4 high23 = __builtin_shufflevector(r2, r3, 1, 5, 3, 7);
    return {__builtin_shufflevector(low01, low23, 0, 1, 4, 5), __builtin_shufflevector(high01, high23, 0, 1, 4, 5),
            __builtin_shufflevector(low01, low23, 2, 3, 6, 7), __builtin_shufflevector(high01, high23, 2, 3, 6, 7)};
  }
  static FIXDEM_INLINE void store_rows(double* rows, const Vec4<Lanes4>& a, int stride = 4) {
    const Lanes4 low = __builtin_shufflevector(a.x, a.y, 0, 4, 2, 6);   // x0 y0 x2 y2
    const Lanes4 high = __builtin_shufflevector(a.x, a.y, 1, 5, 3, 7);  // x1 y1 x3 y3
    const Lanes4 even = __builtin_shufflevector(a.z, a.w, 0, 4, 2, 6);
    const Lanes4 odd = __builtin_shufflevector(a.z, a.w, 1, 5, 3, 7);
    store(rows, __builtin_shufflevector(low, even, 0, 1, 4, 5));
    store(rows + stride, __builtin_shufflevector(high, odd, 0, 1, 4, 5));
    store(rows + 2 * stride, __builtin_shufflevector(low, even, 2, 3, 6, 7));
    store(rows + 3 * stride, __builtin_shufflevector(high, odd, 2, 3, 6, 7));
  }
  static FIXDEM_INLINE void store_rows(double* rows, const Vec4<Lanes4>& a, const Vec4<Lanes4>& b) {
    store_rows(rows, a, 8);
    store_rows(rows + 4, b, 8);
  }
};
#endif

#if FIXDEM_WIDEST_LANES >= 8
template <>
struct RowLanes<8> : VectorRows<8, double> {
  using Part = Lanes4;
  using MotionPart = Lanes8;
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

  /// Two rows of 4 side by side.
  static FIXDEM_INLINE Lanes8 two(const double* a, const double* b) { return join(load<Lanes4>(a), load<Lanes4>(b)); }
  /// Eight rows of 4. `rows(k, l)`: rows k and l side by side.
  template <class TwoRows>
  static FIXDEM_INLINE Vec4<Lanes8> columns(TwoRows&& rows) {
    const Lanes8 r02 = rows(0, 2), r13 = rows(1, 3), r46 = rows(4, 6), r57 = rows(5, 7);
    const Lanes8 low_a = low_of_pairs(r02, r13), low_b = low_of_pairs(r46, r57);  // x0 x1 z0 z1 x2 x3 z2 z3
    const Lanes8 high_a = high_of_pairs(r02, r13), high_b = high_of_pairs(r46, r57);
    return {even_blocks(low_a, low_b), even_blocks(high_a, high_b), odd_blocks(low_a, low_b),
            odd_blocks(high_a, high_b)};
  }

  /// Eight rows of 8 into their columns.
  template <class Row>
  static FIXDEM_INLINE Motion<Lanes8> motions(Row&& row) {
    const Lanes8 r0 = row(0, 0), r1 = row(1, 0), r2 = row(2, 0), r3 = row(3, 0), r4 = row(4, 0), r5 = row(5, 0),
                 r6 = row(6, 0), r7 = row(7, 0);
    const Lanes8 low01 = low_of_pairs(r0, r1), low23 = low_of_pairs(r2, r3);
    const Lanes8 low45 = low_of_pairs(r4, r5), low67 = low_of_pairs(r6, r7);
    const Lanes8 x_a = even_blocks(low01, low23), x_b = even_blocks(low45, low67);
    const Lanes8 z_a = odd_blocks(low01, low23), z_b = odd_blocks(low45, low67);
    const Lanes8 high01 = high_of_pairs(r0, r1), high23 = high_of_pairs(r2, r3);
    const Lanes8 high45 = high_of_pairs(r4, r5), high67 = high_of_pairs(r6, r7);
    const Lanes8 y_a = even_blocks(high01, high23), y_b = even_blocks(high45, high67);
    const Lanes8 w_a = odd_blocks(high01, high23), w_b = odd_blocks(high45, high67);
    return {{even_blocks(x_a, x_b), even_blocks(y_a, y_b), even_blocks(z_a, z_b)},
            {odd_blocks(x_a, x_b), odd_blocks(y_a, y_b), odd_blocks(z_a, z_b)},
            even_blocks(w_a, w_b),
            odd_blocks(w_a, w_b)};
  }

  static FIXDEM_INLINE void store_rows(double* rows, const Vec4<Lanes8>& a) {
    const Lanes8 low = low_of_pairs(a.x, a.y), high = high_of_pairs(a.x, a.y);  // x0 y0 x2 y2 .. | x1 y1 x3 y3 ..
    const Lanes8 low_z = low_of_pairs(a.z, a.w), high_z = high_of_pairs(a.z, a.w);
    const Lanes8 rows_04 = even_blocks(low, low_z), rows_26 = odd_blocks(low, low_z);
    const Lanes8 rows_15 = even_blocks(high, high_z), rows_37 = odd_blocks(high, high_z);
    store(rows, even_blocks(rows_04, rows_15));
    store(rows + 8, even_blocks(rows_26, rows_37));
    store(rows + 16, odd_blocks(rows_04, rows_15));
    store(rows + 24, odd_blocks(rows_26, rows_37));
  }

  static FIXDEM_INLINE void store_rows(double* rows, const Vec4<Lanes8>& a, const Vec4<Lanes8>& b) {
    const auto half = [](const Vec4<Lanes8>& v, Lanes8& r04, Lanes8& r26, Lanes8& r15, Lanes8& r37) {
      const Lanes8 low = low_of_pairs(v.x, v.y), low_z = low_of_pairs(v.z, v.w);
      const Lanes8 high = high_of_pairs(v.x, v.y), high_z = high_of_pairs(v.z, v.w);
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

}  // namespace fixdem
