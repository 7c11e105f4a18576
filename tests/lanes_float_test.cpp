// Every operation of the SIMD vocabulary and every transposition, doubles and floats, at every width of the build,
// against the scalar twin, bit by bit.
//
// Numbers are random bits (of all magnitudes, denormal and infinite ones among them) and random bits with exponents so
// near each other that sums and products neither vanish nor overflow; a NaN agrees with any other NaN, since its
// payload is nobody's result.
#include <doctest/doctest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <type_traits>

#include "kernel/rows.hpp"
#include "support.hpp"

namespace {

using namespace fixdem;

constexpr int rounds = 2000;

template <class T>
using BitsOf = std::conditional_t<sizeof(T) == 8, std::uint64_t, std::uint32_t>;

/// xorshift over the seed of the test run.
struct RandomBits {
  std::uint64_t state = 0x9e3779b97f4a7c15ULL * static_cast<std::uint64_t>(2 * tests::seed() + 1);
  std::uint64_t operator()() {
    state ^= state << 13, state ^= state >> 7, state ^= state << 17;
    return state;
  }
  /// One in four of any magnitude, one in sixteen special; else between 2^-8 and 2^8, either sign.
  template <class T>
  T number() {
    using Bits = BitsOf<T>;
    constexpr int fraction = sizeof(T) == 8 ? 52 : 23, bias = sizeof(T) == 8 ? 1023 : 127;
    constexpr Bits sign = Bits{1} << (8 * sizeof(T) - 1);
    const Bits bits = static_cast<Bits>((*this)() >> (64 - 8 * sizeof(T)));
    const auto choice = (*this)() >> 60;
    if (choice < 4) return std::bit_cast<T>(bits);
    if (choice == 4) {
      const Bits infinite = ((Bits{1} << (8 * sizeof(T) - 1 - fraction)) - 1) << fraction;
      const Bits special[4] = {0, infinite, bits & ((Bits{1} << fraction) - 1), Bits{1}};
      return std::bit_cast<T>(static_cast<Bits>(special[(*this)() >> 62] | (bits & sign)));
    }
    const Bits exponent = static_cast<Bits>(bias - 8 + static_cast<int>((*this)() >> 60));
    return std::bit_cast<T>(static_cast<Bits>((bits & (sign | ((Bits{1} << fraction) - 1))) | exponent << fraction));
  }
};

template <class T>
bool same(T a, T b) {
  return (a != a && b != b) || std::bit_cast<BitsOf<T>>(a) == std::bit_cast<BitsOf<T>>(b);
}

template <class T, int Count>
struct Numbers {
  alignas(64) T value[Count];
  explicit Numbers(RandomBits& random) {
    for (T& v : value) v = random.number<T>();
  }
};

/// Lanes of one width and element type, as a type for doctest.
template <int Width, class Number>
struct Kind {
  static constexpr int W = Width;
  using T = Number;
};

/// `wide` of lanes and `narrow` of single numbers are the same function.
template <class K, class Function>
int differences(const Numbers<typename K::T, 3 * K::W>& in, Function&& function) {
  using T = typename K::T;
  using V = Lanes<K::W, T>;
  alignas(64) T out[K::W];
  store(out, V(function(load<V>(in.value), load<V>(in.value + K::W), load<V>(in.value + 2 * K::W))));
  int different = 0;
  for (int k = 0; k < K::W; ++k)
    different += !same(out[k], T(function(in.value[k], in.value[K::W + k], in.value[2 * K::W + k])));
  return different;
}

/// Numbers of rows in random order, as offsets; and the row that an offset names.
template <int W>
struct RandomOffsets {
  std::uint16_t offset[W];
  explicit RandomOffsets(RandomBits& random) {
    for (auto& o : offset) o = static_cast<std::uint16_t>(8 * (random() >> 59));
  }
  int row(int k) const { return offset[k] / 8; }
};
constexpr int row_count = 32;

template <class V>
int count_different(const V& lanes, const auto& expected) {
  using T = Element<V>;
  constexpr int W = sizeof(V) / sizeof(T);
  alignas(64) T out[W];
  store(out, lanes);
  int different = 0;
  for (int k = 0; k < W; ++k) different += !same(out[k], static_cast<T>(expected(k)));
  return different;
}

template <class V>
int count_different(const Vec3<V>& lanes, const auto& expected) {
  return count_different(lanes.x, [&](int k) { return expected(k, 0); }) +
         count_different(lanes.y, [&](int k) { return expected(k, 1); }) +
         count_different(lanes.z, [&](int k) { return expected(k, 2); });
}

}  // namespace

#if FIXDEM_WIDEST_LANES >= 8
#define FIXDEM_KINDS                                                                                                  \
  Kind<1, double>, Kind<1, float>, Kind<2, double>, Kind<4, float>, Kind<4, double>, Kind<8, float>, Kind<8, double>, \
      Kind<16, float>
#define FIXDEM_HALVES Kind<1, double>, Kind<2, double>, Kind<4, double>, Kind<8, double>
#elif FIXDEM_WIDEST_LANES >= 4
#define FIXDEM_KINDS Kind<1, double>, Kind<1, float>, Kind<2, double>, Kind<4, float>, Kind<4, double>, Kind<8, float>
#define FIXDEM_HALVES Kind<1, double>, Kind<2, double>, Kind<4, double>
#elif FIXDEM_WIDEST_LANES >= 2
#define FIXDEM_KINDS Kind<1, double>, Kind<1, float>, Kind<2, double>, Kind<4, float>
#define FIXDEM_HALVES Kind<1, double>, Kind<2, double>
#else
#define FIXDEM_KINDS Kind<1, double>, Kind<1, float>
#define FIXDEM_HALVES Kind<1, double>
#endif

TEST_CASE_TEMPLATE("lanes: every operation is its scalar twin's in each lane", K, FIXDEM_KINDS) {
  RandomBits random;
  using T = typename K::T;
  int different = 0, any_wrong = 0;
  for (int round = 0; round < rounds; ++round) {
    const Numbers<T, 3 * K::W> in(random);
    different += differences<K>(in, [](auto a, auto b, auto c) { return fused(a, b, c); });
    different += differences<K>(in, [](auto a, auto b, auto c) { return fused_minus(a, b, c); });
    different += differences<K>(in, [](auto a, auto, auto) { return fixdem::sqrt(a); });
    different += differences<K>(in, [](auto a, auto, auto) { return fixdem::abs(a); });
    different += differences<K>(in, [](auto a, auto b, auto) { return fixdem::max(a, b); });
    different += differences<K>(in, [](auto a, auto b, auto) { return a + b; });
    different += differences<K>(in, [](auto a, auto b, auto) { return a * b; });
    different += differences<K>(in, [](auto a, auto b, auto) { return a / b; });
    different += differences<K>(in, [](auto a, auto b, auto c) { return select(a < b, b, c); });
    different += differences<K>(in, [](auto a, auto b, auto c) { return where((a > b) | (b > c), c); });
    different += differences<K>(in, [](auto a, auto b, auto) {
      using V = decltype(a);
      return constant<V>(0.1) * a + splat<V>(0.7) / b;
    });
    different += differences<K>(in, [](auto a, auto b, auto c) { return dot(Vec3<decltype(a)>{a, b, c}, {c, a, b}); });
    different += differences<K>(in, [](auto a, auto b, auto c) {
      return cross(Vec3<decltype(a)>{a, b, c}, {c, a, b}).y;
    });

    using V = Lanes<K::W, T>;
    bool expected = false;
    for (int k = 0; k < K::W; ++k) expected |= in.value[k] > T{100};
    any_wrong += any(load<V>(in.value) > constant<V>(100)) != expected;
    different += count_different(load_any<V>(in.value + 1), [&](int k) { return in.value[k + 1]; });
    different += count_different(lane_numbers<K::W, T>(round), [&](int k) { return round + k; });
  }
  CHECK(different == 0);
  CHECK(any_wrong == 0);
}

TEST_CASE("lanes: one lane computes what the standard library does") {
  RandomBits random;
  int different = 0;
  for (int round = 0; round < rounds; ++round) {
    const double a = random.number<double>(), b = random.number<double>(), c = random.number<double>();
    const float p = random.number<float>(), q = random.number<float>(), r = random.number<float>();
    different += !same(fused(a, b, c), std::fma(a, b, c)) + !same(fixdem::sqrt(a), std::sqrt(a));
    different += !same(fused(p, q, r), std::fmaf(p, q, r)) + !same(fixdem::sqrt(p), std::sqrt(p));
    different += !same(fixdem::abs(a), std::fabs(a)) + !same(fixdem::abs(p), std::fabs(p));
  }
  CHECK(different == 0);
}

TEST_CASE_TEMPLATE("lanes: doubles become floats, rounded to nearest, and floats doubles", K, FIXDEM_HALVES) {
  RandomBits random;
  constexpr int W = K::W;
  using V = Lanes<W>;
  int different = 0;
  for (int round = 0; round < rounds; ++round) {
    Numbers<double, 2 * W> in(random);
    for (double& v : in.value)  // also numbers whose neighbours among the floats lie close: denormal and near overflow
      if (random() >> 62 == 0) v = std::ldexp(v, (random() >> 63) ? -140 : 120);
    const Numbers<float, W> floats(random);
    const auto rounded = [&](int k) { return static_cast<float>(in.value[k]); };
    if constexpr (W == 1)
      different += !same(narrow(in.value[0]), rounded(0));
    else
      different += count_different(narrow(load<V>(in.value), load<V>(in.value + W)), rounded);
    different += count_different(load_wide<W>(floats.value), [&](int k) { return double{floats.value[k]}; });
    alignas(64) float out[W];
    store_narrow<W>(out, load<V>(in.value));
    for (int k = 0; k < W; ++k) different += !same(out[k], rounded(k));
  }
  CHECK(different == 0);
}

TEST_CASE_TEMPLATE("rows: looked up by offset, each row in its lane", K, FIXDEM_KINDS) {
  RandomBits random;
  constexpr int W = K::W;
  using T = typename K::T;
  int different = 0;
  for (int round = 0; round < rounds; ++round) {
    const Numbers<T, 4 * row_count> p4(random), q4(random);
    const Numbers<T, 8 * row_count> p8(random), q8(random);
    const RandomOffsets<W> a(random), b(random);
    const T *p = p4.value, *q = q4.value, *v = p8.value, *w = q8.value;
    different += count_different(load_vectors<W>(p, a.offset), [&](int k, int c) { return p[4 * a.row(k) + c]; });
    different += count_different(load_differences<W>(p, a.offset, q, b.offset),
                                 [&](int k, int c) { return p[4 * a.row(k) + c] - q[4 * b.row(k) + c]; });
    const auto motion = load_motion<W>(v, a.offset);
    different += count_different(motion.velocity, [&](int k, int c) { return v[8 * a.row(k) + c]; });
    different += count_different(motion.spin, [&](int k, int c) { return v[8 * a.row(k) + 4 + c]; });
    const auto check_pairs = [&](const auto& pair) {
      different +=
          count_different(pair.velocity, [&](int k, int c) { return v[8 * a.row(k) + c] - w[8 * b.row(k) + c]; });
      different +=
          count_different(pair.spin, [&](int k, int c) { return v[8 * a.row(k) + 4 + c] + w[8 * b.row(k) + 4 + c]; });
    };
    check_pairs(load_motion_of_pairs<W, false>(v, a.offset, w, b.offset));
    const auto pair = load_motion_of_pairs<W, true>(v, a.offset, w, b.offset);
    check_pairs(pair);
    const Vec3<Lanes<W, T>> pads = {pair.inverse_mass, pair.inverse_radius, pair.inverse_mass};
    different += count_different(pads, [&](int k, int c) {
      const int pad = c == 1 ? 7 : 3;
      return v[8 * a.row(k) + pad] + w[8 * b.row(k) + pad];
    });
    const auto places = load_separations<W>(p, a.offset, q, b.offset);
    different += count_different(Vec3<Lanes<W, T>>{places.x, places.z, places.w}, [&](int k, int c) {
      const int i = 4 * a.row(k) + (c == 0 ? 0 : c + 1), j = 4 * b.row(k) + (c == 0 ? 0 : c + 1);
      return c == 2 ? p[i] + q[j] : p[i] - q[j];
    });
  }
  CHECK(different == 0);
}

TEST_CASE_TEMPLATE("rows: written in the order of the lanes", K, FIXDEM_KINDS) {
  RandomBits random;
  constexpr int W = K::W;
  using T = typename K::T;
  using V = Lanes<W, T>;
  int different = 0;
  for (int round = 0; round < rounds; ++round) {
    const Numbers<T, 8 * W> in(random);
    const auto lanes = [&](int c) { return load<V>(in.value + c * W); };
    Numbers<T, 4 * W + 1> rows4(random);
    Numbers<T, 8 * W + 1> rows8(random);
    const T after4 = rows4.value[4 * W], after8 = rows8.value[8 * W];
    const Vec4<V> a{lanes(0), lanes(1), lanes(2), lanes(3)}, b{lanes(4), lanes(5), lanes(6), lanes(7)};
    RowLanes<W, T>::store_rows(rows4.value, a);
    RowLanes<W, T>::store_rows(rows8.value, a, b);
    for (int k = 0; k < W; ++k)
      for (int c = 0; c < 4; ++c) {
        different += !same(rows4.value[4 * k + c], in.value[c * W + k]);
        different += !same(rows8.value[8 * k + c], in.value[c * W + k]);
        different += !same(rows8.value[8 * k + 4 + c], in.value[(4 + c) * W + k]);
      }
    different += !same(rows4.value[4 * W], after4) + !same(rows8.value[8 * W], after8);  // nothing beyond
  }
  CHECK(different == 0);
}
