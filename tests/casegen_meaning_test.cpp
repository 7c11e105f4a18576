// tools/casegen: cases that are well written and cannot be meant, or that the models do not hold for.
#include <doctest/doctest.h>

#include "casegen_run.hpp"

using namespace casegen_test;

namespace {

const char* const duration = "duration = 1.2";

std::string with(const std::string& piece, const std::string& by) { return replaced(good_case, piece, by); }

}  // namespace

TEST_CASE("casegen refuses a gas over particles that gravity does not lay anywhere") {
  const auto pulled = [](const std::string& gravity) { return with(duration, "duration = 1.2\ngravity = " + gravity); };
  check_refused(
      pulled("[0, 0, 0]"), "[0, 0, 0]",
      {"[run] gravity = [0, 0, 0] with a [gas] table; allowed: any but zero", "a bed that weight holds together"});
  for (const char* gravity : {"[0, -3.7, 0]", "[-9.81, 0, 0]", "[0, 0, -9.81]", "[0, -9.7, -1]", "[0, 9.81, 0]"})
    check_quiet(pulled(gravity));
  check_quiet(replaced(pulled("[0, 0, 0]"), "count = 2", "count = 1"));  // one particle makes no bed
  check_quiet(without_gas(pulled("[0, 0, 0]")));
}

TEST_CASE("casegen warns of mixed precision where it does not pay") {
  const std::string mixed = with("integrator =", "precision = \"mixed\"\nintegrator =");
  check_warned(mixed, "\"mixed\"", {"precision = \"mixed\" with a [gas] table", "use precision = \"double\""});
  check_quiet(without_gas(mixed));
}

TEST_CASE("casegen warns of values whose unit must have been mistaken, and takes them") {
  check_warned(with("youngs_modulus = 3.0e9", "youngs_modulus = 3.0"), "3.0\n",
               {"youngs_modulus = 3 in [material] is not plausible", "plausible: 100000 to 2000000000000 Pa",
                "in pascal", "if the value is meant, leave it"});
  check_warned(with("density = 1000.0", "density = 1.0"), "1.0\n[mat", {"density = 1 in [particles]", "kg/m3"});
  check_warned(with("1.5e-5", "15"), "15\nslice", {"kinematic_viscosity = 15 in [gas]", "1e-08 to 0.01 m2/s"});
  check_warned(with("density = 1.2", "density = 0.0012"), "0.0012", {"density = 0.0012 in [gas]"});
  check_warned(with("bulk_velocity = 2.4", "bulk_velocity = 2400"), "2400", {"-340 to 340 m/s"});
  check_warned(with("friction = 0.3", "friction = 17"), "17", {"friction = 17 in [material]", "0 to 5"});
  check_warned(with(duration, "duration = 1.2\ngravity = [0, -9810, 0]"), "[0, -9810", {"-1000 to 1000 m/s2"});
  std::string large = with("diameter = 0.010", "diameter = 10");
  large = replaced(replaced(large, "diameter = 0.050", "diameter = 50"), "length = 0.800", "length = 800");
  large = replaced(large, "slice_length = 0.010", "slice_length = 10");
  check_warned(large, "10\ndensity", {"diameter = 10 in [particles]", "1e-06 to 0.5 m"});
  check_warned(large, "50\nlength", {"diameter = 50 in [pipe]"});
  check_quiet(good_case);
}

TEST_CASE("casegen warns of a contact that is resolved by far more steps than accuracy needs") {
  check_warned(with("time_step = 2.0e-6", "time_step = 2.0e-9"), "2.0e-9",
               {"steps per contact", "20 to some hundreds resolve it", "units"});
  check_warned(with("youngs_modulus = 3.0e9", "youngs_modulus = 3.0"), "2.0e-6", {"steps per contact", "units"});
  check_quiet(with("time_step = 2.0e-6", "time_step = 2.0e-7"));
}

TEST_CASE("casegen refuses times of more steps than can be counted, and sizes that cannot be computed with") {
  check_refused(with(duration, "duration = 1e14"), "1e14",
                {"[run] duration = 100000000000000 has more steps", "9e+15 steps = 1.8e+10 s"});
  check_refused(with(duration, "duration = 1e300"), "1e300", {"duration = 1e+300", "sizes go from 1e-50 to 1e50"});
  for (const std::string key : {"log_interval", "frame_interval", "sample_interval", "checkpoint_interval"})
    check_refused(with("log_interval = 0.1", key + " = 1e14"), "1e14",
                  {key.c_str(), "more steps than can be counted", "9e+15"});
  check_quiet(with("log_interval = 0.1", "checkpoint_interval = inf"));
  check_quiet(with("log_interval = 0.1", "log_interval = 1e9"));
  for (const std::string value : {"5e-324", "1e-60", "1.7e308"}) {
    check_refused(with("2.0e-6", value), value, {"time_step = ", "sizes go from 1e-50 to 1e50"});
    check_refused(with("density = 1000.0", "density = " + value), value, {"sizes go from 1e-50 to 1e50"});
    check_refused(with(duration, "duration = 1.2\ngravity = [0, -9, " + value + "]"), "[0, -9, ",
                  {"gravity", "sizes go from 1e-50 to 1e50"});
  }
  // A step of seconds: one error, at the step, and not at all that is shorter.
  check_refused(with("2.0e-6", "5"), "5\nduration",
                {"[run] time_step = 5 is longer than the run", "2.0e-6", "1 error "});
}

TEST_CASE("casegen: from is a name or a path from the case's folder; results go by the last part") {
  const fs::path folder = scratch() / "from";
  fs::remove_all(folder);
  const auto from = [](const std::string& name) { return with(random_start, "from = \"" + name + "\""); };
  write(folder / "other" / "fill.toml", from("deeper/drop"));
  write(folder / "other" / "deeper" / "drop.toml", good_case);
  const fs::path mine = folder / "mine" / "mine.toml";
  for (const std::string name : {"../other/fill", "../other/fill.toml", "../mine/../other/fill"}) {
    write(mine, from(name));
    const Outcome printed = casegen("'" + mine.string() + "' --print");
    CHECK_MESSAGE(printed.exit_code == 0, printed.output);
    CHECK_MESSAGE(contains(printed.output, "start_from = \"fill\";"), printed.output);
    const std::string path = casegen("--start-from '" + mine.string() + "'").output;
    REQUIRE(path.ends_with(".toml\n"));
    CHECK(fs::equivalent(path.substr(0, path.size() - 1), folder / "other" / "fill.toml"));
  }
  write(mine, from("/nowhere/fill"));
  CHECK(contains(casegen("'" + mine.string() + "'").output, "there is no file /nowhere/fill.toml"));

  const auto refused = [&](const std::string& name) {
    write(mine, from(name));
    const Outcome outcome = casegen("'" + mine.string() + "'");
    CHECK_MESSAGE(outcome.exit_code == 3, name, outcome.output);
    return outcome.output;
  };
  // Nothing that means something to a shell or to make, and no option.
  for (const std::string name :
       {"a;b", "$(id)", "`id`", "a b", "a'b", "a%b",  "a:b",   "a=b",   "a#b",   "a&b",    "~/x",
        "-x",  "x/-y",  "..",   "../", "a/",  "x/.y", ".toml", "a\\nb", "a\\tb", "\\u00e4"})
    CHECK_MESSAGE((contains(refused(name), "no name or path of a case; allowed: letters, digits") ||
                   contains(refused(name), "control characters")),
                  name);
  // The nearest name, never the case itself.
  CHECK(contains(refused("../other/fil"), "did you mean \"../other/fill\"?"));
  CHECK_FALSE(contains(refused("min"), "did you mean"));
  CHECK(contains(refused("min"), "write that case first"));
  // Circles by any path; a case of the same name elsewhere would share the folder of results.
  CHECK(contains(refused("../mine/mine"), "circle: mine -> mine"));
  write(folder / "other" / "mine.toml", good_case);
  CHECK(contains(refused("../other/mine"), "the same name as this one"));
}
