// tools/casegen: rolling resistance of particles and walls; what says nothing leaves the header as it was.
#include <doctest/doctest.h>

#include "casegen_run.hpp"

using namespace casegen_test;

namespace {

std::string without_friction(const std::string& line) {
  return replaced(good_case, "friction = 0.3", "friction = 0\n" + line);
}

/// Whether the header has this member; comments and the text of keys do not count.
bool has_member(const std::string& header, const std::string& name) {
  return contains(header, "static constexpr double " + name + " = ");
}

/// Accepted with this warning, at the first place of `at`, or without any about rolling when `words` are empty.
void check_warning(const std::string& text, const std::string& at, const std::string& words) {
  const std::string said = printed(text);
  CAPTURE(said);
  if (words.empty()) {
    CHECK_FALSE(contains(said, "is not below"));
    return;
  }
  CHECK(contains(said, ":" + position_of(text, at) + ": warning: [material] " + words));
  CHECK(contains(said, "particles will slide rather than roll"));
}

}  // namespace

TEST_CASE("casegen: rolling resistance that says nothing leaves the header as it was") {
  const std::string plain = members(printed(good_case));
  CHECK(members(printed(with_material("rolling_friction = 0"))) == plain);
  CHECK(members(printed(with_material("wall_rolling_friction = 0"))) == plain);
  CHECK_FALSE(contains(plain, "rolling_friction"));
  // The wall's default is the particles' own, and nothing where the wall has no friction.
  const std::string rolling = members(printed(with_material("rolling_friction = 0.0625")));
  CHECK(members(printed(with_material("rolling_friction = 0.0625\nwall_rolling_friction = 0.0625"))) == rolling);
  const std::string smooth = members(printed(with_material("rolling_friction = 0.0625\nwall_friction = 0")));
  CHECK(members(printed(with_material("rolling_friction = 0.0625\nwall_friction = 0\nwall_rolling_friction = 0"))) ==
        smooth);
  CHECK_FALSE(has_member(smooth, "wall_rolling_friction"));
}

TEST_CASE("casegen: rolling resistance is in header and keys") {
  const std::string own = printed(with_material("rolling_friction = 0.0625"));
  CHECK(contains(own, "static constexpr double rolling_friction = 0x1p-4;"));
  CHECK(contains(own, "[material] rolling_friction = 0.0625"));
  CHECK_FALSE(contains(own, "wall_rolling_friction"));
  const std::string bare_wall = printed(with_material("rolling_friction = 0.0625\nwall_rolling_friction = 0"));
  CHECK(contains(bare_wall, "static constexpr double wall_rolling_friction = 0x0p+0;"));
  CHECK(contains(bare_wall, "[material] wall_rolling_friction = 0"));
  const std::string wall_only = printed(with_material("wall_rolling_friction = 0.125"));
  CHECK(contains(wall_only, "static constexpr double wall_rolling_friction = 0x1p-3;"));
  CHECK_FALSE(has_member(wall_only, "rolling_friction"));
  // Particles without friction may roll on a wall that has some.
  CHECK(has_member(printed(without_friction("wall_friction = 0.25\nwall_rolling_friction = 0.125")),
                   "wall_rolling_friction"));
}

TEST_CASE("casegen refuses rolling resistance that would do nothing") {
  check_refused(without_friction("rolling_friction = 0.1"), "0.1\n[contact]",
                {"[material] rolling_friction = 0.1 with friction = 0; allowed: 0",
                 "without friction nothing turns: set friction above 0 or remove it"});
  const std::string at_wall = "[material] wall_rolling_friction = 0.1 with wall_friction = 0; allowed: 0";
  check_refused(with_material("wall_rolling_friction = 0.1\nwall_friction = 0"), "0.1\nwall_friction",
                {at_wall.c_str(), "set wall_friction above 0 or remove it"});
  check_refused(without_friction("wall_rolling_friction = 0.1"), "0.1\n[contact]", {at_wall.c_str()});
  check_refused(bare(with_material("wall_rolling_friction = 0.1")), "0.1\n[contact]",
                {"with [pipe] wall = false and ends = \"periodic\"; allowed: only where there are walls",
                 "remove it, which would do nothing"});
  for (const std::string key : {"rolling_friction", "wall_rolling_friction"})
    check_refused(with_material(key + " = -0.1"), "-0.1", {key.c_str(), "at least 0"});
}

TEST_CASE("casegen warns where rolling resistance is not below friction, once for each kind of contact") {
  check_warning(with_material("rolling_friction = 0.4"), "0.4", "rolling_friction = 0.4 is not below friction = 0.3");
  check_warning(with_material("rolling_friction = 0.3"), "0.3\n[contact]", "rolling_friction = 0.3 is not below");
  check_warning(with_material("rolling_friction = 0.29"), "", "");
  check_warning(with_material("rolling_friction = 0.4\nwall_friction = 0.5"), "0.4", "rolling_friction = 0.4");
  CHECK_FALSE(
      contains(printed(with_material("rolling_friction = 0.4\nwall_friction = 0.5")), "wall_rolling_friction ="));
  CHECK_FALSE(contains(printed(with_material("rolling_friction = 0.4")), "wall_rolling_friction ="));
  check_warning(with_material("rolling_friction = 0.2\nwall_friction = 0.1"), "0.1\n[contact]",
                "wall_rolling_friction = 0.2 is not below wall_friction = 0.1");
  check_warning(with_material("wall_rolling_friction = 0.7"), "0.7",
                "wall_rolling_friction = 0.7 is not below wall_friction = 0.3");
}
