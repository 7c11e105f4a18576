#include "outputs.hpp"

#include <fmt/format.h>

#include "dump.hpp"
#include "failure.hpp"
#include "result_folder.hpp"

namespace fixdem::program {
namespace {

std::filesystem::path log_path(const Options& options) { return options.out / "log.csv"; }
std::filesystem::path dump_path(const Options& options) { return options.out / "dump.lammpstrj"; }

/// Position of the log, once all files are known to be what they were and later ones are gone; nothing for a new run.
FilePosition checked_log(const Options& options, const OutputPosition* continued) {
  if (continued == nullptr) return {};
  if (const std::string what = difference(options, *continued); !what.empty())
    throw Failure(exit_bad_input,
                  fmt::format("cannot resume: {}\n  put back what it was, or begin anew with --fresh", what));
  tidy_folder(options.out, static_cast<int>(continued->frames.size()));
  return continued->log;
}

}  // namespace

std::string difference(const Options& options, const OutputPosition& position) {
  std::string what = difference(log_path(options), position.log);
  if (what.empty() && position.dump) what = difference(dump_path(options), *position.dump);
  for (std::size_t k = 0; what.empty() && k < position.frames.size(); ++k)
    what = difference(frame_path(options.out, static_cast<int>(k)), position.frames[k].file);
  return what;
}

Outputs::Outputs(const CaseFacts& facts, const Options& options, const OutputPosition* continued)
    : facts_(facts), options_(options), log_(log_path(options), facts, checked_log(options, continued)) {
  if (!options.frames) return;
  frames_.emplace(options.out, facts, facts.text_frames ? VtpData::text : VtpData::appended,
                  continued != nullptr ? continued->frames : std::vector<WrittenFrame>{});
  if (!facts.dump) return;
  dump_.emplace(dump_path(options), continued != nullptr && continued->dump ? *continued->dump : FilePosition{});
}

void Outputs::frame(const Snapshot& snapshot) {
  if (frames_) frames_->write(snapshot);
  if (dump_) dump_->append(encode_dump(snapshot, facts_));
}

OutputPosition Outputs::position() const {
  OutputPosition position{log_.position(), std::nullopt, {}};
  if (dump_) position.dump = dump_->position();
  if (frames_) position.frames = frames_->written();
  return position;
}

std::string Outputs::damage() const {
  const OutputPosition now = position();
  std::string what = difference(options_, now);
  std::error_code error;
  const auto is_longer = [&](const std::filesystem::path& path, const FilePosition& written) {
    if (what.empty() && std::filesystem::file_size(path, error) != written.size)
      what = fmt::format("{} is longer than what has been written", path.string());
  };
  is_longer(log_path(options_), now.log);
  if (now.dump) is_longer(dump_path(options_), *now.dump);
  if (what.empty()) return what;
  return fmt::format(
      "{}: somebody else has written there during the run\n  put back what it was and go on with --resume, or "
      "begin anew with --fresh",
      what);
}

void Outputs::flush() {
  log_.flush();
  if (dump_) dump_->flush();
  if (frames_) frames_->flush();
}

}  // namespace fixdem::program
