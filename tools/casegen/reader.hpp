// From the text of a case file to `CaseValues`: TOML syntax, names, types and ranges of single keys.
//
// Everything wrong is reported, never only the first thing; what was wrong or missing is remembered, so that later
// checks of several keys together do not report consequences of the same mistake again.
#pragma once

#include <initializer_list>
#include <map>
#include <set>
#include <string>
#include <string_view>

#include "case_values.hpp"
#include "report.hpp"

namespace fixdem::casegen {

/// Where a key stands in the file, and its value as written there.
struct Given {
  Place key;
  Place value;
  std::string text;
};

struct Reading {
  CaseValues values;
  std::map<std::string, Given> given;   ///< by "table.key"; of entry k of a list "table.k.key", k from 0
  std::map<std::string, Place> tables;  ///< the tables that the file has; of lists "table" and each "table.k"
  std::set<std::string> unusable;       ///< "table.key" of missing and refused values
  /// The keys that number of particles and largest diameter come from; others than these with several sizes.
  std::string count_key = "particles.count", largest_key = "particles.diameter";

  bool has(const std::string& key) const { return given.contains(key); }
  bool usable(std::initializer_list<std::string_view> keys) const {
    for (const auto key : keys)
      if (unusable.contains(std::string(key))) return false;
    return true;
  }
  /// Where to point for a key: its value, or its table when a default is at work.
  Place place(const std::string& key) const;
  /// "[table] key = value", with the value as written.
  std::string quote(const std::string& key) const;
};

/// Reads the text; errors go to the report, and the result is complete only when there are none.
Reading read_case(std::string_view text, std::string_view file, Report& report);

}  // namespace fixdem::casegen
