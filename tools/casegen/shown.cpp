// Cuts first, so that the work does not grow with the text.
#include "shown.hpp"

#include <fmt/format.h>

namespace fixdem::casegen {
namespace {

/// Bytes of the control character at the beginning, or 0.
std::size_t length_of_control(std::string_view rest) {
  const auto first = static_cast<unsigned char>(rest[0]);
  if (first < 32 || first == 127) return 1;
  const bool is_latin = first == 0xC2 && rest.size() > 1 && static_cast<unsigned char>(rest[1]) < 0xA0;  // U+0080..9F
  return is_latin ? 2 : 0;
}

}  // namespace

std::string shown(std::string_view text, std::size_t longest) {
  std::size_t end = text.size();
  if (end > longest) {
    end = longest;
    while (end > 0 && (text[end] & 0xC0) == 0x80) --end;
  }
  std::string result;
  for (std::size_t i = 0; i < end;) {
    const std::size_t length = length_of_control(text.substr(i));
    for (std::size_t k = i; k < i + length; ++k)
      result += fmt::format("\\x{:02x}", static_cast<unsigned>(static_cast<unsigned char>(text[k])));
    if (length == 0) result += text[i];
    i += length > 0 ? length : 1;
  }
  return end < text.size() ? result + "..." : result;
}

bool has_control_characters(std::string_view text) {
  for (std::size_t i = 0; i < text.size(); ++i)
    if (length_of_control(text.substr(i)) > 0) return true;
  return false;
}

}  // namespace fixdem::casegen
