// tools/casegen: what it refuses, where it points, and that what it writes is exactly what the case file says.
//
// Every refusal starts from one good case, with one thing changed; the position of the error is worked out from the
// changed text, never written by hand.
#include <cmath>
#include <cstdlib>

#include "casegen_run.hpp"

using namespace casegen_test;

namespace {

int warnings_in(const std::string& output) {
  int count = 0;
  for (auto at = output.find(": warning: "); at != std::string::npos; at = output.find(": warning: ", at + 1)) ++count;
  return count;
}

}  // namespace

TEST_CASE("casegen refuses bad cases with place, value, allowed range and advice") {
  for (const auto& bad : casegen_test::bad_cases)
    check_refused(replaced(good_case, bad.piece, bad.by), bad.at, bad.words);
}

TEST_CASE("casegen writes a budget of memory in bytes, and none without") {
  const fs::path file = scratch() / "budget.toml", filling = scratch() / "filling.toml";
  write(filling, replaced(good_case, "count = 2", "count = 7"));
  const auto header_of = [&](const char* memory) {
    write(file, replaced(good_case, "neighbours = 14", memory));
    const Outcome outcome = casegen("'" + file.string() + "' --print");
    CHECK(outcome.exit_code == 0);
    return outcome.output;
  };
  CHECK(contains(header_of("memory = \"256 KiB\""), "static constexpr long long memory_budget = 262144;"));
  CHECK(contains(header_of("memory = \"2 MiB\""), "memory_budget = 2097152;"));
  CHECK(contains(header_of("memory = \"1000 B\""), "memory_budget = 1000;"));
  CHECK(contains(header_of("memory = 1000"), "memory_budget = 1000;"));
  CHECK_FALSE(contains(header_of("neighbours = 14"), "memory_budget"));
}

TEST_CASE("casegen refuses placed particles that are outside, overlap, spin without friction or are miscounted") {
  const auto placed = [](const std::string& particles) {
    return replaced(good_case, casegen_test::random_start, "") + particles;
  };
  const std::string first = "[[start.particle]]\nposition = [0, 0, 0.001]\n",
                    second = "[[start.particle]]\nposition = ";
  const Outcome good = [&] {
    write(scratch() / "placed.toml", placed(first + second + "[0.0, 0.0, 0.02]\n"));
    return casegen("'" + (scratch() / "placed.toml").string() + "'");
  }();
  CHECK_MESSAGE(good.exit_code == 0, good.output);
  check_refused(placed(first + second + "[0.03, 0, 0.02]\n"), "[0.03",
                {"(particle 1) is outside", "at most 0.0025", "0.02 m of the axis"});
  check_refused(placed(first + second + "[0, 0, 0.9]\n"), "[0, 0, 0.9]", {"outside the pipe", "z from 0 to 0.8"});
  check_refused(placed(first + second + "[0, 0, 0.004]\n"), "[0, 0, 0.004]",
                {"overlaps particle 0 by 0.007 m", "at most 0.0025"});
  check_refused(placed(first + second + "[0, 0, 0.797]\n"), "[0, 0, 0.797]",
                {"overlaps particle 0 by 0.006 m"});  // across the ends
  check_refused(placed(first), "2\ndiameter", {"[particles] count = 2", "places 1", "set count = 1"});
  check_refused(placed(first + "velocity = [0, 0]\n" + second + "[0, 0, 0.02]\n"), "[0, 0]\n",
                {"velocity = [0, 0] in [[start.particle]]", "must have three"});
  check_refused(placed(first + "positon = [0, 0, 0]\n" + second + "[0, 0, 0.02]\n"), "positon",
                {"did you mean 'position'?"});
  check_refused(replaced(placed(first + second + "[0, 0, 0.02]\nangular_velocity = [0, 9, 0]\n"), "friction = 0.3",
                         "friction = 0"),
                "[0, 9", {"angular_velocity = [0, 9, 0] with friction = 0"});
}

TEST_CASE("casegen reports every error of a file in one pass, in the order of the file, and syntax errors too") {
  std::string text = replaced(good_case, "count = 2", "count = -2");
  text = replaced(text, "friction = 0.3", "fricton = 0.3");
  text = replaced(text, "neighbours = 14", "neighbours = 1");
  check_refused(text, "-2", {"count = -2", "did you mean 'friction'", "neighbours = 1", "3 errors in"});
  const std::string output = casegen("'" + (scratch() / "bad" / "mine.toml").string() + "'").output;
  CHECK(output.find("count = -2") < output.find("fricton"));
  CHECK(output.find("fricton") < output.find("neighbours = 1"));
  check_refused(replaced(good_case, "seed = 3", "seed = 3 4"), "4\n[run]", {"one key = value"});
  check_refused(replaced(good_case, "seed = 3", "seed = 3\nseed = 4"), "4\n[run]",
                {"redefine", "stands in the file twice"});
  check_refused(replaced(good_case, "[capacity]", "[[{}]]"), "title", {"cannot be parsed", "this is not TOML"});
  check_refused(replaced(good_case, "seed = 3", "seed = 3 \u2013"), "\u2013", {"not ASCII", "type it anew"});
}

TEST_CASE("every number of a generated header reads back as the case file's own") {
  const std::vector<std::pair<const char*, const char*>> numbers = {{"diameter", "0.010000000000000002"},
                                                                    {"density", "1234.5678901234567"},
                                                                    {"restitution", "0.1"},
                                                                    {"poisson_ratio", "0.3333333333333333"},
                                                                    {"time_step", "1.9999999999999998e-6"},
                                                                    {"gas_viscosity", "1.0000000000000002e-50"},
                                                                    {"gas_velocity", "-9.9999999999999987e49"},
                                                                    {"duration", "2"},
                                                                    {"wall_youngs_modulus", "inf"}};
  std::string text = replaced(good_case, "3.0e9", "3.0e9\nwall_youngs_modulus = inf");
  const std::vector<std::string> originals = {"diameter = 0.010",     "density = 1000.0",   "restitution = 0.9",
                                              "poisson_ratio = 0.33", "time_step = 2.0e-6", "viscosity = 1.5e-5",
                                              "bulk_velocity = 2.4",  "duration = 1.2"};
  for (std::size_t k = 0; k < originals.size(); ++k)
    text = replaced(text, originals[k], originals[k].substr(0, originals[k].find('=')) + "= " + numbers[k].second);
  text = replaced(text, "slice_length = 0.010", "slice_length = 0.02");
  write(scratch() / "exact.toml", text);
  const std::string header = casegen("'" + (scratch() / "exact.toml").string() + "' --print").output;
  for (const auto& number : numbers) {
    const std::string member = number.first;
    CAPTURE(header);
    const std::string start = "static constexpr double " + member + " = ";
    REQUIRE(contains(header, start));
    const std::string rest = header.substr(header.find(start) + start.size());
    const double found = rest.starts_with("__builtin_inf()") ? INFINITY : std::strtod(rest.c_str(), nullptr);
    CHECK_MESSAGE(found == std::strtod(number.second, nullptr), member);
  }
  CHECK(contains(header, "unsigned long long seed = 3ULL;"));
  CHECK(contains(header, "int slice_count = 40;"));
  CHECK(contains(header, "has_gas = true;"));
}

TEST_CASE("every shipped case makes a header, twice the same, and an unchanged header keeps its time stamp") {
  int cases = 0;
  for (const auto& file : fs::directory_iterator(FIXDEM_CASES_DIR)) {
    if (file.path().extension() != ".toml") continue;
    ++cases;
    const std::string name = file.path().stem().string();
    const fs::path header = scratch() / "shipped" / (name + ".hpp");
    fs::remove(header);
    const std::string command =
        "'" + file.path().string() + "' --source-label x.toml --output '" + header.string() + "'";
    const Outcome outcome = casegen(command);
    CAPTURE(outcome.output);
    REQUIRE(outcome.exit_code == 0);
    const std::string text = read(header);
    CHECK(contains(text, "struct " + name + " {"));
    // 2e-6 s, less where some particles are smaller; more in lines, which are long and made of a soft material, and in
    // large scenes, which are, too, and take contacts as impulses.
    const bool is_line = contains(text, "ends = Ends::open;");
    if (contains(text, "integrator = Integrator::impulse;")) {
      CHECK((contains(text, "double time_step = 0x1.4f8b588e368f1p-17;") ||
             contains(text, "double time_step = 0x1.f75104d551d69p-16;")));
      CHECK(warnings_in(outcome.output) <= 1);
    } else if (is_line) {
      CHECK(contains(text, "double time_step = 0x1.a36e2eb1c432dp-15;"));
      CHECK(warnings_in(outcome.output) == 1);
      CHECK(contains(outcome.output, "steps per contact"));
    } else {
      CHECK(warnings_in(outcome.output) == 0);
      CHECK((contains(text, "double time_step = 0x1.0c6f7a0b5ed8dp-19;") || contains(text, "SizeRun sizes[] = {")));
    }
    CHECK(contains(text, "source = \"x.toml\";"));
    const auto earlier = fs::last_write_time(header) - std::chrono::hours(1);
    fs::last_write_time(header, earlier);
    CHECK(casegen(command).exit_code == 0);
    CHECK(read(header) == text);
    CHECK(fs::last_write_time(header) == earlier);
  }
  CHECK(cases == 35);
}

TEST_CASE("the advice has the contact times of the literature, and warns below 20 steps per contact") {
  const auto advice = [](const std::string& text) {
    write(scratch() / "advice.toml", text);
    return casegen("'" + (scratch() / "advice.toml").string() + "' --advice").output;
  };
  // Chung & Ooi (2011), tests 1 and 2: equal glass spheres at +-10 m/s, 40.340 us; aluminium on a rigid wall, 731.66
  // us.
  std::string glass = replaced(replaced(good_case, "3.0e9", "48e9"), "poisson_ratio = 0.33", "poisson_ratio = 0.2");
  glass = replaced(replaced(glass, "diameter = 0.010", "diameter = 0.02"), "density = 1000.0", "density = 2800");
  glass =
      replaced(replaced(glass, "slice_length = 0.010", ""), "duration = 1.2", "duration = 1.2\nreference_speed = 20");
  CHECK_MESSAGE(contains(advice(glass), "pair contact   4.034e-05 s"), advice(glass));
  std::string metal = replaced(replaced(glass, "48e9", "70e9\nwall_youngs_modulus = inf"), "= 0.2\n", "= 0.3\n");
  metal = replaced(replaced(metal, "diameter = 0.02", "diameter = 0.2"), "density = 2800", "density = 2699");
  metal =
      replaced(replaced(metal, "diameter = 0.050", "diameter = 1"), "reference_speed = 20", "reference_speed = 0.2");
  CHECK_MESSAGE(contains(advice(metal), "wall contact   0.0007317 s"), advice(metal));
  CHECK_FALSE(contains(advice(good_case), "warning"));
  const std::string coarse = advice(replaced(good_case, "2.0e-6", "4e-6"));
  CHECK(contains(coarse, "advice.toml:" + position_of(good_case, "2.0e-6") + ": warning: [run] time_step = 4e-06"));
}

TEST_CASE("casegen's other options, exit codes and the table of keys in cases/README.md") {
  const std::string cases = FIXDEM_CASES_DIR;
  CHECK(casegen("").exit_code == 2);
  CHECK(casegen("--unknown x.toml").exit_code == 2);
  CHECK(casegen("'" + (scratch() / "nowhere.toml").string() + "'").exit_code == 6);
  CHECK(casegen("'" + cases + "/settle.toml' --output /dev/null/x.hpp").exit_code == 6);
  CHECK(casegen("--help").exit_code == 0);
  CHECK(contains(casegen("--version").output, "casegen "));
  CHECK(casegen("--start-from '" + cases + "/plug_u24.toml'").output == cases + "/fill_1000.toml\n");
  CHECK(casegen("--start-from '" + cases + "/settle.toml'").output.empty());
  CHECK(casegen("--name some/plug-2.toml").output == "plug_2\n");
  CHECK(casegen("--name gravity.toml").output == "case_gravity\n");  // a member of the header
  for (const std::string name : {"wall_friction", "rolling_friction", "friction_limit", "tile_steps", "feed_rate",
                                 "probes"})  // not in every header
    CHECK(casegen("--name " + name + ".toml").output == "case_" + name + "\n");
  CHECK(casegen("--name elastic.toml").output == "elastic\n");
  const std::string readme = read(cases + "/README.md"), keys = casegen("--keys").output;
  CHECK_MESSAGE(contains(readme, "<!-- keys table -->\n" + keys + "<!-- end -->"),
                "put the output of casegen --keys there");
}
