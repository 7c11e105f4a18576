// tools/casegen: walls of their own and the limit of friction; what says nothing leaves the header as it was.
#include <doctest/doctest.h>

#include "casegen_run.hpp"

using namespace casegen_test;

namespace {

std::string with_contact(const std::string& line, const std::string& text = good_case) {
  return replaced(text, "[contact]\n", "[contact]\n" + line + "\n");
}

}  // namespace

TEST_CASE("casegen: walls that are told what they are anyway leave the header as it was") {
  const std::string plain = members(printed(good_case));
  CHECK(members(printed(with_material("wall_friction = 0.3\nwall_restitution = 0.9"))) == plain);
  CHECK(members(printed(with_contact("friction_limit = \"total\""))) == plain);
  for (const char* word : {"wall_friction", "wall_restitution", "friction_limit"}) CHECK_FALSE(contains(plain, word));
}

TEST_CASE("casegen: walls of their own and the elastic limit are in header and keys") {
  const std::string own = printed(
      with_contact("friction_limit = \"elastic\"", with_material("wall_friction = 0.25\nwall_restitution = 0.5")));
  for (const char* words :
       {"static constexpr double wall_friction = 0x1p-2", "static constexpr double wall_restitution = 0x1p-1",
        "static constexpr FrictionLimit friction_limit = FrictionLimit::elastic", "[material] wall_friction = 0.25",
        "[contact] friction_limit = \\\"elastic\\\""})
    CHECK_MESSAGE(contains(own, words), words);
  CHECK(contains(printed(with_material("wall_friction = 0")), "wall_friction = 0x0p+0"));
}

TEST_CASE("casegen refuses what it would do nothing with: walls where there are none, a limit of no friction") {
  for (const std::string line : {"wall_friction = 0.2", "wall_restitution = 0.5"})
    check_refused(bare(with_material(line)), line.substr(line.find("0.")) + "\n",
                  {"with [pipe] wall = false and ends = \"periodic\"; allowed: only where there are walls",
                   "remove it, which would do nothing"});
  const std::string limit = "friction_limit = \"elastic\"";
  check_refused(with_contact(limit, replaced(good_case, "friction = 0.3", "friction = 0")), "\"elastic\"",
                {"with friction = 0; allowed: only with friction"});
  check_refused(with_contact(limit, replaced(good_case, "\"exact\"", "\"paper\"")), "\"elastic\"",
                {"with slider = \"paper\"; allowed: \"total\"", "use the whole force"});
  check_refused(with_contact("normal_stiffness = 1e5\ntangential_stiffness = 5e4\ndamping = \"critical\"",
                             replaced(with_material("wall_restitution = 0.5"), "\"hertz\"", "\"linear\"")),
                "0.5\n", {"with damping = \"critical\"; allowed: only with \"restitution\""});
  check_refused(with_contact("friction_limit = \"plastic\""), "\"plastic\"", {"\"total\", \"elastic\""});
  check_refused(with_material("wall_friction = -0.1"), "-0.1", {"at least 0"});
  check_refused(with_material("wall_restitution = 0"), "0\n[contact]", {"above 0 and at most 1"});
}
