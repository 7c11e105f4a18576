// The generated header of a case: `constexpr` data only, every number exact.
#pragma once

#include <cstdint>
#include <string>

#include "case_values.hpp"

namespace fixdem::casegen {

/// A C++ name for the case: the file's stem, with _ for what a name cannot contain, and `case_` before stems that
/// would clash with a word of C++ or a member of the header.
std::string struct_name(const std::string& stem);

struct Source {
  std::string label;       ///< path of the case file, as written into the header
  std::string name;        ///< the file's stem: the name of the case
  std::uint64_t hash = 0;  ///< XXH64 of the file's bytes
};

std::string write_header(const CaseValues& values, const Source& source);

}  // namespace fixdem::casegen
