// Means along straight paths: what the impulse law (impulse_law.hpp) needs to know of one step of a contact.
//
// Two half steps, from the overlap before to the present one and from there on, each at constant velocity; of
// overlap^(3/2) and overlap^(1/4) along them (linear law: of the overlap, and of one). Short paths go by Taylor series,
// the others by closed forms in roots and fourth roots of both ends, which do not cancel: with a = p^2, b = q^2 the
// roots of the ends,
//   mean of overlap^(3/2) = (2/5) (b^5 - a^5) / (b^2 - a^2),   mean of overlap^(1/4) = (4/5) (q^5 - p^5) / (q^4 - p^4).
// Where an end is a gap, the mean counts for the share of the path that has overlap.
#pragma once

#include "contact_law.hpp"

namespace fixdem {

/// What the geometry gives to the law.
template <class V>
struct OverlapRoots {
  V overlap;       ///< m; negative where there is a gap
  V root, fourth;  ///< of the overlap; zero where there is none; not used by the linear law
};

namespace detail {

/// Paths up to this share of the overlap go by the series.
inline constexpr double short_path = 1.0 / 16;

/// Mean of (1 + q t)^(N/4) over t from 0 to 1 for |q| <= short_path; relative error below 1e-11.
template <int N, class V>
FIXDEM_INLINE V mean_power(V q) {
  constexpr int terms = 6;
  struct Binomial {
    double c[CutSeries<terms>::given] = {1};
    constexpr Binomial() {
      for (int k = 1; k < CutSeries<terms>::given; ++k) c[k] = c[k - 1] * (N / 4.0 - k + 1) / k;
      for (int k = 1; k < CutSeries<terms>::given; ++k) c[k] /= k + 1;
    }
  };
  static constexpr CutSeries<terms> series(Binomial().c, -short_path, short_path);
  return polynomial(series.c, q);
}

/// u^4 + u^3 w + u^2 w^2 + u w^3 + w^4 = (w^5 - u^5) / (w - u)
template <class V>
FIXDEM_INLINE V sum_of_fourth_degree(V u, V w) {
  const V square = w * w;
  return fused(fused(fused(u + w, u, square), u, square * w), u, square * square);
}

/// One end of a straight path: overlap (zero for a gap) with its root and fourth root.
template <bool is_hertz, class V>
FIXDEM_INLINE OverlapRoots<V> end_of_path(V overlap) {
  const V inside = max(overlap, V{});
  if constexpr (!is_hertz) return {inside, V{}, V{}};
  const V root = sqrt(inside);
  return {inside, root, sqrt(root)};
}

/// G without its factor: overlap^(5/4), or the overlap.
template <bool is_hertz, class V>
FIXDEM_INLINE V state_at(const OverlapRoots<V>& end) {
  if constexpr (is_hertz) return end.overlap * end.fourth;
  return end.overlap;
}

/// Share of a straight path on which there is overlap, as a quotient, which is left to whoever has to divide anyhow.
template <class V>
struct Share {
  V part, whole;
};

/// Between two overlaps of which one may be a gap.
template <class V>
FIXDEM_INLINE Share<V> share_with_overlap(V a, V b) {
  const V low = a < b ? a : b, high = max(a, b);
  const auto has_gap = low < V{};
  return {select(has_gap, max(high, V{}), splat<V>(1)), select(has_gap, high - low, splat<V>(1))};
}

/// Means along a straight path between two overlaps, times the share of it: of overlap^(3/2), or the overlap ...
template <bool is_hertz, class V>
FIXDEM_INLINE V elastic_mean(const OverlapRoots<V>& a, const OverlapRoots<V>& b, const Share<V>& share) {
  const V least = splat<V>(least_square<V>);
  if constexpr (!is_hertz) return constant<V>(0.5) * (a.overlap + b.overlap) * share.part / max(share.whole, least);
  return constant<V>(0.4) * sum_of_fourth_degree(a.root, b.root) * share.part /
         max((a.root + b.root) * share.whole, least);
}
/// ... and of overlap^(1/4), or one.
template <bool is_hertz, class V>
FIXDEM_INLINE V damping_mean(const OverlapRoots<V>& a, const OverlapRoots<V>& b, const Share<V>& share) {
  const V least = splat<V>(least_square<V>);
  if constexpr (!is_hertz) return share.part / max(share.whole, least);
  return constant<V>(0.8) * sum_of_fourth_degree(a.fourth, b.fourth) * share.part /
         max((a.fourth + b.fourth) * (a.root + b.root) * share.whole, least);
}

/// What the closed forms give: means over the step, values of the state function, share of the step for the spring.
template <class V>
struct PathMeans {
  V elastic, damping, state_before, state, share_of_step;
};

template <bool is_hertz, class V, class Mask>
FIXDEM_INLINE PathMeans<V> means_in_full(const OverlapRoots<V>& at, V path_before, V path_after, V path_of_state,
                                         V last, Mask pressed) {
  const V half = splat<V>(0.5), one = splat<V>(1), two = splat<V>(2);
  const Mask approaches = path_before > V{}, has_begun = (last == V{}) & approaches, found = last < V{};
  const V overlap_before = at.overlap - path_before, overlap_after = at.overlap + path_after;
  const V overlap_of_state = at.overlap + path_of_state;
  const OverlapRoots<V> now = {max(at.overlap, V{}), at.root, at.fourth};
  const OverlapRoots<V> before = end_of_path<is_hertz>(select(has_begun, V{}, overlap_before));
  const OverlapRoots<V> after = end_of_path<is_hertz>(overlap_after);
  const OverlapRoots<V> of_state = end_of_path<is_hertz>(overlap_of_state);
  const V longest = two * path_before;  // since it has begun: the half step before this one, too
  Share<V> share_before = share_with_overlap(overlap_before, at.overlap);
  share_before.part = select(has_begun, at.overlap < longest ? at.overlap : longest, share_before.part);
  share_before.whole = select(has_begun, path_before, share_before.whole);
  const Share<V> share_after = share_with_overlap(at.overlap, overlap_after);
  const Share<V> share_of_state = share_with_overlap(at.overlap, overlap_of_state);

  PathMeans<V> m;
  m.elastic = half * (elastic_mean<is_hertz>(before, now, share_before) +
                      where(pressed, elastic_mean<is_hertz>(now, after, share_after)));
  m.damping = half * (damping_mean<is_hertz>(before, now, share_before) +
                      where(pressed, damping_mean<is_hertz>(now, of_state, share_of_state)));
  m.state = state_at<is_hertz>(of_state);
  m.state_before = select(found, state_at<is_hertz>(before), last);
  m.share_of_step = one;
  if (const Mask begins = has_begun | found; any(begins)) {
    const V whole = select(found, half, one);
    const V from_begin = half * at.overlap / max(path_before, splat<V>(least_square<V>));
    m.share_of_step = select(begins & approaches & (from_begin < whole), from_begin, whole);
  }
  return m;
}

/// sin^2(x) / x^2 from x^2, up to one radian; beyond, as there. Relative error below 1e-10.
template <class V>
FIXDEM_INLINE V square_of_sinc(V x_square) {
  constexpr int terms = 6;
  struct Series {
    double c[CutSeries<terms>::given] = {1};
    constexpr Series() {
      for (int k = 1; k < CutSeries<terms>::given; ++k) c[k] = -c[k - 1] * 4 / ((2.0 * k + 1) * (2.0 * k + 2));
    }
  };
  static constexpr CutSeries<terms> series(Series().c, 0, 1);
  const V x = x_square < constant<V>(1) ? x_square : splat<V>(1);
  return polynomial(series.c, x);
}

}  // namespace detail

}  // namespace fixdem
