// tools/casegen: kinds of particles: what the header says of them, and what is refused.
#include <doctest/doctest.h>

#include "casegen_size_cases.hpp"

using namespace casegen_test;

namespace {

void check_sizes(const std::string& header, const std::vector<Run>& expected) {
  CAPTURE(header);
  const std::vector<Run> found = sizes_of(header);
  REQUIRE(found.size() == expected.size());
  for (std::size_t k = 0; k < found.size(); ++k) {
    CHECK(found[k].count == expected[k].count);
    CHECK(found[k].diameter == expected[k].diameter);
    CHECK(found[k].density == expected[k].density);
    CHECK(found[k].species == expected[k].species);
  }
}

/// What depends on the file's own words: its hash, and the list of keys, which has the species.
std::string without_keys(const std::string& header) {
  const auto at = header.find("  static constexpr const char* keys = ");
  const std::string kept = header.substr(0, at) + header.substr(header.find('\n', at) + 1);
  return members(kept.substr(kept.find("struct ")));
}

const std::string ends_apart = "position = [0, 0, 0.1]\nspecies = ", in_between = "position = [0, 0, 0.2]\nspecies = ",
                  at_last = "position = [0, 0, 0.3]\nspecies = ";

}  // namespace

TEST_CASE("casegen: species are in header and keys, in the order of the file") {
  const std::string header = printed(mixed_case);
  check_sizes(header, {{3, 0.01, 1000, 0}, {5, 0.005, 2000, 1}});
  for (const char* words :
       {"int particle_count = 8;", "double largest_diameter = 0x1.47ae147ae147bp-7;",
        "double smallest_diameter = 0x1.47ae147ae147bp-8;", "double reference_density = 0x1.f4p+9;",
        "int species_count = 2;", "species_names[] = {\"large\", \"small\"};", "double gas_bed_diameter = 0x0p+0;",
        "int neighbour_capacity = 14;", "int slice_count = 80;", "[[particles.species]] 0 density = 1000\\012",
        "[[particles.species]] 1 name = \\\"small\\\"\\012", "[[particles.species]] 1 count = 5\\012",
        "[[particles.species]] 1 diameter = 0.005\\012"})
    CHECK_MESSAGE(contains(header, words), words);
  for (const char* words : {" double diameter =", " double density =", "[particles] "})
    CHECK_MESSAGE(!contains(header, words), words);
  const double volume = std::stod(header.substr(header.find("mean_volume = ") + 14));
  CHECK(volume == doctest::Approx(3.14159265358979 / 6 * (3 * 1e-6 + 5 * 0.125e-6) / 8).epsilon(1e-14));
  // The heaviest of the largest is the sphere of reference.
  const std::string heavy = printed(
      with_particles(large + "density = 500\n" + small + species("count = 1\ndiameter = 0.010\ndensity = 700\n")));
  CHECK(contains(heavy, "double reference_density = 0x1.5ep+9;"));
  CHECK(contains(heavy, "species_names[] = {\"large\", \"small\", \"2\"};"));
}

TEST_CASE("casegen: one species alone is the case of equal spheres") {
  const std::string plain = printed(good_case), pair = species("name = \"a\"\ncount = 2\ndiameter = 0.010\n");
  CHECK(members_of(with_particles("density = 1000.0\n" + pair)) == members_of(good_case));
  CHECK(members_of(with_particles(pair + "density = 1000.0\n")) == members_of(good_case));
  const std::vector<std::string> places = {"position = [0, 0, 0.1]\n", "position = [0, 0, 0.2]\n"};
  const std::vector<std::string> named = {places[0] + "species = 0\n", places[1] + "species = \"a\"\n"};
  CHECK(members_of(placed(with_particles("density = 1000.0\n" + pair), named)) ==
        members_of(placed(good_case, places)));
  // Two of the same size are told apart: tracers.
  const std::string tracers = printed(with_particles("density = 1000.0\n" + species("count = 1\ndiameter = 0.010\n") +
                                                     species("count = 1\ndiameter = 0.010\n")));
  check_sizes(tracers, {{1, 0.01, 1000, 0}, {1, 0.01, 1000, 1}});
  CHECK(contains(tracers, "species_names[] = {\"0\", \"1\"};"));
  // Nothing else than sizes, list of keys and room depends on there being several.
  const std::string expected =
      replaced(without_keys(plain), "  static constexpr double diameter = 0x1.47ae147ae147bp-7;  // 0.01 m\n", "");
  std::string found = without_keys(tracers);
  const auto first = found.find("  static constexpr double largest_diameter"),
             last = found.find("  static constexpr double youngs");
  found.erase(first, last - first);
  found = replaced(found, "gas_bed_diameter = 0x0p+0;  // 0 m", "gas_bed_diameter = 0x1.47ae147ae147bp-7;  // 0.01 m");
  CHECK(found == replaced(expected, "  static constexpr double density = 0x1.f4p+9;  // 1000 kg/m3\n", ""));
}

TEST_CASE("casegen: placed particles are of a species by number or name, and keep the order of the file") {
  const std::string text =
      with_particles("density = 1000.0\n" + species("name = \"a\"\ncount = 2\ndiameter = 0.010\n") +
                     species("count = 1\ndiameter = 0.005\n"));
  const std::string header = printed(placed(text, {ends_apart + "1", in_between + "\"a\"", at_last + "0"}));
  check_sizes(header, {{1, 0.005, 1000, 1}, {2, 0.01, 1000, 0}});
  CHECK(contains(header, "[[start.particle]] 0 species = 1\\012"));
  CHECK(contains(header, "[[start.particle]] 1 species = 0\\012"));
  check_refused(placed(text, {ends_apart + "1", in_between + "0", "position = [0, 0, 0.3]"}),
                "[[start.particle]]\nposition = [0, 0, 0.3]",
                {"missing key 'species' in [[start.particle]], needed with [[particles.species]]"});
  check_refused(placed(text, {ends_apart + "1", in_between + "0", at_last + "\"b\""}), "\"b\"",
                {"[[start.particle]] species = \"b\" is no species; allowed: 0 to 1, or \"a\", \"1\""});
  check_refused(placed(text, {ends_apart + "1", in_between + "0", at_last + "-1"}), "-1",
                {"species = -1 in [[start.particle]] is out of range", "from 0 on, or its name"});
  check_refused(placed(text, {ends_apart + "1", in_between + "0", at_last + "1"}), "2\ndiameter",
                {"[[particles.species]] count = 2 of species \"a\"", "places 1 of it; allowed: as many as are placed"});
  check_refused(placed(good_case, {ends_apart + "0", in_between + "0"}), "0\n[[start",
                {"species = 0 without [[particles.species]]; allowed: only with them"});
}

TEST_CASE("casegen: placed particles are compared with their own radii") {
  const std::string text = with_particles("density = 1000.0\n" + species("count = 1\ndiameter = 0.010\n") +
                                          species("count = 1\ndiameter = 0.002\n"));
  const auto at = [&](const std::string& z) {
    return placed(text, {"position = [0, 0, " + z + "]\nspecies = 1", "position = [0, 0, 0.1]\nspecies = 0"});
  };
  printed(at("0.0945"));  // an overlap of half of the smaller radius
  check_refused(at("0.0946"), "[0, 0, 0.0946",
                {"(particle 0) overlaps particle 1 by 0.0006 m; allowed: at most 0.0005"});
  const auto beside = [&](const std::string& x, int kind) {
    const std::string other = "position = [0, 0, 0.3]\nspecies = " + std::to_string(1 - kind);
    return placed(text, {"position = [" + x + ", 0, 0.1]\nspecies = " + std::to_string(kind), other});
  };
  printed(beside("0.0244", 1));
  check_refused(beside("0.0246", 1), "[0.0246", {"(particle 0) is outside", "0.024 m of the axis"});
  printed(beside("0.0204", 0));
  check_refused(beside("0.0206", 0), "[0.0206", {"(particle 0) is outside", "0.02 m of the axis"});
}

TEST_CASE("casegen refuses species that make no sense") {
  const std::string density = "density = 1000.0\n";
  check_refused(with_particles("count = 8\ndensity = 1000.0\n" + large + small), "count = 8",
                {"[particles] count = 8 together with [[particles.species]]; allowed: one of them",
                 "remove it: it is the sum of the species' counts"});
  check_refused(with_particles("diameter = 0.010\n" + density + large), "diameter = 0.010",
                {"[particles] diameter = 0.01 together with [[particles.species]]", "each species has its own"});
  check_refused(with_particles(large + small), "[[particles.species]]",
                {"missing key 'density' in [[particles.species]] and in [particles]", "kg/m3"});
  check_refused(with_particles(density + large + species("diameter = 0.005\n")), "[[particles.species]]\ndiameter",
                {"missing key 'count' in [[particles.species]]"});
  check_refused(with_particles(density + large + species("count = 5\n")), "[[particles.species]]\ncount",
                {"missing key 'diameter' in [[particles.species]]"});
  check_refused(with_particles(density + large + species("count = 0\ndiameter = 0.005\n")), "0\ndiameter = 0.005",
                {"[[particles.species]] count = 0; allowed: 1 to 10000000, and 0 with [pipe] ends = \"open\""});
  check_refused(with_particles(density + species("count = 9000000\ndiameter = 1e-5\n") +
                               species("count = 1000001\ndiameter = 1e-5\n")),
                "1000001", {"makes 10000001 particles of all species; allowed: at most 10000000"});
  check_refused(
      replaced(mixed_case, "0.005", "0.00099"), "0.010",
      {"[[particles.species]] diameter = 0.01", "is 10.1 times the smallest, 0.00099; allowed: at most 10 times"});
  printed(replaced(replaced(mixed_case, "0.005", "0.001"), "2.0e-6", "2.0e-7"));
  check_refused(replaced(mixed_case, "0.010", "0.05"), "0.05\n",
                {"[[particles.species]] diameter = 0.05 is wider than the pipe; allowed: below [pipe] diameter = 0.05",
                 "lower the largest diameter"});
  check_refused(replaced(mixed_case, "length = 0.800", "length = 0.039"), "0.039",
                {"at least 4 of the largest particle diameters = 0.04"});
  check_refused(replaced(mixed_case, "slice_length = 0.010", "slice_length = 0.009"), "0.009",
                {"from one of the largest particle diameters = 0.01"});
  check_refused(replaced(mixed_case, "\"large\"", "\"the large\""), "\"the large\"",
                {"name = \"the large\" in [[particles.species]] has other signs in it", "letters, digits, _ and -"});
  check_refused(replaced(mixed_case, "\"small\"", "\"large\""), "\"large\"\ncount = 5",
                {"name = \"large\" is the name of species 0, too"});
  check_refused(replaced(mixed_case, "\"small\"", "\"0\""), "\"0\"",
                {"is the number of another species; allowed: 1 or"});
  check_refused(replaced(mixed_case, "slider = \"exact\"", "damping_mass = \"particle\""), "\"particle\"",
                {"[contact] damping_mass = \"particle\" with particles of several sizes; allowed: \"reduced\"",
                 "the two masses of a contact differ"});
  std::string many = density;
  for (int k = 0; k < 16; ++k) many += species("count = 1\ndiameter = 0.010\n");
  printed(with_particles(many));
  many += species("name = \"one_more\"\ncount = 1\ndiameter = 0.010\n");
  check_refused(with_particles(many), species("name = \"one_more"),
                {"17 [[particles.species]] tables; allowed: at most 16"});
  check_refused(with_particles(density + "[particles.species]\ncount = 2\n"), "[particles.species]",
                {"'species' in [particles] must be a list of tables", "two pairs of brackets"});
  check_refused(with_particles(density + "species = []\n"), "[]", {"[[particles.species]] has no entries"});
  check_refused(with_particles(density + "species = [1]\n"), "1]",
                {"an entry of [[particles.species]] is a whole number"});
  check_refused(with_particles(density + large + "diametre = 1\n" + small), "diametre",
                {"unknown key 'diametre' in [[particles.species]]", "did you mean 'diameter'?"});
  check_refused(replaced(good_case, "title = \"A good case\"", "\"particles.species\" = 1"), "\"particles.species\"",
                {"unknown table or key 'particles.species' at the top"});
}

TEST_CASE("casegen: the solids fraction is that of the sum of all volumes") {
  // The pipe holds 1570.8 cm3; spheres of 10 and of 5 mm have 0.5236 and 0.0654 cm3.
  const auto filled = [](int number, int of_small) {
    return with_particles("density = 1000.0\n" + species("count = " + std::to_string(number) + "\ndiameter = 0.010\n") +
                          species("count = " + std::to_string(of_small) + "\ndiameter = 0.005\n"));
  };
  printed(filled(1349, 8));
  check_refused(filled(1349, 9), "\"random\"", {"of count = 1358 fills 0.450 of the pipe; allowed: at most 0.45"});
  const auto from = [](const std::string& text) { return replaced(text, random_start, "from = \"filling\""); };
  check_refused(from(filled(2500, 401)), "2500", {"count = 2500: all particles would fill 0.850", "at most 0.85"});
  const fs::path fill = scratch() / "filling.toml", mine = scratch() / "mine.toml";
  write(fill, replaced(filled(2500, 400), "length = 0.800", "length = 1.6"));
  write(mine, from(filled(2500, 400)));
  const Outcome outcome = casegen("'" + mine.string() + "'");
  CHECK_MESSAGE(outcome.exit_code == 0, outcome.output);
}
