// tools/casegen: input that is made to do harm, or is broken: what it says stays short, and it ends by itself.
//
// Sizes are such that a recursion overflows, and that work or output that grows faster than the file shows in the
// output: no test looks at a clock.
#include <doctest/doctest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "casegen_run.hpp"

using namespace casegen_test;

namespace {

constexpr std::size_t short_output = 6000;

std::string repeated(const std::string& piece, int times) {
  std::string text;
  for (int i = 0; i < times; ++i) text += piece;
  return text;
}

std::string with(const std::string& piece, const std::string& by) { return replaced(good_case, piece, by); }

/// Refused with these words, and little else.
std::string check_short(const std::string& text, const std::vector<const char*>& words) {
  const fs::path file = scratch() / "hostile.toml";
  write(file, text);
  const Outcome outcome = casegen("'" + file.string() + "'");
  const std::string output = outcome.output.substr(0, short_output);
  CAPTURE(output);
  CHECK(outcome.exit_code == 3);
  CHECK(outcome.output.size() < short_output);
  for (const std::string word : words) CHECK_MESSAGE(contains(output, word), word);
  return output;
}

}  // namespace

TEST_CASE("casegen refuses deep nesting before the parser recurses into it") {
  constexpr int deep = 80000;
  check_short("[a" + repeated(".a", deep) + "]\n", {":1:33: error: nested too deeply; allowed: at most 16 levels"});
  check_short("a" + repeated(" . \"a\"", deep) + " = 1\n", {"nested too deeply"});
  check_short("[[a" + repeated(".'a'", deep) + "]]\n", {"nested too deeply"});
  check_short("a = " + repeated("[", deep), {"nested too deeply"});
  check_short("a = " + repeated("{a.a.a = ", deep), {"nested too deeply"});
  check_short("[particles" + repeated(".a", 13) + "]\n[run" + repeated(".b", 13) + "]\n", {"missing table"});
}

TEST_CASE("casegen quotes names and values in part when they are long") {
  const std::string longer = repeated("restitution", 100000);
  check_short(with("restitution", longer), {"unknown key 'restitutionrest", "...' in [material]", "allowed: "});
  check_short(with("[capacity]", "[" + longer + "]"), {"unknown table or key 'restitution", "...' at the top"});
  check_short(with("\"hertz\"", "\"" + longer + "\""), {"normal = \"restitution", "is unknown"});
  check_short(with("count = 2", "count = [" + repeated("1, ", 100000) + "]"), {"count = [1, 1, ", "...", "a list"});
  check_short(with("count = 2", "count = {a = \"" + longer + "\", b = 2}"), {"count = {", "a table"});
  check_short(with("seed = 3", "seed = " + repeated("3", 100000)), {"error", "numeric value too long"});
  check_short(with("seed = 3", longer + " = 3\n" + longer + " = 4"), {"error", "stands in the file twice"});
  check_short(with("A good case", longer), {"title", "has 1100000 bytes", "at most 500 bytes"});
  check_short(with("A good case", "A\\u001b[2Jcase"), {"title = \"A\\x1b[2Jcase\"", "control characters"});
  check_short(with("\"A good case\"", "\"\"\"A\ncase\"\"\""), {"title = \"A\\x0acase\"", "line breaks"});
  check_short(with("title", "\"\\u0085\\u0007\""), {"'\\xc2\\x85\\x07'"});
}

TEST_CASE("casegen counts errors of the same kind after a few") {
  const std::string placed = replaced(with("count = 2", "count = 1000"), random_start, "");
  const std::string all =
      check_short(placed + repeated("[[start.particle]]\nposition = [0, 0, 0.1]\n", 1000),
                  {"(particle 1) overlaps particle 0", "error: 994 more of the last kind", "999 errors"});
  CHECK(contains(all, "(particle 5) "));
  CHECK_FALSE(contains(all, "(particle 6) "));
  check_short(placed + repeated("[[start.particle]]\nposition = [0, 0, 9]\n", 1000),
              {"outside", "995 more", "1000 err"});
  check_short(placed + repeated("[[start.particle]]\npositron = [0, 0, 9]\n", 1000),
              {"'positron'", "did you mean 'position'?", " more of the last kind"});
  check_short(placed + "[start]\nparticle = [" + repeated("1, ", 1000) + "]\n", {"redefine"});
  std::string unknown;
  for (int i = 0; i < 50000; ++i) unknown += "restitution" + std::to_string(i) + " = 1\n";
  check_short(with("friction = 0.3", "friction = 0.3\n" + unknown),
              {"unknown key", "more of the last kind", "50000 err"});
  check_short(with("title", unknown + "title"), {"unknown table or key", "more of the last kind", "50000 err"});
  // Particles apart from one another, as many, are compared with their neighbours only, and accepted.
  std::string apart;
  for (int i = 0; i < 30000; ++i) apart += "[[start.particle]]\nposition = [0, 0, " + std::to_string(i) + ".005]\n";
  std::string large = replaced(with("count = 2", "count = 30000"), random_start, "");
  large = replaced(replaced(large, "diameter = 0.010", "diameter = 0.4"), "diameter = 0.050", "diameter = 2");
  large = replaced(replaced(large, "length = 0.800", "length = 30001"), "slice_length = 0.010", "slice_length = 0.4");
  write(scratch() / "apart.toml", large + apart);
  const Outcome outcome = casegen("'" + (scratch() / "apart.toml").string() + "'");
  CHECK_MESSAGE(outcome.exit_code == 0, outcome.output.substr(0, short_output));
}

TEST_CASE("casegen's advice on lines that are not TOML names the slip") {
  const struct {
    const char *piece, *by, *advice;
  } slips[] = {
      {"0.010\ndensity", "0,010\ndensity", "decimal point, not a comma"},
      {"0.010\ndensity", "0.010 m\ndensity", "the number alone, without a unit"},
      {"0.010\ndensity", "10mm\ndensity", "the number alone, without a unit"},
      {"0.010\ndensity", ".010\ndensity", "digits on both sides of the point"},
      {"0.010\ndensity", "1.\ndensity", "digits on both sides of the point"},
      {"0.010\ndensity", "1/100\ndensity", "no arithmetic"},
      {"2.0e-6", "2.0*10^-6", "power of ten with e"},
      {"seed = 3", "seed = 007", "leading zeros"},
      {"0.010\ndensity", "0.010\ndensity == 1", "one equals sign"},
      {"density = 1000.0", "density = 1,000.0", "nothing between thousands"},
      {"2.0e-6", "0x1p-19", "a decimal number"},
      {"2.0e-6", "1e400", "the number is too large"},
      {"count = 2", "count = inf", "no finite number, but must be a whole number"},
      {"seed = 3", "seed = 99999999999999999999", "the number is too large: whole ones go to"},
      {"seed = 3", "seed =", "the value is missing"},
      {"seed = 3", "seed = 3\nseed = 3", "stands in the file twice"},
      {"[run]", "[pipe]\n[run]", "stands in the file twice"},
      {"seed = 3", "seed: 3", "an equals sign"},
      {"seed = 3", "seed 3", "an equals sign"},
      {"\"periodic\"", "periodic", "in double quotes"},
      {"wall = true", "wall = True", "true or false, without quotes"},
      {"wall = true", "wall = yes", "true or false, without quotes"},
      {"[capacity]", "[capacity", "close the brackets"},
      {"count = 2", "count = 1e3", "write 1000"},
      {"count = 2", "count = 2.0", "write 2;"},
      {"diameter = 0.010", "diameter = \"0.010 m\"", "without quotes and unit"},
  };
  for (const auto& slip : slips) {
    CAPTURE(slip.by);
    check_short(with(slip.piece, slip.by), {slip.advice});
  }
}

TEST_CASE("casegen reads files with line ends and byte order marks of other systems, and says what it cannot read") {
  const auto header_of = [](const std::string& text) {
    write(scratch() / "system.toml", text);
    const Outcome outcome = casegen("'" + (scratch() / "system.toml").string() + "' --print");
    CHECK_MESSAGE(outcome.exit_code == 0, outcome.output);
    return outcome.output.substr(outcome.output.find("// particles and material"));
  };
  std::string windows;
  for (const char c : good_case) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  CHECK(header_of(windows) == header_of(good_case));
  CHECK(header_of("\xEF\xBB\xBF" + good_case) == header_of(good_case));
  std::string wide = "\xFF\xFE";
  for (const char c : good_case) wide += {c, '\0'};
  check_short(wide, {"UTF-16", "save it again as UTF-8"});
  check_short(std::string(17 << 20, '#'), {"longer than 16 MiB"});

  const auto unreadable = [](const std::string& file, const char* words) {
    const Outcome outcome = casegen("'" + file + "'");
    CHECK_MESSAGE(outcome.exit_code == 6, outcome.output);
    CHECK_MESSAGE(contains(outcome.output, file), outcome.output);
    CHECK_MESSAGE(contains(outcome.output, words), outcome.output);
  };
  const fs::path folder = scratch() / "folder.toml", queue = scratch() / "queue.toml",
                 secret = scratch() / "secret.toml";
  fs::create_directories(folder);
  fs::remove(queue);
  REQUIRE(mkfifo(queue.c_str(), 0600) == 0);
  unreadable(folder.string(), "Is a directory");
  unreadable(queue.string(), "a pipe or a device, not a file");
  unreadable("/dev/zero", "a pipe or a device, not a file");
  unreadable((scratch() / "nowhere" / "x.toml").string(), "No such file");
  fs::remove(secret);
  write(secret, good_case);
  fs::permissions(secret, fs::perms::none);
  if (geteuid() != 0) unreadable(secret.string(), "Permission denied");
}
