// Pinned final states: the program of every shipped case, run for a short while, must end in the same bytes as ever.
//
// tests/golden/states.txt holds a line for each case and precision: the steps of 0.04 s, or of 0.004 s with more than
// 10 000 particles, and the program's own
// state_hash (positions, velocities, angular velocities, contact histories). One hash serves every compiler, lane width
// and level of optimisation. Programs of other precisions than the case's own lie in folders of their own (rules.mk);
// FIXDEM_GOLDEN_ALL names those that are run, of which `make test` builds some and `make check` all. A case that starts
// from another one gets spheres at random places instead of that one's final state; a random start has seed 1.
//
// A result that is meant to change is renewed by `make golden`, which runs this test with FIXDEM_RENEW_GOLDEN=1: then
// it writes the file and prints what has changed.
#include <doctest/doctest.h>

#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "program_run.hpp"
#include "program_start.hpp"
#include "support.hpp"

using namespace fixdem::tests;

namespace {

namespace files = std::filesystem;

const char* const head =
    "# Final states after 0.04 s, or 0.004 s of more than 10 000 particles: case, precision, steps, state_hash. "
    "Renewed by `make golden`, never by hand.\n";

struct Pinned {
  std::string path;       ///< of the program
  std::string case_name;  ///< in cases/
  std::string precision;
};

/// `case precision` to `steps hash`.
using Hashes = std::map<std::string, std::string>;

Hashes read_pinned() {
  Hashes pinned;
  std::ifstream file(FIXDEM_GOLDEN);
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string case_name, precision, steps, hash;
    if (line.starts_with('#') || !(words >> case_name >> precision >> steps >> hash)) continue;
    pinned[case_name + " " + precision] = steps + " " + hash;
  }
  return pinned;
}

/// Every case of cases/ in its own precision, and those of a list in another one, given as precision/case.
std::vector<Pinned> programs() {
  std::vector<Pinned> list;
  for (const auto& file : files::directory_iterator(FIXDEM_CASES_DIR))
    if (file.path().extension() == ".toml") {
      const std::string name = file.path().stem();
      list.push_back({fixdem::tests::program(name), name, ""});
    }
  const char* all = std::getenv("FIXDEM_GOLDEN_ALL");
  std::istringstream others(all != nullptr ? all : FIXDEM_GOLDEN_SOME);
  for (std::string other; others >> other;) {
    const files::path path(other);
    list.push_back({std::string(FIXDEM_BIN_DIR) + "/../precision/" + other, path.filename(), path.parent_path()});
  }
  return list;
}

/// Particles of several sizes at random places, as the other case would have left them: it knows the sizes, and is run
/// for a moment to tell them.
fixdem::program::StoredState pile_of_sizes(const std::string& case_name) {
  const std::string name = "golden-sizes-" + case_name;
  const files::path out = scratch(name);
  files::remove_all(out);
  const ProgramRun run = run_command(shell_word(fixdem::tests::program(case_name)) + " --out " + shell_word(out) +
                                         " --quiet --no-frames --seed 1 --duration 0.0001",
                                     name, out);
  REQUIRE_MESSAGE(run.exit_code == 0, run.standard_error);
  fixdem::program::StoredState state = fixdem::program::read_state(out / "final.fixdem");
  state.particles = fixdem::program::arrange_moving({0.05, 0.79, false}, state.diameters, 0, 1);
  state.histories.clear();
  return state;
}

/// A number of the case: the first of this key in a table.
double number(const std::string& text, const std::string& table, const std::string& key) {
  std::smatch found;
  REQUIRE(std::regex_search(text, found, std::regex("\\[" + table + "\\][^\\[]*\n *" + key + " *= *([0-9.e-]+)")));
  return std::stod(found[1]);
}

/// Options that make the run short, quiet and independent of other runs.
std::string options(const std::string& case_name) {
  const std::string text = read_bytes(files::path(FIXDEM_CASES_DIR) / (case_name + ".toml"));
  std::smatch found;
  const bool has_count = std::regex_search(text, found, std::regex("\n *count *= *([0-9]+)"));
  const bool is_large = has_count && std::stoi(found[1]) > 10000;
  std::string chosen = std::string("--quiet --no-frames --duration ") + (is_large ? "0.004" : "0.04");
  if (std::regex_search(text, found, std::regex("\n *from *= *\"([^\"]*)\""))) {
    const std::string predecessor = found[1];
    const bool has_sizes = std::regex_search(text, std::regex("\n *\\[+particles\\."));
    REQUIRE(std::regex_search(text, found, std::regex("\n *count *= *([0-9]+)")));
    const files::path state = scratch("golden-" + case_name + ".fixdem");
    const int count = std::stoi(found[1]);
    const auto own_pile = [&] {
      return pile(count, predecessor, number(text, "particles", "diameter"),
                  {number(text, "pipe", "diameter"), 0.99 * number(text, "pipe", "length"), false});
    };
    fixdem::program::write_state(
        state, has_sizes ? pile_of_sizes(predecessor) : (is_large ? own_pile() : pile(count, predecessor)));
    chosen += " --start-state " + shell_word(state);
  } else if (std::regex_search(text, std::regex("\n *arrangement *= *\"random\""))) {
    chosen += " --seed 1";
  }
  return chosen;
}

}  // namespace

TEST_CASE("golden: every shipped case ends in the pinned state") {
  const Hashes pinned = read_pinned();
  Hashes found;
  for (const Pinned& p : programs()) {
    CAPTURE(p.case_name);
    const std::string name = "golden-" + p.case_name + p.precision;
    const files::path out = scratch(name);
    files::remove_all(out);
    enter({p.case_name.c_str(), 1});
    const ProgramRun run =
        run_command(shell_word(p.path) + " --out " + shell_word(out) + " " + options(p.case_name), name, out);
    REQUIRE_MESSAGE(run.exit_code == 0, run.standard_error);
    const auto summary = run.summary();
    const std::string precision = summary["precision"];
    if (!p.precision.empty()) CHECK(precision == p.precision);
    const std::string key = p.case_name + " " + precision;
    found[key] =
        std::to_string(summary["steps"].get<long long>()) + " " + summary["final"]["state_hash"].get<std::string>();
    if (std::getenv("FIXDEM_FIGURES") != nullptr)
      std::cerr << "  " << key << ": " << summary["final"]["contacts"] << " contacts, kinetic energy "
                << summary["final"]["kinetic_energy"] << " J\n";
  }
  REQUIRE(!found.empty());

  if (std::getenv("FIXDEM_RENEW_GOLDEN") != nullptr) {
    std::string text = head;
    for (const auto& [key, value] : found) {
      text += key + " " + value + "\n";
      const auto old = pinned.find(key);
      if (old == pinned.end())
        std::cerr << "new:     " << key << " " << value << "\n";
      else if (old->second != value)
        std::cerr << "changed: " << key << " " << old->second << " -> " << value << "\n";
    }
    for (const auto& [key, value] : pinned)
      if (found.count(key) == 0) std::cerr << "gone:    " << key << " " << value << "\n";
    if (found == pinned) std::cerr << "no pinned state has changed\n";
    write_bytes(FIXDEM_GOLDEN, text);
    return;
  }
  const std::string advice = "if the result was meant to change: make golden";
  for (const auto& entry : found) {
    const auto &key = entry.first, &value = entry.second;
    const auto expected = pinned.find(key);
    CHECK_MESSAGE(expected != pinned.end(), key, " has no pinned state; ", advice);
    if (expected != pinned.end())
      CHECK_MESSAGE(value == expected->second, key, " ends in steps and state ", value, ", pinned is ",
                    expected->second, "; ", advice);
  }
  for (const auto& entry : pinned) {
    const auto& key = entry.first;
    const std::string name = key.substr(0, key.find(' '));
    CHECK_MESSAGE(files::exists(files::path(FIXDEM_CASES_DIR) / (name + ".toml")), key,
                  " is pinned, but there is no such case; ", advice);
  }
}
