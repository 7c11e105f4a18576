// tools/casegen: open lines: what the header says of them, what is refused, what is warned of.
#include <doctest/doctest.h>

#include "casegen_line_cases.hpp"

using namespace casegen_test;

TEST_CASE("casegen: a line is in header and keys, with room for what its pipe can hold") {
  const std::string header = printed(line_case);
  check_contains(header,
                 {"Ends ends = Ends::open;", "int particle_count = 1920;", "int start_count = 2;",
                  "TimeValue feed_rate[] = {{0x0p+0, 0x1p-2}};", "double feed_start = 0x0p+0;",
                  "double feed_length = 0x1.999999999999ap-4;", "double feed_velocity = 0x1p-1;",
                  "unsigned long long feed_seed = 1ULL;", "int feed_interval = 500;",
                  "[particles] density = 1000\\012[particles] capacity = 1920\\012",
                  "[feed] rate = 0.25\\012[feed] start = 0\\012[feed] length = 0.1\\012[feed] velocity = 0.5\\012"
                  "[feed] seed = 1\\012"});
  check_lacks(header, {"first_fed_kind", "mixture", "slice_interval", "statistics_from", "probe", "inclination"});
  check_lacks(printed(good_case), {"feed", "start_count", "[particles] capacity", "TimeValue", "Probe"});
  const std::string other =
      printed(replaced(line_with("rate = 0.25", "rate = 0.25\nstart = 0.5\nlength = 0.125\nvelocity = 0.25\nseed = 7"),
                       "count = 2\n", "count = 2\ncapacity = 300\n"));
  check_contains(other, {"int particle_count = 300;", "double feed_start = 0x1p-1;", "double feed_length = 0x1p-3;",
                         "double feed_velocity = 0x1p-2;", "feed_seed = 7ULL;"});
  // Large particles have a longer section, short pipes a shorter one; events are a step apart at least.
  check_contains(
      printed(replaced(replaced(line_case, "diameter = 0.010", "diameter = 0.0125"), "slice_length = 0.010", "")),
      {"double feed_length = 0x1p-3;"});
  check_contains(printed(replaced(line_case, "length = 0.800", "length = 0.0625")), {"double feed_length = 0x1p-4;"});
  check_contains(printed(replaced(without_gas(line_case), "2.0e-6", "4.0e-3")), {"int feed_interval = 1;"});
}

TEST_CASE("casegen: rates and velocities may be tables in time") {
  const std::string ramp = printed(replaced(line_with("rate = 0.25", "rate = [[0, 0], [2, 0.25], [8.0, 0.5]]"),
                                            "bulk_velocity = 2.4", "bulk_velocity = [[1, 1.5], [5, 3]]"));
  check_contains(ramp, {"feed_rate[] = {{0x0p+0, 0x0p+0}, {0x1p+1, 0x1p-2}, {0x1p+3, 0x1p-1}};",
                        "gas_velocity_in_time[] = {{0x1p+0, 0x1.8p+0}, {0x1.4p+2, 0x1.8p+1}};",
                        "double gas_velocity = 0x1.8p+0;", "double reference_speed = 0x1.8p+1;",
                        "[feed] rate = [[0, 0], [2, 0.25], [8, 0.5]]", "[gas] bulk_velocity = [[1, 1.5], [5, 3]]"});
  // One row is a number.
  CHECK(members_of(with_gas("bulk_velocity = [[3, 2.4]]", replaced(good_case, "bulk_velocity = 2.4\n", ""))) ==
        members_of(good_case));
  const auto refused = [](const std::string& value, const std::vector<const char*>& words) {
    check_refused(line_with("rate = 0.25", "rate = " + value), value, words);
  };
  refused("-0.1",
          {"rate = -0.1 in [feed] is out of range; allowed: at least 0; in time [[t, value], ...], 1 to 100 rows"});
  refused("\"0.2 kg/s\"", {"is a text, but must be a number, without quotes and unit"});
  refused("[]", {"has 0 rows"});
  refused("[0, 1]", {"has 0 as row 1, but must have [t, value]"});
  refused("[[0, 1], [1, 2, 3]]", {"has [1, 2, 3] as row 2, but must have [t, value]"});
  refused("[[0, 1], [1, -2]]", {"has a value in row 2 that is out of range"});
  refused("[[0, 1], [1, \"2\"]]", {"has a value in row 2 that is a text, but must be a number"});
  refused("[[-1, 1], [1, 2]]", {"has a time in row 1 that is out of range"});
  refused("[[0, 1], [nan, 2]]", {"has a time in row 2 that is not a number"});
  refused("[[0, 1], [inf, 2]]", {"has a time in row 2 that must be finite"});
  refused("[[0, 1], [2, 1], [2, 3]]", {"has times that do not increase: 2 in row 3 after 2"});
  std::string many = "[[0, 1]";
  for (int k = 1; k <= 100; ++k) many += ", [" + std::to_string(k) + ", 1]";
  refused(many + "]", {"has 101 rows; allowed"});
  check_warned(line_with("rate = 0.25", "rate = [[0, 0.1], [1, 2000]]"), "[[0, 0.1]",
               {"is not plausible", "0 to 1000 kg/s"});
}

TEST_CASE("casegen refuses lines that make no sense") {
  check_refused(
      replaced(good_case, "\"periodic\"", "\"open\""), "\"open\"",
      {"[pipe] ends = \"open\" without a [feed] table; allowed: with one", "add [feed] with rate", "1 error"});
  for (const std::string ends : {"periodic", "closed"})
    check_refused(line_with("\"open\"", "\"" + ends + "\""), "[feed]",
                  {("[feed] with [pipe] ends = \"" + ends + "\"; allowed: only with \"open\"").c_str(), "1 error"});
  check_refused(line_with("rate = 0.25", ""), "[feed]", {"missing key 'rate' in [feed]: mass fed per second"});
  check_refused(without_gas(line_with("wall = true", "wall = false")), "false",
                {"[pipe] wall = false with ends = \"open\"; allowed: true", "falls onto the pipe's wall"});
  check_refused(line_with("length = 0.800", "length = 0.039"), "0.039", {"allowed with ends = \"open\": at least 4"});
  check_refused(replaced(good_case, "count = 2", "count = 2\ncapacity = 5"), "capacity",
                {"[particles] capacity = 5 is not used here; allowed: only with [pipe] ends = \"open\""});
  check_refused(line_with("count = 2", "count = 2\ncapacity = 1"), "1\ndiameter",
                {"capacity = 1 is below the number of particles at the start; allowed: at least 2"});
  check_refused(line_with("count = 2", "count = 2\ncapacity = 0"), "0\ndiameter", {"1 to 10000000"});
  check_warned(line_with("count = 2", "count = 2\ncapacity = 1921"), "1921",
               {"capacity = 1921 is more than the pipe can hold, about 1920 particles", "leave it out"});
  check_refused(without_gas(line_with("length = 0.800", "length = 9000")), "9000",
                {"the pipe can hold 2.16e+07 particles; allowed: 10000000", "give [particles] capacity"});
  printed(
      without_gas(replaced(line_with("length = 0.800", "length = 9000"), "count = 2", "count = 2\ncapacity = 1000")));
  for (const std::string length : {"0.019", "0.801"})
    check_refused(line_with("rate = 0.25", "rate = 0.25\nlength = " + length), length,
                  {"[feed] length = ", "allowed: from two particle diameters = 0.02 to the length of the pipe = 0.8"});
  check_refused(line_with("rate = 0.25", "rate = 0.25\nvelocity = -1"), "-1",
                {"velocity = -1 in [feed]", "at least 0"});
  check_refused(line_with("rate = 0.25", "rate = 0.25\nstart = -1"), "-1", {"start = -1 in [feed]", "at least 0"});
  check_refused(line_with("rate = 0.25", "rate = 0.25\nmixture = [0.5, 0.5]"), "[0.5",
                {"[feed] mixture = [0.5, 0.5] without [[particles.species]]; allowed: only with them"});
  check_refused(line_with("rate = 0.25", "rat = 0.25"),
                "rat =", {"unknown key 'rat' in [feed]", "did you mean 'rate'?", "1 error"});
  check_refused(replaced(good_case, "[gas]\n", "[fed]\nrate = 1\n[gas]\n"), "fed", {"did you mean 'feed'?"});
}

TEST_CASE("casegen: a line may be empty at the start, and then needs none") {
  check_contains(printed(empty_line()), {"int start_count = 0;", "StartKind start = StartKind::random;"});
  printed(line_with("count = 2", "count = 0"));
  std::string bare = line_case;
  bare.erase(bare.find("[start]"), bare.find("[run]") - bare.find("[start]"));
  check_refused(bare, "title", {"missing table [start]", "an open pipe with count = 0 needs none"});
  check_warned(replaced(empty_line(), "rate = 0.25", "rate = 0"), "0\n[gas]",
               {"[feed] rate = 0 with count = 0: the line stays empty"});
  // Where particles are placed one by one, none at the outlet.
  const auto at = [](const std::string& z) {
    return placed(line_case, {"position = [0, 0, 0.1]", "position = [0, 0, " + z + "]"});
  };
  printed(at("0.799"));
  check_refused(at("0.8"), "[0, 0, 0.8]", {"is outside the pipe", "before the outlet"});
  check_refused(at("0.002"), "[0, 0, 0.002]", {"is outside the pipe", "a radius away from z = 0"});
}

TEST_CASE("casegen: a line starts from another case, and none from a line") {
  const auto from = [](const std::string& text) { return replaced(text, random_start, "from = \"filling\""); };
  const fs::path filling = scratch() / "filling.toml", mine = scratch() / "mine.toml";
  write(filling, good_case);
  write(mine, from(line_case));
  Outcome outcome = casegen("'" + mine.string() + "'");
  CHECK_MESSAGE(outcome.exit_code == 0, outcome.output);
  write(filling, line_case);
  outcome = casegen("'" + mine.string() + "'");
  CHECK(outcome.exit_code == 3);
  check_contains(outcome.output, {":" + position_of(from(line_case), "\"filling\"") + ": error: ",
                                  "[start] from = \"filling\" is a line, of which nobody knows how many particles",
                                  "may be tables in time"});
}

TEST_CASE("casegen warns of a feed that asks for more than its section takes, or comes too late") {
  check_quiet(line_case);
  // 0.28 x 1000 kg/m3 x 0.5 m/s x 0.1 m x 0.05 m
  check_quiet(line_with("rate = 0.25", "rate = 0.69"));
  check_warned(line_with("rate = 0.25", "rate = [[0, 0], [1, 0.71]]"), "[[0, 0]",
               {"asks for 0.71 kg/s; a feed section of 0.1 m takes about 0.7 kg/s", "raise [feed] length"});
  check_quiet(line_with("rate = 0.25", "rate = 0.71\nlength = 0.2"));
  check_warned(line_with("rate = 0.25", "rate = 0.25\nstart = 1.2"), "1.2\n[gas]",
               {"start = 1.2 is not before the end of the run, duration = 1.2: nothing is fed"});
}

TEST_CASE("casegen: stations and records of a line") {
  const std::string watched =
      line_with("log_interval = 0.1\n",
                "log_interval = 0.1\nslice_interval = 0.25\ncontact_interval = 0.5\nstatistics_from = 0.75\n"
                "[[probe]]\nposition = 0.5\n[[probe]]\nposition = 0.75\ninterval = 0.125\n");
  const std::string header = printed(watched);
  check_contains(
      header,
      {"double slice_interval = 0x1p-2;", "double contact_interval = 0x1p-1;", "double statistics_from = 0x1.8p-1;",
       "int probe_count = 2;", "Probe probes[] = {{0x1p-1, 0x1.47ae147ae147bp-7}, {0x1.8p-1, 0x1p-3}};",
       "[output] slice_interval = 0.25", "[[probe]] 0 position = 0.5\\012[[probe]] 0 interval = 0.01",
       "[[probe]] 1 interval = 0.125"});
  check_contains(printed(replaced(good_case, "log_interval = 0.1", "contact_interval = 0.5")),
                 {"double contact_interval = 0x1p-1;"});
  const auto changed = [&](const std::string& piece, const std::string& by) { return replaced(watched, piece, by); };
  check_refused(changed("position = 0.75", "position = 0.81"), "0.81",
                {"[[probe]] position = 0.81 is outside the pipe; allowed: 0 to [pipe] length = 0.8"});
  check_refused(changed("position = 0.75\n", ""), "[[probe]]\ninterval", {"missing key 'position' in [[probe]]"});
  check_refused(changed("interval = 0.125", "interval = 1e-7"), "1e-7", {"[[probe]] interval", "at least time_step"});
  check_refused(changed("interval = 0.125", "intervall = 0.125"), "intervall", {"did you mean 'interval'?"});
  check_refused(changed("slice_interval = 0.25", "slice_interval = 1e-7"), "1e-7",
                {"[output] slice_interval", "time_step"});
  check_refused(changed("statistics_from = 0.75", "statistics_from = 1.2"), "1.2\n[[probe]]",
                {"[output] statistics_from = 1.2 is not before the end; allowed: below duration = 1.2"});
  check_refused(
      replaced(good_case, "[run]", "[probe]\nposition = 1\n[run]"), "[probe]",
      {"'probe' must be a list of tables", "write [[probe]], with two pairs of brackets, before each station"});
  check_refused(good_case + "[[probe]]\nposition = 0.5\n", "[[probe]]",
                {"[[probe]] with [pipe] ends = \"periodic\"; allowed: only with \"open\""});
  for (const std::string key : {"slice_interval", "statistics_from"})
    check_refused(replaced(good_case, "log_interval", key), key,
                  {key.c_str(), "is not used here; allowed: only with [pipe] ends = \"open\""});
  std::string many = line_case;
  for (int k = 0; k <= 100; ++k) many += "[[probe]]\nposition = 0." + std::to_string(100 + k) + "\n";
  check_refused(many, "[[probe]]\nposition = 0.200", {"101 [[probe]] tables; allowed: at most 100"});
}
