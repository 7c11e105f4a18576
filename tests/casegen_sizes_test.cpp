// tools/casegen: what several sizes change elsewhere: rooms, advice on the time step, and the case to start from.
#include <doctest/doctest.h>

#include <cmath>

#include "casegen_size_cases.hpp"

using namespace casegen_test;

namespace {

std::string of_diameters(const std::string& one, const std::string& other, const std::string& text = good_case) {
  return replaced(text, "count = 2\ndiameter = 0.010\ndensity = 1000.0\n",
                  "density = 1000.0\n" + species("count = 4\ndiameter = " + one + "\n") +
                      species("count = 4\ndiameter = " + other + "\n"));
}

std::string advice(const std::string& text) {
  write(scratch() / "advice.toml", text);
  return casegen("'" + (scratch() / "advice.toml").string() + "' --advice").output;
}

/// What casegen says to a case that starts from another.
Outcome started_from(const std::string& before, const std::string& text) {
  write(scratch() / "from" / "filling.toml", before);
  write(scratch() / "from" / "mine.toml", replaced(text, random_start, "from = \"filling\""));
  return casegen("'" + (scratch() / "from" / "mine.toml").string() + "'");
}

}  // namespace

TEST_CASE("casegen: room for neighbours follows from the ratio of diameters") {
  const std::string plain = replaced(good_case, "[capacity]\nneighbours = 14\n", "");
  const auto room = [&](const char* smallest, const char* words) {
    const std::string header = printed(replaced(of_diameters("0.010", smallest, plain), "2.0e-6", "2.0e-7"));
    CHECK_MESSAGE(contains(header, std::string("neighbour_capacity = ") + words + ";"), smallest);
  };
  room("0.010", "15");
  room("0.0066666666666666667", "23");
  room("0.005", "33");
  room("0.0033333333333333333", "58");
  room("0.002", "130");
  room("0.001", "160");
  CHECK(contains(printed(plain), "neighbour_capacity = 14;"));
  printed(replaced(mixed_case, "neighbours = 14", "neighbours = 160"));
  check_refused(replaced(mixed_case, "neighbours = 14", "neighbours = 161"), "161", {"2 to 160"});
  check_refused(replaced(good_case, "neighbours = 14", "neighbours = 31"), "31",
                {"with equal spheres; allowed: 2 to 30"});
}

TEST_CASE("casegen: lengths that are one diameter are one of the largest, and the gas takes the Sauter diameter") {
  const std::string plain = replaced(mixed_case, "slice_length = 0.010\n", "");
  CHECK(contains(printed(plain), "int slice_count = 80;"));
  CHECK(contains(printed(plain), "double gas_bed_diameter = 0x0p+0;"));
  CHECK(contains(printed(replaced(plain, "[gas]\n", "[gas]\nbed_diameter = 0.0078125\n")),
                 "double gas_bed_diameter = 0x1p-7;"));
}

TEST_CASE("the advice names the pair of species and the wall with the shortest contact, and the sizes") {
  const std::string mixed = advice(mixed_case);
  CAPTURE(mixed);
  CHECK(contains(mixed,
                 "2 species: large of 0.01 m, small of 0.005 m; diameters: smallest 0.005, mean 0.006875, Sauter "
                 "0.008529, largest 0.01 m\n"));
  CHECK(contains(mixed, "wall contact   4.553e-05 s (small): "));
  // As two equal ones of that size and density.
  const std::string alone = advice(
      replaced(replaced(good_case, "diameter = 0.010", "diameter = 0.005"), "density = 1000.0", "density = 2000"));
  const auto time_of = [](const std::string& text) { return text.substr(text.find("contact   "), 21); };
  CHECK(contains(mixed, time_of(alone) + " (small with small)"));
  // One light sphere meets only others: the pair of two species is the shortest. M = m/2.2, R* = r/2.2.
  const std::string light =
      with_particles("density = 1000.0\n" + species("name = \"a\"\ncount = 1\ndiameter = 0.005\n") +
                     species("name = \"b\"\ncount = 3\ndiameter = 0.006\n"));
  const std::string said = advice(light);
  CAPTURE(said);
  const double m = 1000 * 3.14159265358979 / 6 * 0.125e-6, m2 = m * 1.728, reduced = m * m2 / (m + m2);
  const double radius = 0.0025 * 0.003 / 0.0055,
               stiffness = 4.0 / 3 * std::sqrt(radius) * 3e9 / (2 * (1 - 0.33 * 0.33));
  const double expected = 2.9433 * std::pow(15 * reduced * 2.4 * 2.4 / (12 * stiffness), 0.4) / 2.4;
  const auto at = said.find("pair contact   ");
  REQUIRE(at != std::string::npos);
  CHECK(std::stod(said.substr(at + 15)) == doctest::Approx(expected).epsilon(1e-3));
  CHECK(contains(said, " s (a with b): "));
  // Of a distribution the smallest count.
  const std::string many = advice(distributed("distribution = \"uniform\"\nminimum = 0.004\nmaximum = 0.006\n", 2));
  CHECK_MESSAGE(contains(many, "uniform sizes; diameters: smallest 0.0045, mean 0.005, Sauter 0.005099"), many);
  CHECK_MESSAGE(contains(many, "(smallest with smallest)"), many);
  // A time step that is right for the large ones only is warned of.
  const std::string text = replaced(of_diameters("0.010", "0.002"), "2.0e-6", "1.5e-6");
  CHECK(contains(advice(text), ":" + position_of(text, "1.5e-6") + ": warning: [run] time_step = 1.5e-06 gives only"));
}

TEST_CASE("casegen: with the linear law the lightest sphere counts") {
  std::string text = replaced(mixed_case, "youngs_modulus = 3.0e9\npoisson_ratio = 0.33\n", "");
  text =
      replaced(text, "normal = \"hertz\"", "normal = \"linear\"\nnormal_stiffness = 1e4\ntangential_stiffness = 5e3");
  const std::string said = advice(text);
  const double mass = 2000 * 3.14159265358979 / 6 * 0.125e-6;
  const auto number_after = [&](const std::string& words) {
    const auto at = said.find(words);
    REQUIRE_MESSAGE(at != std::string::npos, said);
    return std::stod(said.substr(at + words.size()));
  };
  CHECK(number_after("pair contact   ") == doctest::Approx(3.14159265358979 * std::sqrt(mass / 2 / 1e4)).epsilon(1e-3));
  CHECK(number_after("eq. (39) limit ") == doctest::Approx(2 * std::sqrt(mass / 1e4)).epsilon(1e-3));
}

TEST_CASE("casegen: a case starts from one whose particles have the same diameters and densities") {
  const auto accepted = [](const std::string& before, const std::string& text) {
    const Outcome outcome = started_from(before, text);
    CHECK_MESSAGE(outcome.exit_code == 0, outcome.output);
  };
  const auto refused = [](const std::string& before, const std::string& text, const std::string& words) {
    const Outcome outcome = started_from(before, text);
    CAPTURE(outcome.output);
    CHECK(outcome.exit_code == 3);
    CHECK(contains(outcome.output, "[start] from = \"filling\"" + words));
    return outcome.output;
  };
  const std::string same = "allowed: the same diameters and densities, number by number";
  accepted(mixed_case, mixed_case);
  accepted(mixed_case, replaced(mixed_case, "\"large\"", "\"coarse\""));
  CHECK(contains(refused(mixed_case, replaced(mixed_case, "diameter = 0.005", "diameter = 0.006"),
                         ": particle 3 has diameter 0.005 there and 0.006 here; " + same),
                 "the same [[particles.species]] in the same order"));
  refused(mixed_case, replaced(mixed_case, "density = 2000", "density = 2001"),
          ": particle 3 has density 2000 there and 2001 here; " + same);
  const std::string shifted = replaced(replaced(mixed_case, "count = 3", "count = 4"), "count = 5", "count = 4");
  refused(mixed_case, shifted, ": particle 3 has diameter 0.005 there and 0.01 here; " + same);
  refused(mixed_case, replaced(mixed_case, "count = 3", "count = 4"), " has 8 particles; allowed: as many as here, 9");
  refused(replaced(good_case, "count = 2", "count = 8"), mixed_case, ": particle 3 has diameter 0.01 there and 0.005");
  refused(mixed_case, replaced(good_case, "count = 2", "count = 8"), ": particle 3 has diameter 0.005 there and 0.01");
  // Two kinds of the same material and size are as good as equal spheres.
  accepted(replaced(good_case, "count = 2", "count = 8"), of_diameters("0.010", "0.010"));
  const std::string uniform = distributed("distribution = \"uniform\"\nminimum = 0.004\nmaximum = 0.006\n", 40);
  accepted(uniform, uniform);
  refused(uniform, replaced(uniform, "minimum = 0.004\n", "minimum = 0.004\nseed = 2\n"), ": particle ");
}
