// What the keys of a case must satisfy together. Each check points at one key and says what to change.
//
// Order: keys that apply, sizes, conditions, times, then `complete`, then the line, geometry, placed particles, then
// the predecessor. A check is left out when one of the keys it needs was missing or refused, so that one mistake gives
// one message.
#pragma once

#include <string>

#include "reader.hpp"
#include "report.hpp"

namespace fixdem::casegen {

/// Keys that belong to one choice only (schema.hpp, `When`): missing where needed, refused elsewhere.
void check_applicable_keys(Reading& reading, Report& report);

/// Species and distributions of diameters, from which count, `sizes` and what equal spheres have follow.
void check_sizes(Reading& reading, Report& report);

/// Keys that need or exclude one another: contact law, start, gas, intervals.
void check_conditions(Reading& reading, Report& report);

/// The gas: what its keys and the pipe must satisfy together. Part of check_conditions, once gravity is known.
void check_gas(const Reading& reading, Report& report);

/// An open pipe has a feed, another one none. Part of check_conditions.
void check_feed_table(const Reading& reading, Report& report);

/// Fills in the defaults that follow from other keys. Needs no valid case: what is unknown stays 0.
void complete(Reading& reading);

/// Time step, duration and intervals.
void check_times(const Reading& reading, Report& report);

/// Pipe, slices, solids fraction and tiles.
void check_geometry(const Reading& reading, Report& report);

/// A line: room for its particles, feed section; and stations along any pipe.
void check_line(Reading& reading, Report& report);

/// Particles placed one by one.
void check_placed(const Reading& reading, Report& report);

/// The case that `[start] from` names: exists, is itself in order, fits, and does not lead back here.
void check_predecessor(const Reading& reading, const std::string& file, Report& report);

/// Whether a `[start] from` is a name or a path without a sign that means something to a shell or to make.
bool is_plain_path(const std::string& from);

/// Path of the case that a file's `[start] from` names, from the folder of the file.
std::string predecessor_path(const std::string& file, const std::string& from);

/// Name of that case: what its results are called.
std::string predecessor_name(const std::string& from);

/// The text of a file, byte for byte, as far as one of allowed length goes. Throws std::system_error.
std::string read_file(const std::string& path);

/// Reads and checks a case file, its predecessor excepted.
Reading load_case(const std::string& text, const std::string& label, Report& report);

}  // namespace fixdem::casegen
