// Writing a generated file so that make and readers never see a half-written or needlessly new one.
#pragma once

#include <string>

namespace fixdem::casegen {

/// Replaces the file in one step (temporary file in the same folder, then rename), creating its folder when missing.
/// A file that already has this content keeps its time stamp. Returns false when nothing had to be written.
/// Throws std::system_error.
bool write_if_changed(const std::string& path, const std::string& content);

}  // namespace fixdem::casegen
