#include "checkpoint_keeper.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "failure.hpp"
#include "output_file.hpp"
#include "result_folder.hpp"
#include "state_file.hpp"

namespace fixdem::program {
namespace {

namespace files = std::filesystem;

void check_options(const Options& options, const Resumable& found) {
  const auto refuse = [&](const char* option, const std::string& there, const std::string& given) {
    throw Failure(exit_wrong_usage,
                  fmt::format("cannot resume from {}: its run has {} {}, and {} is asked for\n  leave "
                              "out {}, or run without --resume to begin anew",
                              found.path.string(), option, there, given, option));
  };
  const Checkpoint& c = found.checkpoint;
  if (options.duration_is_given && options.duration != c.duration)
    refuse("--duration", fmt::format("{}", c.duration), fmt::format("{}", options.duration));
  if (options.seed_is_given && options.seed != c.seed)
    refuse("--seed", fmt::format("{}", c.seed), fmt::format("{}", options.seed));
  if (!options.frames && c.frames) refuse("--no-frames", "not set", "it");
}

}  // namespace

void CheckpointKeeper::write(Checkpoint& checkpoint) {
  const files::path path = checkpoint_path(out_, checkpoint.step);
  write_file(path, encode_checkpoint(checkpoint), Durability::durable);
  for (const files::path& other : checkpoints_in(out_))
    if (other != path && other.filename() != last_.filename()) remove_file(other);
  if (path.filename() != last_.filename()) last_ = path;
}

void CheckpointKeeper::remove_all() const {
  const std::vector<files::path> all =
      checkpoints_in(out_);  // the latest last, so that there is always one to go on from
  std::for_each(all.rbegin(), all.rend(), remove_file);
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
    check_options(options, found);
    return found;
  } catch (const Failure& failure) {
    if (failure.code() != exit_bad_input) throw;
    throw Failure(exit_bad_input, failure.what() + offer_older(path, here, options));
  }
}

bool is_done_already(const CaseFacts& facts, const Options& options) {
  const files::path path = options.out / "final.fixdem";
  std::error_code error;
  if (!files::exists(path, error)) return false;
  const StoredState state = read_state(path);
  if (state.complete && state.case_name == facts.name && state.source_hash == facts.source_hash &&
      (!options.duration_is_given || state.duration == options.duration))
    return true;
  throw Failure(exit_bad_input,
                fmt::format("cannot resume: there is no checkpoint in {}, but the final state of {} run "
                            "({} s of {})\n  run without --resume to replace it, or choose another --out",
                            options.out.string(), state.complete ? "another" : "an interrupted", state.duration,
                            state.case_name));
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
