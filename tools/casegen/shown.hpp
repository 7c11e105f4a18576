// Text of a case file as a message quotes it: one line, of bounded length, harmless to a terminal.
#pragma once

#include <string>
#include <string_view>

namespace fixdem::casegen {

/// Control characters become \xNN; longer than `longest` bytes ends in "...", never within a letter of UTF-8.
std::string shown(std::string_view text, std::size_t longest = 60);

/// Whether the text has a control character of ASCII or of Latin-1 in UTF-8.
bool has_control_characters(std::string_view text);

}  // namespace fixdem::casegen
