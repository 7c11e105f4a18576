// What the impulse law and the exact slider are made of, each against a plain computation: the exponential, means of
// powers along a straight way, the motion of a sliding spring.
#include <doctest/doctest.h>

#include <cmath>

#include "kernel/impulse_means.hpp"
#include "support.hpp"

namespace fixdem::tests {
namespace {

TEST_CASE("impulse parts: falling exponential") {
  double error = 0;
  float float_error = 0;
  for (double x = 0; x < 700; x = x * 1.001 + 1e-5) {
    error = std::max(error, std::abs(falling_exponential(x) / std::exp(-x) - 1));
    if (x < 80) {
      const float narrow_x = static_cast<float>(x);
      float_error = std::max(
          float_error, std::abs(falling_exponential(narrow_x) / static_cast<float>(std::exp(-double{narrow_x})) - 1));
    }
  }
  CHECK(error < 1.2e-12);
  CHECK(float_error < 2.5e-7f);
  CHECK(falling_exponential(0.0) == doctest::Approx(1).epsilon(1e-12));
  CHECK(falling_exponential(1e300) < 1e-300);
  CHECK(std::isnormal(falling_exponential(1e300)));
}

TEST_CASE("impulse parts: means along short ways") {
  // ((1 + q)^(p + 1) - 1) / ((p + 1) q) in long double, where it cancels to 1e-17 at most.
  const auto mean = [](long double q, long double p) { return (std::pow(1 + q, p + 1) - 1) / ((p + 1) * q); };
  double elastic = 0, damping = 0;
  for (double q = -detail::short_path; q <= detail::short_path; q += detail::short_path / 100) {
    if (std::abs(q) < 1e-3) continue;
    elastic = std::max(elastic, static_cast<double>(std::abs(detail::mean_power<6>(q) - mean(q, 1.5L))));
    damping = std::max(damping, static_cast<double>(std::abs(detail::mean_power<1>(q) - mean(q, 0.25L))));
  }
  CHECK(elastic < 2.5e-12);
  CHECK(damping < 7e-12);
  for (double x = 0.01; x < 1; x += 0.01)
    CHECK(detail::square_of_sinc(x * x) == doctest::Approx(std::pow(std::sin(x) / x, 2)).epsilon(8e-11));
}

TEST_CASE("impulse parts: the closed forms meet the series") {
  const double d = 2e-6;
  const OverlapRoots<double> at{d, std::sqrt(d), std::sqrt(std::sqrt(d))};
  for (const double q : {0.05, 0.01, -0.02}) {
    const auto m = detail::means_in_full<true>(at, q * d, 1.1 * q * d, 0.9 * q * d, 1.0, true);
    const double elastic = 0.5 * d * at.root * (detail::mean_power<6>(-q) + detail::mean_power<6>(1.1 * q));
    const double damping = 0.5 * at.fourth * (detail::mean_power<1>(-q) + detail::mean_power<1>(0.9 * q));
    CHECK(m.elastic == doctest::Approx(elastic).epsilon(5e-12));
    CHECK(m.damping == doctest::Approx(damping).epsilon(1e-11));
    CHECK(m.state == doctest::Approx(std::pow(d * (1 + 0.9 * q), 1.25)).epsilon(1e-13));
    CHECK(m.share_of_step == 1);
  }
}

/// The spring pushed along in many small pieces, cut to the limit after each: what the exact return is the limit of.
Vec3<double> pushed_along(Vec3<double> h, const Vec3<double>& way, double first, double last) {
  constexpr int pieces = 200000;
  for (int k = 1; k <= pieces; ++k) {
    h = add_scaled(h, 1.0 / pieces, way);
    const double limit = first + (last - first) * k / pieces, square = dot(h, h);
    h = capped(h, square, limit);
  }
  return h;
}

TEST_CASE("impulse parts: exact return of the slider") {
  enter({"none", seed()});
  Random random(seed());
  for (int k = 0; k < 40; ++k) {
    const double first = random(0.5, 1.5), last = k % 4 == 0 ? first : first * random(0.8, 1.25);
    const double size = first * (k % 2 == 0 ? 1 : random(0, 1)), turn = random(0, 6.28);
    const Vec3<double> h{size * std::cos(turn), size * std::sin(turn), 0}, way{random(0.1, 3), 0, 0};
    const Vec3<double> trial = add_scaled(h, 1.0, way);
    if (!(dot(trial, trial) > last * last)) continue;  // does not slide
    const Vec3<double> slow = pushed_along(h, way, first, last);
    const double stiffness = random(0.1, 10);
    const auto check = [&](const SlidSpring<double>& exact) {
      CHECK(exact.limit == doctest::Approx(last).epsilon(1e-12));
      CHECK(std::sqrt(dot(exact.spring, exact.spring)) == doctest::Approx(last).epsilon(1e-12));
      // Exact for a constant limit; otherwise the mean of its inverse is taken as the inverse of its mean.
      const double tolerance = first == last ? 3e-5 : 4e-3;
      CHECK(std::abs(exact.spring.x - slow.x) < tolerance);
      CHECK(std::abs(exact.spring.y - slow.y) < tolerance);
    };
    check(exact_return<false>(h, way, first, stiffness * last, stiffness, true));
    if (size == first) check(exact_return<true>(h, way, first, stiffness * last, stiffness, true));
    if (first == last) check(exact_return<true>(h, way, 0.0, stiffness * last, stiffness, true));
  }
  // A spring exactly against the slip stays so as long as it slides; without slip it shrinks with the limit.
  const Vec3<double> shrunk =
      exact_return<true>(Vec3<double>{0, 2, 0}, Vec3<double>{0, 0, 0}, 2.0, 1.0, 1.0, true).spring;
  CHECK(shrunk.y == doctest::Approx(1));
  // An unknown last limit is the present one, or the length of a spring that is beyond it.
  const Vec3<double> cut =
      exact_return<true>(Vec3<double>{0, 2, 0}, Vec3<double>{1e-9, 0, 0}, 0.0, 1.0, 1.0, true).spring;
  CHECK(cut.y == doctest::Approx(1));
}

}  // namespace
}  // namespace fixdem::tests
