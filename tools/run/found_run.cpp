#include "found_run.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "binary_file.hpp"
#include "failure.hpp"
#include "result_folder.hpp"
#include "schedule.hpp"
#include "state_file.hpp"

namespace fixdem::program {
namespace {

namespace files = std::filesystem;
using nlohmann::json;

/// summary.json as far as it makes sense; nothing of it otherwise.
json read_summary(const files::path& path) {
  std::error_code error;
  if (!files::exists(path, error)) return nullptr;
  try {
    return json::parse(read_file(path, "summary"));
  } catch (const std::exception&) {
    return nullptr;
  }
}

std::string text_of(const json& summary, const char* key) {
  const auto at = summary.find(key);
  return at != summary.end() && at->is_string() ? at->get<std::string>() : std::string();
}

std::uint64_t hexadecimal(const std::string& text) {
  return text.empty() ? 0 : std::strtoull(text.c_str(), nullptr, 16);
}

/// What a summary says of its run.
void take_facts(FoundRun& run, const json& summary) {
  run.identity = {{"case", text_of(summary, "case")},
                  {"case file (XXH64)", text_of(summary, "case_hash")},
                  {"precision", text_of(summary, "precision")},
                  {"kernel (checksum of its source)", text_of(summary, "kernel")}};
  const json duration = summary.value("duration", json()), seed = summary.value("seed", json()),
             frames = summary.value("frames", json());
  run.is_known = duration.is_number();
  if (duration.is_number()) run.duration = duration.get<double>();
  if (seed.is_number_unsigned()) run.seed = seed.get<std::uint64_t>();
  run.start = hexadecimal(text_of(summary, "start_state"));
  run.frames = frames.is_number();
}

void take_facts(FoundRun& run, const Checkpoint& checkpoint) {
  run.identity = checkpoint.identity;
  run.duration = checkpoint.duration, run.seed = checkpoint.seed, run.start = checkpoint.start;
  run.frames = checkpoint.frames;
  run.is_known = true;
}

std::string describe(const FoundRun& run, const json& summary, bool has_final_state) {
  const std::string of = run.identity.empty() || run.identity.front().second.empty()
                             ? std::string()
                             : " of " + run.identity.front().second;
  if (run.is_finished) return fmt::format("the finished run{}, {:.6g} s", of, run.duration);
  const std::string status = summary.is_object() ? text_of(summary, "status") : "";
  if (run.checkpoint)
    return fmt::format(
        "{} run{}, {:.6g} s of {:.6g} s",
        status.empty() || status == "done" || status == "interrupted" ? "an unfinished" : "a failed (" + status + ")",
        of, run.checkpoint->checkpoint.time, run.duration);
  return fmt::format("results{} without a checkpoint{}", of, has_final_state ? "" : " and without a final state");
}

}  // namespace

FoundRun find_run(const files::path& out, double time_step) {
  FoundRun run;
  run.is_there = holds_results(out);
  if (!run.is_there) return run;
  const json summary = read_summary(out / "summary.json");
  if (summary.is_object()) take_facts(run, summary);
  bool ends_there = true;  // the latest checkpoint, if there is one
  if (const auto all = checkpoints_in(out); !all.empty()) {
    ends_there = false;
    try {
      Checkpoint found = decode_checkpoint(read_file(all.front(), "checkpoint"), all.front().string());
      if (is_possible_duration(found.duration, time_step))
        ends_there = found.step >= steps_of(found.duration, time_step);
      take_facts(run, found);
      run.checkpoint = Resumable{all.front(), std::move(found)};
    } catch (const Failure& failure) {
      if (failure.code() != exit_bad_input) throw;
      ends_there = summary.is_object() && text_of(summary, "status") == "done";  // damaged: as far as is known
    }
  }
  bool has_final_state = false, is_complete = false;
  std::error_code error;
  if (const files::path path = out / "final.fixdem"; files::exists(path, error)) try {
      const StoredState state = read_state(path);
      has_final_state = true;
      is_complete = state.complete;
      if (run.identity.empty()) run.identity = {{"case", state.case_name}}, run.duration = state.duration;
    } catch (const Failure&) {
    }
  run.is_finished = is_complete && ends_there && summary.is_object() && text_of(summary, "status") == "done";
  run.words = describe(run, summary, has_final_state);
  return run;
}

std::string differences(const FoundRun& there, const CaseFacts& facts, SimulationView& view) {
  return differences(there.identity, there.checkpoint ? identity(facts, view) : brief_identity(facts));
}

std::string differences(const FoundRun& there, const CaseFacts& facts, SimulationView& view, const Options& options) {
  std::string text = differences(there, facts, view);
  const auto add = [&text](const char* name, const std::string& a, const std::string& b) {
    if (a != b) text += fmt::format("\n  {}: {} there, {} here", name, a, b);
  };
  const auto start = [](std::uint64_t hash) { return hash != 0 ? fmt::format("XXH64 {:016x}", hash) : "none"; };
  if (!there.is_known) return text + "\n  duration and options are not known";
  add("duration", fmt::format("{} s", there.duration), fmt::format("{} s", options.duration));
  add("seed", fmt::format("{}", there.seed), fmt::format("{}", options.seed));
  add("frames", there.frames ? "written" : "not written", options.frames ? "written" : "not written");
  add("state to start from", start(there.start), start(options.start_hash));
  return text;
}

void check_options(const Options& options, const std::string& where, std::uint64_t seed, bool frames,
                   std::uint64_t start) {
  const auto refuse = [&](const char* option, const std::string& there, const std::string& given) {
    throw Failure(exit_wrong_usage, fmt::format("cannot go on with {}: its run has {} {}, and {} is asked for\n  leave "
                                                "out {}, or begin anew with --fresh",
                                                where, option, there, given, option));
  };
  if (options.seed_is_given && options.seed != seed)
    refuse("--seed", fmt::format("{}", seed), fmt::format("{}", options.seed));
  if (!options.frames && frames) refuse("--no-frames", "not set", "it");
  if (options.start_state && options.start_hash != start)
    refuse("--start-state", fmt::format("a file of XXH64 {:016x}", start),
           fmt::format("{} of {:016x}", options.start_state->string(), options.start_hash));
}

std::optional<Resumable> find_checkpoint(const Identity& here, const Options& options) {
  files::path path;
  if (options.resume_from) {
    path = *options.resume_from;
  } else {
    const std::vector<files::path> all = checkpoints_in(options.out);
    if (all.empty()) return std::nullopt;
    path = all.front();
  }
  try {
    Resumable found{path, read_checkpoint(path, here)};
    check_options(options, path.string(), found.checkpoint.seed, found.checkpoint.frames, found.checkpoint.start);
    return found;
  } catch (const Failure& failure) {
    if (failure.code() != exit_bad_input) throw;
    throw Failure(exit_bad_input, failure.what() + offer_older(path, here, options));
  }
}

std::string offer_older(const files::path& path, const Identity& here, const Options& options) {
  for (const files::path& other : checkpoints_in(options.out)) {
    if (other.filename() == path.filename()) continue;
    try {
      const Checkpoint older = read_checkpoint(other, here);
      if (!difference(options, older.outputs).empty()) continue;
      return fmt::format(
          "\n  or go on from {}, which is good: step {}, {:.6g} s\n  add --resume-from {} (with make: "
          "RESUME={})",
          other.string(), older.step, older.time, other.string(), other.string());
    } catch (const Failure&) {
      continue;  // no better
    }
  }
  return "";
}

}  // namespace fixdem::program
