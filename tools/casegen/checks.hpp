// What the keys of a case must satisfy together. Each check points at one key and says what to change.
//
// Order: conditions, then `complete`, then geometry, then the predecessor. A check is left out when one of the keys it
// needs was missing or refused, so that one mistake gives one message.
#pragma once

#include <string>

#include "reader.hpp"
#include "report.hpp"

namespace fixdem::casegen {

/// Keys that need or exclude one another: contact law, start, gas, intervals.
void check_conditions(Reading& reading, Report& report);

/// Fills in the defaults that follow from other keys. Needs no valid case: what is unknown stays 0.
void complete(Reading& reading);

/// Pipe, slices, solids fraction and placed particles.
void check_geometry(const Reading& reading, Report& report);

/// The case that `[start] from` names: exists, is itself in order, fits, and does not lead back here.
void check_predecessor(const Reading& reading, const std::string& file, Report& report);

/// Path of the case that a file's `[start] from` names: in the same folder.
std::string predecessor_path(const std::string& file, const std::string& from);

/// The text of a file, byte for byte. Throws std::system_error.
std::string read_file(const std::string& path);

/// Reads and checks a case file, its predecessor excepted.
Reading load_case(const std::string& text, const std::string& label, Report& report);

}  // namespace fixdem::casegen
