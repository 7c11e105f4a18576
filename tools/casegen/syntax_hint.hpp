// What was probably meant by a line that is not TOML.
#pragma once

#include <string>
#include <string_view>

#include "report.hpp"

namespace fixdem::casegen {

/// Advice for a refusal of the parser at this place of the file; `description` is the parser's own.
std::string syntax_hint(std::string_view text, Place place, std::string_view description);

}  // namespace fixdem::casegen
