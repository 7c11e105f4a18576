// Kernel against reference in an open line: its feed and its pipe. Empty at the start, a rate that changes, a slow
// start; on a slope, upright, lying on its side.
#include "agreement_line.hpp"

namespace fixdem::tests {
namespace {

/// Single particles that are blown upwards, for long enough for numbers to be used again many times.
struct dilute_line : empty_at_start<short_line> {
  static constexpr int particle_count = 60;
  static constexpr double time_step = 2e-5, gas_velocity = 25;
  static constexpr double gravity[3] = {0, 0, -9.81};
  static constexpr TimeValue feed_rate[] = {{0, 0.1}};
  static constexpr int feed_interval = 50;
};

}  // namespace

template <>
inline constexpr long long agreement_steps<dilute_line> = 25000;

namespace {

struct empty_line : empty_at_start<short_line> {
  static constexpr double time_step = 1e-5;
};
struct changing_rate : short_line {
  static constexpr TimeValue feed_rate[] = {{0, 0.2}, {0.01, 1.5}, {0.02, 0.1}, {0.03, 0.8}};
  static constexpr double feed_start = 0.004;
};
struct every_step : short_line {
  static constexpr int feed_interval = 1, gas_update_interval = 3, gas_floater_interval = 4;
  static constexpr double feed_velocity = 1, feed_length = 0.06;
  static constexpr unsigned long long feed_seed = 7;
};
struct on_a_slope : short_line {  // 30 degrees upwards
  static constexpr double gravity[3] = {0, -9.81 * 0.86602540378443865, -9.81 * 0.5};
};
struct upright : short_line {
  static constexpr double gravity[3] = {0, 0, -9.81};
};
/// 85 degrees: no bed, and yet a direction into which particles fall.
struct almost_upright : short_line {
  static constexpr double gravity[3] = {0, -9.81 * 0.087155742747658, -9.81 * 0.99619469809174555};
};
struct on_its_side : short_line {
  static constexpr double gravity[3] = {-7.2, 6.3, 1.9};
};

TEST_CASE("agreement: a line that is empty at the start") { check_line<empty_line>("line, empty"); }
TEST_CASE("agreement: a line that particles pass one by one") {
  check_line<dilute_line>("line, dilute", 1e-9);  // the drag's power rounds, and positions add it up for 0.5 s
  CHECK(kernel<dilute_line>().line().left > 30);
}
TEST_CASE("agreement: a line, the feed") {
  check_line<changing_rate>("line, rate in time");
  check_line<every_step>("line, fed in every step");
}
TEST_CASE("agreement: a line on a slope") { check_line<on_a_slope>("line, 30 degrees"); }
TEST_CASE("agreement: a line upright") {
  check_line<upright>("line, upright");
  check_line<almost_upright>("line, almost upright");
}
TEST_CASE("agreement: a line with gravity in any direction") { check_line<on_its_side>("line, on its side"); }

}  // namespace
}  // namespace fixdem::tests
