// The folder of a run: what lies in it, what a new run takes away, what a resumed one keeps.
#pragma once

#include <filesystem>
#include <vector>

namespace fixdem::program {

/// Makes the folder and takes away the results of an earlier run, so that what lies there afterwards belongs together.
/// Nothing else in the folder is touched.
void prepare_folder(const std::filesystem::path& out);

/// Takes away what an interrupted run wrote after its checkpoint, when that had `frames` frames: the rest of them,
/// final state, summary, and what was half written.
void tidy_folder(const std::filesystem::path& out, int frames);

/// Checkpoints in the folder, the latest first.
std::vector<std::filesystem::path> checkpoints_in(const std::filesystem::path& out);

std::filesystem::path frame_path(const std::filesystem::path& out, int number);
std::filesystem::path checkpoint_path(const std::filesystem::path& out, long long step);

/// Removes a file, if it is there.
void remove_file(const std::filesystem::path&);

}  // namespace fixdem::program
