// Surfaces of the walls: where a particle touches, how near it is, and what a wall is called.
//
// The pipe's inner surface, with overlap q - (R - r), q the distance of the centre from the axis, normal outwards; and
// the flat ends of a closed pipe, with overlap r - z or z - (L - r), of which a line has the first only. A particle
// touches a surface at one place at most. In mixed precision q^2 - (R - r)^2 and the overlap with an end are formed in
// double and narrowed (wall_contacts.hpp). Everything that differs between walls is here: a new one is a struct with
// the same members, a member of Contacts and a line in for_each_wall (contacts.hpp).
#pragma once

#include "lanes.hpp"
#include "particles.hpp"

namespace fixdem {

inline constexpr int pipe_wall = -1, start_end = -2, far_end = -3;  ///< partners that are no particles

/// What a contact is known by before any root: `gap_square` is a square of a distance, a difference of such squares, or
/// what the surface says.
template <class V>
struct Separation {
  Vec3<V> separation;
  V gap_square;
  V reach{};  ///< with several sizes: the distance at which it touches
};

/// Distance at which centres touch, or its square: that of the contact, or with one size `of_one` for all.
template <class Case, class V>
FIXDEM_INLINE V reach_of(const Separation<V>& s, double of_one) {
  return has_sizes<Case> ? s.reach : splat<V>(of_one);
}
template <class Case, class V>
FIXDEM_INLINE V reach_square_of(const Separation<V>& s, double of_one) {
  return has_sizes<Case> ? s.reach * s.reach : splat<V>(of_one * of_one);
}

/// Of a separation: q^2; mixed: q^2 - (R - r)^2.
template <class Case>
struct PipeSurface {
  static constexpr bool is_present = Case::has_wall;
  static constexpr int kept_as = pipe_wall;  ///< partner in KeptHistory
  static constexpr bool is_flat = true;      ///< normals have no component along the pipe
  static constexpr bool has_root = true;

  template <class V>
  static FIXDEM_INLINE Separation<V> separation(const Vec3<V>& x, V radius) {
    Separation<V> s{{x.x, x.y, V{}}, fused(x.y, x.y, x.x * x.x), Derived<Case>::pipe_radius - radius};
    if constexpr (is_mixed<Case>) s.gap_square = s.gap_square - reach_square(s);
    return s;
  }
  template <class V>
  static FIXDEM_INLINE unsigned touching(const Separation<V>& s) {
    return bits_below(is_mixed<Case> ? V{} : reach_square(s), s.gap_square);
  }
  /// On the axis there is no normal, and no contact.
  template <class V>
  static FIXDEM_INLINE V root(const Separation<V>& s) {
    if constexpr (is_mixed<Case>)
      return sqrt(max(s.gap_square + reach_square(s), V{}));
    else
      return sqrt(s.gap_square);
  }
  template <class V>
  static FIXDEM_INLINE V resolve(const Separation<V>& s, V q, Vec3<V>& n) {
    if constexpr (is_mixed<Case>) {
      n = scale(constant<V>(1) / max(q, splat<V>(1e-30)), s.separation);
      return s.gap_square / (q + reach(s));
    } else {
      n = scale(1.0 / max(q, splat<V>(1e-300)), s.separation);
      return q - reach(s);
    }
  }

  // Of a sphere by its row of positions. `gap`: distance of its surface, m; negative: overlap.
  static double gap(const double* x) { return Derived<Case>::pipe_radius - radius_at<Case>(x) - place(x); }
  /// Overlap in double, and its normal.
  static double overlap(const double* x, Vec3<double>& n) {
    const double q = place(x), inverse = 1 / max(q, 1e-300);
    n = {inverse * x[0], inverse * x[1], 0};
    return q - (Derived<Case>::pipe_radius - radius_at<Case>(x));
  }
  static int partner(const Vec3<double>&) { return pipe_wall; }
  /// Bound on the speed towards the surface, m/s.
  template <class Box>
  static double speed(const Box& velocities) {
    return velocities.speed_across();
  }
  /// Where a centre is outside the pipe; the place that tells, and its limit, m.
  static bool is_outside(const double* x) { return place(x) > limit; }
  static double place(const double* x) { return sqrt(fused(x[1], x[1], x[0] * x[0])); }
  static constexpr double limit = Derived<Case>::pipe_radius;

 private:
  /// Distance from the axis at which centres touch, and its square.
  template <class V>
  static FIXDEM_INLINE V reach(const Separation<V>& s) {
    return reach_of<Case>(s, one_reach);
  }
  template <class V>
  static FIXDEM_INLINE V reach_square(const Separation<V>& s) {
    return reach_square_of<Case>(s, one_reach);
  }
  static constexpr double one_reach = Derived<Case>::pipe_radius - Derived<Case>::reference_radius;  ///< of one size
};

/// Of a separation: the overlap itself; it lies along z.
template <class Case>
struct EndSurfaces {
  static constexpr bool is_present = Derived<Case>::has_ends;
  static constexpr int kept_as = start_end;
  static constexpr bool is_flat = false, has_root = false;

  template <class V>
  static FIXDEM_INLINE Separation<V> separation(const Vec3<V>& x, V radius) {
    if constexpr (is_line<Case>) return {{V{}, V{}, splat<V>(-1.0)}, radius - x.z};
    const auto at_start = x.z < 0.5 * Case::pipe_length;
    return {{V{}, V{}, select(at_start, splat<V>(-1.0), splat<V>(1.0))},
            select(at_start, radius - x.z, x.z - (Case::pipe_length - radius))};
  }
  template <class V>
  static FIXDEM_INLINE unsigned touching(const Separation<V>& s) {
    return bits_below(V{}, s.gap_square);
  }
  template <class V>
  static FIXDEM_INLINE V resolve(const Separation<V>& s, V, Vec3<V>& n) {
    n = s.separation;
    return s.gap_square;
  }

  static double gap(const double* x) {
    return (is_line<Case> ? x[2] : min(x[2], Case::pipe_length - x[2])) - radius_at<Case>(x);
  }
  static double overlap(const double* x, Vec3<double>& n) {
    return resolve(separation(Vec3<double>{x[0], x[1], x[2]}, radius_at<Case>(x)), 0.0, n);
  }
  static int partner(const Vec3<double>& n) { return n.z < 0 ? start_end : far_end; }
  template <class Box>
  static double speed(const Box& velocities) {
    return velocities.speed_along();
  }
  static bool is_outside(const double* x) { return x[2] < 0 || x[2] > limit; }
  static double place(const double* x) { return x[2]; }
  static constexpr double limit = Case::pipe_length;
};

}  // namespace fixdem
