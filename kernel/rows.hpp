// Rows of the particle arrays, looked up by number and turned into lanes, and back.
//
// What a contact needs of its two particles lies at random places. A particle's values are one padded row (4 doubles:
// a vector and a pad; 8 doubles: velocity, pad, r times angular velocity, pad); W rows are loaded whole and transposed
// in registers, which costs a third of as many gathers. Force rows go the other way. Row numbers are 16 bits, relative
// to the first row of the chunk.
#pragma once

#include <cstdint>

#include "lanes.hpp"

namespace fixdem {

using RowNumber = std::uint16_t;

/// Translation and rotation of W particles, or their difference and sum.
template <class V>
struct Motion {
  Vec3<V> velocity;  ///< m/s
  Vec3<V> spin;      ///< radius times angular velocity, m/s
};

namespace detail {

#if defined(__AVX2__) && defined(__FMA__)
/// Four rows of 4 into three vectors; the pads are dropped.
inline Vec3<Lanes4> transpose(Lanes4 r0, Lanes4 r1, Lanes4 r2, Lanes4 r3) {
  const Lanes4 low01 = __builtin_shufflevector(r0, r1, 0, 4, 2, 6);  // x0 x1 z0 z1
  const Lanes4 low23 = __builtin_shufflevector(r2, r3, 0, 4, 2, 6);
  const Lanes4 high01 = __builtin_shufflevector(r0, r1, 1, 5, 3, 7);  // y0 y1 pads
  const Lanes4 high23 = __builtin_shufflevector(r2, r3, 1, 5, 3, 7);
  return {__builtin_shufflevector(low01, low23, 0, 1, 4, 5), __builtin_shufflevector(high01, high23, 0, 1, 4, 5),
          __builtin_shufflevector(low01, low23, 2, 3, 6, 7)};
}

/// Three vectors into four rows of 4 with zero pads, `stride` doubles apart.
inline void store_transposed(double* rows, int stride, const Vec3<Lanes4>& a) {
  const Lanes4 low = __builtin_shufflevector(a.x, a.y, 0, 4, 2, 6);   // x0 y0 x2 y2
  const Lanes4 high = __builtin_shufflevector(a.x, a.y, 1, 5, 3, 7);  // x1 y1 x3 y3
  const Lanes4 even = __builtin_shufflevector(a.z, Lanes4{}, 0, 4, 2, 6);
  const Lanes4 odd = __builtin_shufflevector(a.z, Lanes4{}, 1, 5, 3, 7);
  store(rows, __builtin_shufflevector(low, even, 0, 1, 4, 5));
  store(rows + stride, __builtin_shufflevector(high, odd, 0, 1, 4, 5));
  store(rows + 2 * stride, __builtin_shufflevector(low, even, 2, 3, 6, 7));
  store(rows + 3 * stride, __builtin_shufflevector(high, odd, 2, 3, 6, 7));
}
#endif

#if defined(__AVX512F__) && defined(__AVX512DQ__)
inline Lanes8 low_of_pairs(Lanes8 a, Lanes8 b) { return __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14); }
inline Lanes8 high_of_pairs(Lanes8 a, Lanes8 b) { return __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15); }
inline Lanes8 even_blocks(Lanes8 a, Lanes8 b) { return __builtin_shufflevector(a, b, 0, 1, 4, 5, 8, 9, 12, 13); }
inline Lanes8 odd_blocks(Lanes8 a, Lanes8 b) { return __builtin_shufflevector(a, b, 2, 3, 6, 7, 10, 11, 14, 15); }
inline Lanes8 join(Lanes4 a, Lanes4 b) { return __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7); }

/// Eight rows of 4, joined as (0,2), (1,3), (4,6), (5,7), into three vectors.
inline Vec3<Lanes8> transpose(Lanes8 r02, Lanes8 r13, Lanes8 r46, Lanes8 r57) {
  const Lanes8 low_a = low_of_pairs(r02, r13), low_b = low_of_pairs(r46, r57);  // x0 x1 z0 z1 x2 x3 z2 z3
  return {even_blocks(low_a, low_b), even_blocks(high_of_pairs(r02, r13), high_of_pairs(r46, r57)),
          odd_blocks(low_a, low_b)};
}

/// Eight rows of 8 into six vectors; the pads (columns 3 and 7) are dropped.
inline Motion<Lanes8> transpose(const Lanes8 (&row)[8]) {
  const Lanes8 low01 = low_of_pairs(row[0], row[1]), low23 = low_of_pairs(row[2], row[3]);
  const Lanes8 low45 = low_of_pairs(row[4], row[5]), low67 = low_of_pairs(row[6], row[7]);
  const Lanes8 high01 = high_of_pairs(row[0], row[1]), high23 = high_of_pairs(row[2], row[3]);
  const Lanes8 high45 = high_of_pairs(row[4], row[5]), high67 = high_of_pairs(row[6], row[7]);
  const Lanes8 x_a = even_blocks(low01, low23), x_b = even_blocks(low45, low67);
  const Lanes8 z_a = odd_blocks(low01, low23), z_b = odd_blocks(low45, low67);
  const Lanes8 y_a = even_blocks(high01, high23), y_b = even_blocks(high45, high67);
  return {{even_blocks(x_a, x_b), even_blocks(y_a, y_b), even_blocks(z_a, z_b)},
          {odd_blocks(x_a, x_b), odd_blocks(y_a, y_b), odd_blocks(z_a, z_b)}};
}

/// Three vectors into eight rows of 4 with zero pads.
inline void store_transposed(double* rows, const Vec3<Lanes8>& a) {
  const Lanes8 low = low_of_pairs(a.x, a.y), high = high_of_pairs(a.x, a.y);  // x0 y0 x2 y2 .. | x1 y1 x3 y3 ..
  const Lanes8 low_z = low_of_pairs(a.z, Lanes8{}), high_z = high_of_pairs(a.z, Lanes8{});
  const Lanes8 rows_04 = even_blocks(low, low_z), rows_26 = odd_blocks(low, low_z);
  const Lanes8 rows_15 = even_blocks(high, high_z), rows_37 = odd_blocks(high, high_z);
  store(rows, even_blocks(rows_04, rows_15));
  store(rows + 8, even_blocks(rows_26, rows_37));
  store(rows + 16, odd_blocks(rows_04, rows_15));
  store(rows + 24, odd_blocks(rows_26, rows_37));
}

/// Six vectors into eight rows of 8 with zero pads.
inline void store_transposed(double* rows, const Vec3<Lanes8>& a, const Vec3<Lanes8>& b) {
  const Lanes8 zero{};
  const Lanes8 even[4] = {low_of_pairs(a.x, a.y), low_of_pairs(a.z, zero), low_of_pairs(b.x, b.y),
                          low_of_pairs(b.z, zero)};
  const Lanes8 odd[4] = {high_of_pairs(a.x, a.y), high_of_pairs(a.z, zero), high_of_pairs(b.x, b.y),
                         high_of_pairs(b.z, zero)};
  const Lanes8 even_04 = even_blocks(even[0], even[1]), even_26 = odd_blocks(even[0], even[1]);
  const Lanes8 spin_04 = even_blocks(even[2], even[3]), spin_26 = odd_blocks(even[2], even[3]);
  const Lanes8 odd_15 = even_blocks(odd[0], odd[1]), odd_37 = odd_blocks(odd[0], odd[1]);
  const Lanes8 spin_15 = even_blocks(odd[2], odd[3]), spin_37 = odd_blocks(odd[2], odd[3]);
  store(rows, even_blocks(even_04, spin_04));
  store(rows + 8, even_blocks(odd_15, spin_15));
  store(rows + 16, even_blocks(even_26, spin_26));
  store(rows + 24, even_blocks(odd_37, spin_37));
  store(rows + 32, odd_blocks(even_04, spin_04));
  store(rows + 40, odd_blocks(odd_15, spin_15));
  store(rows + 48, odd_blocks(even_26, spin_26));
  store(rows + 56, odd_blocks(odd_37, spin_37));
}
#endif

}  // namespace detail

/// Vectors of the rows `number` of an array with rows of 4.
template <int W>
Vec3<Lanes<W>> load_vectors(const double* rows, const RowNumber* number) {
  const auto row = [&](int lane) { return load<Lanes<4>>(rows + 4 * number[lane]); };
  if constexpr (W == 8) {
    return detail::transpose(detail::join(row(0), row(2)), detail::join(row(1), row(3)), detail::join(row(4), row(6)),
                             detail::join(row(5), row(7)));
  } else if constexpr (W == 4) {
    return detail::transpose(row(0), row(1), row(2), row(3));
  } else {
    const double* r = rows + 4 * number[0];
    return {r[0], r[1], r[2]};
  }
}

/// Vectors a - b of two sets of rows of 4.
template <int W>
Vec3<Lanes<W>> load_differences(const double* rows_a, const RowNumber* a, const double* rows_b, const RowNumber* b) {
  if constexpr (W == 1) {
    const double *p = rows_a + 4 * a[0], *q = rows_b + 4 * b[0];
    return {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
  } else {
    const auto row = [&](int lane) { return load<Lanes<4>>(rows_a + 4 * a[lane]) - load<Lanes<4>>(rows_b + 4 * b[lane]); };
    if constexpr (W == 8) {
      return detail::transpose(detail::join(row(0), row(2)), detail::join(row(1), row(3)),
                               detail::join(row(4), row(6)), detail::join(row(5), row(7)));
    } else {
      return detail::transpose(row(0), row(1), row(2), row(3));
    }
  }
}

/// Motion of the rows `number` of an array with rows of 8.
template <int W>
Motion<Lanes<W>> load_motion(const double* rows, const RowNumber* number) {
  if constexpr (W == 8) {
    Lanes<8> row[8];
    for (int lane = 0; lane < 8; ++lane) row[lane] = load<Lanes<8>>(rows + 8 * number[lane]);
    return detail::transpose(row);
  } else if constexpr (W == 4) {
    const auto row = [&](int lane, int half) { return load<Lanes<4>>(rows + 8 * number[lane] + half); };
    return {detail::transpose(row(0, 0), row(1, 0), row(2, 0), row(3, 0)),
            detail::transpose(row(0, 4), row(1, 4), row(2, 4), row(3, 4))};
  } else {
    const double* r = rows + 8 * number[0];
    return {{r[0], r[1], r[2]}, {r[4], r[5], r[6]}};
  }
}

/// Velocity a - b and spin a + b of two sets of rows of 8: what the surface velocity of a contact is made of.
template <int W>
Motion<Lanes<W>> load_motion_of_pairs(const double* rows_a, const RowNumber* a, const double* rows_b,
                                      const RowNumber* b) {
  if constexpr (W == 8) {
    constexpr Lanes<8> sign{-1, -1, -1, -1, 1, 1, 1, 1};
    Lanes<8> row[8];
    for (int lane = 0; lane < 8; ++lane)
      row[lane] = fused(sign, load<Lanes<8>>(rows_b + 8 * b[lane]), load<Lanes<8>>(rows_a + 8 * a[lane]));
    return detail::transpose(row);
  } else if constexpr (W == 4) {
    const auto velocity = [&](int l) { return load<Lanes<4>>(rows_a + 8 * a[l]) - load<Lanes<4>>(rows_b + 8 * b[l]); };
    const auto spin = [&](int l) {
      return load<Lanes<4>>(rows_a + 8 * a[l] + 4) + load<Lanes<4>>(rows_b + 8 * b[l] + 4);
    };
    return {detail::transpose(velocity(0), velocity(1), velocity(2), velocity(3)),
            detail::transpose(spin(0), spin(1), spin(2), spin(3))};
  } else {
    const double *p = rows_a + 8 * a[0], *q = rows_b + 8 * b[0];
    return {{p[0] - q[0], p[1] - q[1], p[2] - q[2]}, {p[4] + q[4], p[5] + q[5], p[6] + q[6]}};
  }
}

/// Writes W consecutive rows of 4: a vector and a zero pad.
template <int W>
void store_rows(double* rows, const Vec3<Lanes<W>>& a) {
  if constexpr (W == 8) {
    detail::store_transposed(rows, a);
  } else if constexpr (W == 4) {
    detail::store_transposed(rows, 4, a);
  } else {
    rows[0] = a.x, rows[1] = a.y, rows[2] = a.z, rows[3] = 0;
  }
}

/// Writes W consecutive rows of 8: two vectors, each with a zero pad.
template <int W>
void store_rows(double* rows, const Vec3<Lanes<W>>& a, const Vec3<Lanes<W>>& b) {
  if constexpr (W == 8) {
    detail::store_transposed(rows, a, b);
  } else if constexpr (W == 4) {
    detail::store_transposed(rows, 8, a);
    detail::store_transposed(rows + 4, 8, b);
  } else {
    rows[0] = a.x, rows[1] = a.y, rows[2] = a.z, rows[3] = 0;
    rows[4] = b.x, rows[5] = b.y, rows[6] = b.z, rows[7] = 0;
  }
}

}  // namespace fixdem
