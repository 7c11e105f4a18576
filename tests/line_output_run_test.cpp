// A line of the kernel's through the program's time loop: a run in two parts leaves the bytes of one in one part, rows
// of the log add up, and everything that is watched has been written.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <memory>
#include <sstream>
#include <string>

#include "line_output_case.hpp"
#include "loop_end.hpp"
#include "program_run.hpp"
#include "tools/run/case_adapter.hpp"
#include "tools/run/checkpoint.hpp"
#include "tools/run/found_run.hpp"
#include "tools/run/result_folder.hpp"
#include "tools/run/start.hpp"
#include "tools/run/state_file.hpp"
#include "tools/run/time_loop.hpp"

using namespace fixdem;
using namespace fixdem::program;
namespace files = std::filesystem;
using fixdem::tests::contains, fixdem::tests::read_bytes, fixdem::tests::scratch;

namespace {

/// Every file of a run but its checkpoints; of the summary what the clock has not made.
std::map<std::string, std::string> results(const files::path& out) {
  std::map<std::string, std::string> all;
  for (const auto& entry : files::recursive_directory_iterator(out)) {
    const std::string name = files::relative(entry.path(), out).string();
    if (!entry.is_regular_file() || name.starts_with("checkpoint")) continue;
    all[name] = read_bytes(entry.path());
  }
  auto summary = nlohmann::json::parse(all.at("summary.json"));
  summary.erase("performance");
  all["summary.json"] = summary.dump();
  return all;
}

/// The columns of a CSV file by their names.
std::map<std::string, std::vector<std::string>> columns(const std::string& csv) {
  std::map<std::string, std::vector<std::string>> all;
  std::istringstream lines(csv);
  std::vector<std::string> names;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line);
    std::vector<std::string> row;
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell);
    if (names.empty())
      names = row;
    else
      for (std::size_t k = 0; k < row.size(); ++k) all[names[k]].push_back(row[k]);
  }
  return all;
}

template <class Case>
class Line {
 public:
  explicit Line(const std::string& name) {
    options_.out = scratch(name), options_.quiet = true, options_.seed = 1;
    prepare_folder(options_.out);
    start_simulation(view_, facts_, options_);
  }
  /// To this time, from the beginning or from where it has come to.
  void run(double duration) {
    options_.duration = duration;
    const auto found = checkpoints_in(options_.out);
    if (found.empty()) {
      REQUIRE(TimeLoop(view_, facts_, options_).run() == 0);
      return;
    }
    const Resumable from{found.front(), read_checkpoint(found.front(), identity(facts_, view_))};
    std::memset(view_.memory().data(), 0, view_.memory().size());
    std::memcpy(view_.memory().data(), from.checkpoint.simulation.data(), view_.memory().size());
    REQUIRE(view_.is_consistent());
    REQUIRE(TimeLoop(view_, facts_, options_, &from).run() == 0);
  }
  const files::path& out() const { return options_.out; }
  const CaseFacts& facts() const { return facts_; }

 private:
  std::unique_ptr<Simulation<Case>> simulation_ = std::make_unique<Simulation<Case>>();
  CaseAdapter<Case> view_{*simulation_};
  CaseFacts facts_ = case_facts<Case>();
  Options options_;
};

template <class Case>
void check_parts(const std::string& name) {
  Line<Case> whole(name + "_whole"), parts(name + "_parts");
  whole.run(0.02);
  for (const double time : {0.0042, 0.0117, 0.0117, 0.02}) parts.run(time);
  const auto expected = results(whole.out()), found = results(parts.out());
  for (const auto& [file, bytes] : expected) {
    CAPTURE(file);
    REQUIRE(found.contains(file));
    CHECK((found.at(file) == bytes));
  }
  CHECK(found.size() == expected.size());
  for (const char* file : {"log.csv", "plugs.csv", "slices.bin", "probe_0.csv", "probe_1.csv", "contacts.pvd",
                           "contacts/contact_000005.vtp", "dump.lammpstrj", "frames/frame_000004.vtp", "final.fixdem"})
    CHECK_MESSAGE(expected.contains(file), file);

  const auto log = columns(expected.at("log.csv"));
  CHECK(log.at("present").size() == 11);
  for (std::size_t k = 0; k < log.at("present").size(); ++k) {
    const auto number = [&](const char* column) { return std::stoll(log.at(column)[k]); };
    CHECK(Case::start_count + number("fed") == number("present") + number("left"));
  }
  if (Case::start_count > 0) CHECK(std::stoll(log.at("left").back()) > 0);
  CHECK(log.at("asked rate [kg/s]").front().empty());
  CHECK(std::stod(log.at("asked rate [kg/s]").back()) == doctest::Approx(2).epsilon(0.02));
  const auto summary = nlohmann::json::parse(read_bytes(whole.out() / "summary.json"));
  CHECK(summary["line"]["present"] == std::stoll(log.at("present").back()));
  const double asked = summary["line"]["asked_rate"];
  CHECK(asked == doctest::Approx(2).epsilon(0.02));
  CHECK(summary["plug"].is_null());
  CHECK(columns(expected.at("probe_0.csv")).at("time [s]").size() == 11);
  CHECK(columns(expected.at("probe_1.csv")).at("time [s]").size() == 7);
  const std::string& slices = expected.at("slices.bin");
  const std::size_t header = slices.find('\n') + 1, record = 8 + 7 * 4 * static_cast<std::size_t>(Case::slice_count);
  CHECK((slices.size() - header) == 21 * record);
  CHECK(nlohmann::json::parse(slices.substr(0, header))["slices"] == Case::slice_count);
  CHECK(read_state(whole.out() / "final.fixdem").particles.size() == summary["line"]["present"]);

  // All of it goes with a new run, and aside.
  Options there;
  there.out = whole.out();
  CHECK(contains(difference(there, {{{"slices.bin", {slices.size() + 1, 0}}}, {}, {}}), "slices.bin is cut short"));
  const files::path aside = move_aside(whole.out());
  CHECK(results(aside) == expected);
  CHECK_FALSE(holds_results(whole.out()));
  files::remove_all(aside);
  prepare_folder(parts.out());
  CHECK(files::is_empty(parts.out()));
}

}  // namespace

TEST_CASE("line: a run in parts leaves the same bytes, and its files add up") {
  check_parts<tests::WatchedLine>("line");
  check_parts<tests::WatchedSpecies>("line_of_species");
  check_parts<tests::watched<tests::empty_at_start<tests::short_line>>>("line_empty");
}

TEST_CASE("line: without frames there is no file of contacts either") {
  using Case = tests::WatchedLine;
  auto simulation = std::make_unique<Simulation<Case>>();
  CaseAdapter<Case> view(*simulation);
  const CaseFacts facts = case_facts<Case>();
  Options options;
  options.out = scratch("line_bare"), options.quiet = true, options.frames = false, options.duration = 1e-3;
  prepare_folder(options.out);
  start_simulation(view, facts, options);
  CHECK(TimeLoop(view, facts, options).run() == 0);
  CHECK_FALSE(files::exists(options.out / "contacts.pvd"));
  CHECK(files::exists(options.out / "slices.bin"));
}

namespace {
struct narrow_line : tests::WatchedLine {
  static constexpr int particle_count = 130;
};
}  // namespace

TEST_CASE("line: a full one stops at the last good step and says what to do") {
  auto simulation = std::make_unique<Simulation<narrow_line>>();
  CaseAdapter<narrow_line> view(*simulation);
  const CaseFacts facts = case_facts<narrow_line>();
  Options options;
  options.out = scratch("line_full"), options.quiet = true, options.duration = 1;
  prepare_folder(options.out);
  start_simulation(view, facts, options);
  const tests::LoopEnd end = tests::end_of_loop(view, facts, options);
  CHECK(end.code == exit_capacity);
  CHECK(contains(end.message, "raise [particles] capacity"));
  CHECK(view.line().present == 130);
  CHECK(nlohmann::json::parse(read_bytes(options.out / "summary.json"))["status"] == "line_full");
}
