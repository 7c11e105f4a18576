// tools/casegen: what a line of several sizes is fed with.
#include <doctest/doctest.h>

#include <algorithm>

#include "casegen_line_cases.hpp"

using namespace casegen_test;

namespace {

/// Of 3 large and 5 small ones at the start, the small twice as dense: 1 and 1/4 of a large one's mass.
const std::string line_of_two = opened(mixed_case);

std::string fed(const std::string& mixture, const std::string& text = line_of_two) {
  return replaced(text, "rate = 0.25", "rate = 0.25\nmixture = " + mixture);
}

/// Counts of the runs behind those of the start.
std::vector<int> fed_counts(const std::string& header, std::size_t at_start) {
  std::vector<int> counts;
  for (const Run& run : sizes_of(header)) counts.push_back(run.count);
  REQUIRE(counts.size() > at_start);
  return {counts.begin() + static_cast<std::ptrdiff_t>(at_start), counts.end()};
}

}  // namespace

TEST_CASE("casegen: a line of species is fed by shares of mass, of the start unless it is told otherwise") {
  const std::string header = printed(line_of_two);
  check_contains(header, {"int start_count = 8;", "int first_fed_kind = 8;", "[feed] mixture = [0.7",
                          "species_names[] = {\"large\", \"small\"};"});
  CHECK(fed_counts(header, 2) == std::vector<int>{375, 625});
  const std::vector<Run> runs = sizes_of(header);
  CHECK((runs[2].diameter == 0.01 && runs[2].density == 1000 && runs[2].species == 0));
  CHECK((runs[3].diameter == 0.005 && runs[3].density == 2000 && runs[3].species == 1));
  CHECK(fed_counts(printed(fed("[0.5, 0.5]")), 2) == std::vector<int>{200, 800});
  CHECK(fed_counts(printed(fed("[0.333, 0.667]")), 2) == std::vector<int>{111, 889});
  // A species that is not fed; the rarest has a hundred kinds. What is fed may go on as what is there at the start.
  CHECK(fed_counts(printed(fed("[1.0, 0.0]")), 2) == std::vector<int>{1000});
  CHECK(fed_counts(printed(fed("[0.0, 1.0]")), 1) == std::vector<int>{1005});
  CHECK(fed_counts(printed(fed("[0.04, 0.96]")), 2) == std::vector<int>{100, 9600});
  CHECK(fed_counts(printed(fed("[1e-9, 0.999999999]")), 2) == std::vector<int>{1, 1000000});
  // Room for what is smaller on average, of the start or of the feed: that of the feed here.
  const double small_only = 0.64 * 0.8 * 1.5 * 0.0025 / 0.125e-6;
  CHECK(contains(printed(fed("[0.0, 1.0]")),
                 "int particle_count = " + std::to_string(static_cast<int>(small_only + 0.5))));
}

TEST_CASE("casegen: mixtures that make no sense are refused") {
  const auto refused = [](const std::string& mixture, const std::vector<const char*>& words) {
    check_refused(fed(mixture), mixture, words);
  };
  refused("[0.2, 0.3, 0.5]",
          {"[feed] mixture = [0.2, 0.3, 0.5] has 3 numbers and there are 2 species; allowed: as many"});
  refused("[0.5, 0.4]", {"[feed] mixture = [0.5, 0.4] adds up to 0.9; allowed: 1", "not kilograms or per cent"});
  refused("[50, 50]", {"has 50 in it, which is out of range", "each 0 to 1"});
  refused("0.5", {"must be a list of numbers"});
  const std::string none = replaced(replaced(line_of_two, "count = 3", "count = 0"), "count = 5", "count = 0");
  check_refused(none, "[feed]",
                {"missing key 'mixture' in [feed], needed with several species of which none is there"});
  const std::string header = printed(fed("[0.5, 0.5]", none));
  check_contains(header, {"int start_count = 0;", "int first_fed_kind = 0;"});
  CHECK(fed_counts(header, 0) == std::vector<int>{200, 800});
  const std::string no_large = replaced(line_of_two, "count = 3", "count = 0");
  CHECK(fed_counts(printed(no_large), 0) == std::vector<int>{1005});
  check_refused(fed("[0.0, 1.0]", no_large), "0\ndiameter = 0.010",
                {"count = 0 of species \"large\", and none of it in [feed] mixture; allowed: one of them above 0"});
}

TEST_CASE(
    "casegen: one species that is fed is a line of equal spheres; a distribution is fed as a thousand quantiles") {
  const std::string pair = species("name = \"a\"\ncount = 2\ndiameter = 0.010\n");
  CHECK(members_of(opened(with_particles("density = 1000.0\n" + pair))) == members_of(line_case));
  const std::string none = species("count = 0\ndiameter = 0.010\n");
  CHECK(members_of(empty_line(replaced(line_case, "count = 2\n",
                                       "count = 0\n"
                                       "# count = 2\n"))) == members_of(empty_line()));
  CHECK(members_of(opened(with_particles("density = 1000.0\n" + none))) ==
        members_of(line_with("count = 2", "count = 0")));

  const std::string uniform = opened(distributed("distribution = \"uniform\"\nminimum = 0.004\nmaximum = 0.006\n", 5));
  std::vector<double> diameters;
  const std::string header = printed(uniform);
  for (const Run& run : sizes_of(header)) {
    CHECK(run.count == 1);
    diameters.push_back(run.diameter);
  }
  check_contains(header, {"int first_fed_kind = 5;", "int start_count = 5;"});
  REQUIRE(diameters.size() == 1005);
  CHECK(std::vector<double>(diameters.begin(), diameters.begin() + 5) ==
        std::vector<double>{0.005, 0.0054, 0.0046, 0.0058, 0.0042});
  std::sort(diameters.begin() + 5, diameters.end());
  CHECK(diameters[5] == 0.004001);
  CHECK(diameters[1004] == 0.005999);
  CHECK(sizes_of(printed(replaced(uniform, "count = 5", "count = 0"))).size() == 1000);
}

TEST_CASE("casegen: a line of several sizes starts from a case of the same particles") {
  const std::string from = replaced(line_of_two, random_start, "from = \"filling\"");
  const fs::path filling = scratch() / "filling.toml", mine = scratch() / "mine.toml";
  write(mine, from);
  write(filling, mixed_case);
  Outcome outcome = casegen("'" + mine.string() + "'");
  CHECK_MESSAGE(outcome.exit_code == 0, outcome.output);
  write(filling, replaced(mixed_case, "diameter = 0.005", "diameter = 0.006"));
  outcome = casegen("'" + mine.string() + "'");
  CHECK(outcome.exit_code == 3);
  check_contains(outcome.output, {"particle 3 has diameter 0.006 there and 0.005 here"});
}
