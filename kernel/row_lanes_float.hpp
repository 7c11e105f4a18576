// Transposition between W rows of floats and lanes, for mixed precision; see row_lanes.hpp.
//
// A row of 4 floats fills one block of 128 bits, so W rows are W / 4 squares of 4 x 4 numbers that are transposed side
// by side, one in each block of the registers: `square` puts rows k, k + 4, k + 8, k + 12 into the blocks of register
// k, and two rounds of interleaving make x, y and z in the order of the rows. Rows of 8 are two such squares, one for
// the velocities and one for the spins.
#pragma once

#include "row_lanes.hpp"

namespace fixdem {

#if FIXDEM_WIDEST_LANES >= 2
namespace detail {
/// The numbers 0 .. W - 1 as a list of template arguments.
template <int... lane>
struct LaneList {};
template <int W, int... lane>
struct LaneListOf : LaneListOf<W - 1, W - 1, lane...> {};
template <int... lane>
struct LaneListOf<0, lane...> {
  using type = LaneList<lane...>;
};
}  // namespace detail

/// Operations within blocks of four floats, the same in every block.
template <int W>
struct FloatBlocks {
  using V = Lanes<W, float>;
  using Lane = typename detail::LaneListOf<W>::type;

  /// a[first] b[first] a[first + 1] b[first + 1]
  template <int first, int... lane>
  static FIXDEM_INLINE V interleave(V a, V b, detail::LaneList<lane...>) {
    return __builtin_shufflevector(a, b, (lane % 2 * W + lane / 4 * 4 + first + lane % 4 / 2)...);
  }
  /// a[first] a[first + 1] b[first] b[first + 1]
  template <int first, int... lane>
  static FIXDEM_INLINE V join(V a, V b, detail::LaneList<lane...>) {
    return __builtin_shufflevector(a, b, (lane % 4 / 2 * W + lane / 4 * 4 + first + lane % 2)...);
  }
  static FIXDEM_INLINE V low(V a, V b) { return interleave<0>(a, b, Lane{}); }
  static FIXDEM_INLINE V high(V a, V b) { return interleave<2>(a, b, Lane{}); }

  /// Blocks of rows x y z w into x, y, z and w.
  static FIXDEM_INLINE Vec4<V> columns(V r0, V r1, V r2, V r3) {
    const V xy01 = low(r0, r1), xy23 = low(r2, r3), zw01 = high(r0, r1), zw23 = high(r2, r3);
    return {join<0>(xy01, xy23, Lane{}), join<2>(xy01, xy23, Lane{}), join<0>(zw01, zw23, Lane{}),
            join<2>(zw01, zw23, Lane{})};
  }
  /// The other way; register k holds row k in its first block, row k + 4 in the second.
  struct Square {
    V row[4];
  };
  static FIXDEM_INLINE Square rows(const Vec4<V>& a) {
    const V xy01 = low(a.x, a.y), xy23 = high(a.x, a.y), zw01 = low(a.z, a.w), zw23 = high(a.z, a.w);
    return {{join<0>(xy01, zw01, Lane{}), join<2>(xy01, zw01, Lane{}), join<0>(xy23, zw23, Lane{}),
             join<2>(xy23, zw23, Lane{})}};
  }
};

template <>
struct RowLanes<4, float> : MotionsByHalves<4, float> {
  using Part = Floats4;
  using MotionPart = Floats4;
  template <class Row>
  static FIXDEM_INLINE Vec4<Floats4> columns(Row&& row) {
    return FloatBlocks<4>::columns(row(0, 0), row(1, 0), row(2, 0), row(3, 0));
  }
  static FIXDEM_INLINE void store_rows(float* rows, const Vec4<Floats4>& a, int stride = 4) {
    const auto square = FloatBlocks<4>::rows(a);
    for (int k = 0; k < 4; ++k) store(rows + k * stride, square.row[k]);
  }
  static FIXDEM_INLINE void store_rows(float* rows, const Vec4<Floats4>& a, const Vec4<Floats4>& b) {
    store_rows(rows, a, 8);
    store_rows(rows + 4, b, 8);
  }
};
#endif

#if FIXDEM_WIDEST_LANES >= 4
template <>
struct RowLanes<8, float> : VectorRows<8, float> {
  using Part = Floats4;
  using MotionPart = Floats8;
  static FIXDEM_INLINE Floats8 pair(Floats4 a, Floats4 b) {
    return __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7);
  }
  static FIXDEM_INLINE Floats8 first_blocks(Floats8 a, Floats8 b) {
    return __builtin_shufflevector(a, b, 0, 1, 2, 3, 8, 9, 10, 11);
  }
  static FIXDEM_INLINE Floats8 second_blocks(Floats8 a, Floats8 b) {
    return __builtin_shufflevector(a, b, 4, 5, 6, 7, 12, 13, 14, 15);
  }

  template <class Row>
  static FIXDEM_INLINE Vec4<Floats8> columns(Row&& row) {
    return FloatBlocks<8>::columns(pair(row(0, 0), row(4, 0)), pair(row(1, 0), row(5, 0)), pair(row(2, 0), row(6, 0)),
                                   pair(row(3, 0), row(7, 0)));
  }
  /// A row is velocity in the first block and spin in the second, so each square below holds both, of four rows.
  template <class Row>
  static FIXDEM_INLINE Motion<Floats8> motions(Row&& row) {
    const Vec4<Floats8> a = FloatBlocks<8>::columns(row(0, 0), row(1, 0), row(2, 0), row(3, 0));
    const Vec4<Floats8> b = FloatBlocks<8>::columns(row(4, 0), row(5, 0), row(6, 0), row(7, 0));
    return {{first_blocks(a.x, b.x), first_blocks(a.y, b.y), first_blocks(a.z, b.z)},
            {second_blocks(a.x, b.x), second_blocks(a.y, b.y), second_blocks(a.z, b.z)},
            first_blocks(a.w, b.w),
            second_blocks(a.w, b.w)};
  }
  static FIXDEM_INLINE void store_rows(float* rows, const Vec4<Floats8>& a) {
    const auto square = FloatBlocks<8>::rows(a);
    for (int k = 0; k < 4; k += 2) {
      store(rows + 4 * k, first_blocks(square.row[k], square.row[k + 1]));
      store(rows + 4 * k + 16, second_blocks(square.row[k], square.row[k + 1]));
    }
  }
  static FIXDEM_INLINE void store_rows(float* rows, const Vec4<Floats8>& a, const Vec4<Floats8>& b) {
    const auto left = FloatBlocks<8>::rows(a), right = FloatBlocks<8>::rows(b);
    for (int k = 0; k < 4; ++k) {
      store(rows + 8 * k, first_blocks(left.row[k], right.row[k]));
      store(rows + 8 * k + 32, second_blocks(left.row[k], right.row[k]));
    }
  }
};
#endif

#if FIXDEM_WIDEST_LANES >= 8
template <>
struct RowLanes<16, float> : VectorRows<16, float> {
  using Part = Floats4;
  using MotionPart = Floats8;
  static FIXDEM_INLINE Floats16 pair(Floats8 a, Floats8 b) {
    return __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  }
  /// Blocks i, j of a, then of b.
  template <int i, int j>
  static FIXDEM_INLINE Floats16 blocks(Floats16 a, Floats16 b) {
    return __builtin_shufflevector(a, b, 4 * i, 4 * i + 1, 4 * i + 2, 4 * i + 3, 4 * j, 4 * j + 1, 4 * j + 2, 4 * j + 3,
                                   16 + 4 * i, 17 + 4 * i, 18 + 4 * i, 19 + 4 * i, 16 + 4 * j, 17 + 4 * j, 18 + 4 * j,
                                   19 + 4 * j);
  }

  template <class Row>
  static FIXDEM_INLINE Vec4<Floats16> columns(Row&& row) {
    const auto four = [&](int k) FIXDEM_INLINE_LAMBDA {
      using Rows8 = RowLanes<8, float>;
      return pair(Rows8::pair(row(k, 0), row(k + 4, 0)), Rows8::pair(row(k + 8, 0), row(k + 12, 0)));
    };
    return FloatBlocks<16>::columns(four(0), four(1), four(2), four(3));
  }
  /// The first square holds velocities and spins of rows 0 to 7, the second those of rows 8 to 15.
  template <class Row>
  static FIXDEM_INLINE Motion<Floats16> motions(Row&& row) {
    const auto two = [&](int k) FIXDEM_INLINE_LAMBDA { return pair(row(k, 0), row(k + 4, 0)); };
    const Vec4<Floats16> a = FloatBlocks<16>::columns(two(0), two(1), two(2), two(3));
    const Vec4<Floats16> b = FloatBlocks<16>::columns(two(8), two(9), two(10), two(11));
    return {{blocks<0, 2>(a.x, b.x), blocks<0, 2>(a.y, b.y), blocks<0, 2>(a.z, b.z)},
            {blocks<1, 3>(a.x, b.x), blocks<1, 3>(a.y, b.y), blocks<1, 3>(a.z, b.z)},
            blocks<0, 2>(a.w, b.w),
            blocks<1, 3>(a.w, b.w)};
  }
  /// Rows 4 b to 4 b + 3 are block b of the four registers.
  static FIXDEM_INLINE void store_rows(float* rows, const Vec4<Floats16>& a) {
    const auto square = FloatBlocks<16>::rows(a);
    const Floats16 even01 = blocks<0, 2>(square.row[0], square.row[1]),
                   odd01 = blocks<1, 3>(square.row[0], square.row[1]);
    const Floats16 even23 = blocks<0, 2>(square.row[2], square.row[3]),
                   odd23 = blocks<1, 3>(square.row[2], square.row[3]);
    store(rows, blocks<0, 2>(even01, even23));
    store(rows + 16, blocks<0, 2>(odd01, odd23));
    store(rows + 32, blocks<1, 3>(even01, even23));
    store(rows + 48, blocks<1, 3>(odd01, odd23));
  }
  static FIXDEM_INLINE void store_rows(float* rows, const Vec4<Floats16>& a, const Vec4<Floats16>& b) {
    const auto left = FloatBlocks<16>::rows(a), right = FloatBlocks<16>::rows(b);
    for (int k = 0; k < 4; k += 2) {
      // Blocks of `first`: left and right halves of rows k and k + 8; of `second`: of rows k + 1 and k + 9; and so on.
      const Floats16 first = alternate<0>(left.row[k], right.row[k]);
      const Floats16 second = alternate<0>(left.row[k + 1], right.row[k + 1]);
      const Floats16 first_odd = alternate<1>(left.row[k], right.row[k]);
      const Floats16 second_odd = alternate<1>(left.row[k + 1], right.row[k + 1]);
      store(rows + 8 * k, blocks<0, 1>(first, second));
      store(rows + 8 * (k + 4), blocks<0, 1>(first_odd, second_odd));
      store(rows + 8 * (k + 8), blocks<2, 3>(first, second));
      store(rows + 8 * (k + 12), blocks<2, 3>(first_odd, second_odd));
    }
  }

 private:
  /// Block i of a and of b, then block i + 2 of a and of b.
  template <int i>
  static FIXDEM_INLINE Floats16 alternate(Floats16 a, Floats16 b) {
    constexpr int p = 4 * i, q = 16 + 4 * i;
    return __builtin_shufflevector(a, b, p, p + 1, p + 2, p + 3, q, q + 1, q + 2, q + 3, p + 8, p + 9, p + 10, p + 11,
                                   q + 8, q + 9, q + 10, q + 11);
  }
};
#endif

}  // namespace fixdem
