// The folder of a run: what lies in it, what a new run takes away, what a resumed one keeps.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace fixdem::program {

/// Makes the folder and takes away the results of an earlier run, so that what lies there afterwards belongs together.
/// Nothing else in the folder is touched.
void prepare_folder(const std::filesystem::path& out);

/// Takes away what an interrupted run wrote after its checkpoint, when that had so many frames and files of contacts:
/// the rest of them, final state, summary, and what was half written.
void tidy_folder(const std::filesystem::path& out, int frames, int contacts);

/// Whether results of a run lie in the folder: anything that a new run would take away.
bool holds_results(const std::filesystem::path& out);

/// Moves all results, and what has been made of them (pages, movies), to the first of OUT.1, OUT.2, ... that does not
/// exist, and returns it. Whatever else lies in the folder stays; so does the folder itself, be it a link, somebody's
/// current folder or a mount point.
std::filesystem::path move_aside(const std::filesystem::path& out);

/// Checkpoints in the folder, the latest first.
std::vector<std::filesystem::path> checkpoints_in(const std::filesystem::path& out);

/// Of a series of files (vtp_series.hpp): its folder, its list, and one of them.
std::filesystem::path series_folder(const std::filesystem::path& out, const std::string& name);
std::filesystem::path series_list(const std::filesystem::path& out, const std::string& name);
std::filesystem::path member_path(const std::filesystem::path& out, const std::string& name, int number);
inline std::filesystem::path frame_path(const std::filesystem::path& out, int number) {
  return member_path(out, "frame", number);
}
std::filesystem::path checkpoint_path(const std::filesystem::path& out, long long step);

/// Removes a file, if it is there.
void remove_file(const std::filesystem::path&);

}  // namespace fixdem::program
