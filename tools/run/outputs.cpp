#include "outputs.hpp"

#include <fmt/format.h>

#include "contacts_vtp.hpp"
#include "dump.hpp"
#include "failure.hpp"
#include "frames_vtp.hpp"
#include "line_record.hpp"
#include "result_folder.hpp"

namespace fixdem::program {

std::string difference(const Options& options, const OutputPosition& position) {
  std::string what;
  for (const NamedPosition& grown : position.grown)
    if (what.empty()) what = difference(options.out / grown.name, grown.file);
  const auto look_at = [&](const char* name, const std::vector<WrittenFrame>& written) {
    for (std::size_t k = 0; what.empty() && k < written.size(); ++k)
      what = difference(member_path(options.out, name, static_cast<int>(k)), written[k].file);
  };
  look_at("frame", position.frames);
  look_at("contact", position.contacts);
  return what;
}

Outputs::Outputs(const CaseFacts& facts, const Options& options, const OutputPosition* continued)
    : facts_(facts), options_(options) {
  if (continued != nullptr) {
    if (const std::string what = difference(options, *continued); !what.empty())
      throw Failure(exit_bad_input,
                    fmt::format("cannot resume: {}\n  put back what it was, or begin anew with --fresh", what));
    tidy_folder(options.out, static_cast<int>(continued->frames.size()), static_cast<int>(continued->contacts.size()));
  }
  const auto begin = [&](const std::string& name, const std::string& header) {
    FilePosition position;
    if (continued != nullptr)
      for (const NamedPosition& grown : continued->grown)
        if (grown.name == name) position = grown.file;
    AppendedFile& file = grown_.try_emplace(name, options.out / name, position).first->second;
    if (position.size == 0 && !header.empty()) file.append(header);
  };
  begin("log.csv", log_header(facts));
  for (const auto& [name, header] : LineRecord::files(facts)) begin(name, header);
  if (!options.frames) return;
  frames_.emplace(options.out, "frame", continued != nullptr ? continued->frames : std::vector<WrittenFrame>{});
  if (facts.contact_interval > 0)
    contacts_.emplace(options.out, "contact", continued != nullptr ? continued->contacts : std::vector<WrittenFrame>{});
  if (facts.dump) begin("dump.lammpstrj", "");
}

void Outputs::frame(const Snapshot& snapshot) {
  if (!frames_) return;
  frames_->write(snapshot.time, encode_vtp(snapshot, facts_, data()));
  if (facts_.dump) append("dump.lammpstrj", encode_dump(snapshot, facts_));
}

void Outputs::contacts(const Snapshot& snapshot) {
  if (contacts_) contacts_->write(snapshot.time, encode_contacts(snapshot, facts_, data()));
}

OutputPosition Outputs::position() const {
  OutputPosition position;
  for (const auto& [name, file] : grown_) position.grown.push_back({name, file.position()});
  if (frames_) position.frames = frames_->written();
  if (contacts_) position.contacts = contacts_->written();
  return position;
}

std::string Outputs::damage() const {
  const OutputPosition now = position();
  std::string what = difference(options_, now);
  std::error_code error;
  for (const NamedPosition& grown : now.grown)
    if (const auto path = options_.out / grown.name;
        what.empty() && std::filesystem::file_size(path, error) != grown.file.size)
      what = fmt::format("{} is longer than what has been written", path.string());
  if (what.empty()) return what;
  return fmt::format(
      "{}: somebody else has written there during the run\n  put back what it was and go on with --resume, or "
      "begin anew with --fresh",
      what);
}

void Outputs::flush() {
  for (auto& [name, file] : grown_) file.flush();
  if (frames_) frames_->flush();
  if (contacts_) contacts_->flush();
}

}  // namespace fixdem::program
