// Skips comments and the four kinds of TOML texts; whatever else is not ASCII is stray.
#include "plain_text.hpp"

#include <algorithm>

namespace fixdem::casegen {
namespace {

/// Length of the comment or text that begins here, or 1.
std::size_t length_of_token(std::string_view rest) {
  if (rest.front() == '#') return std::min(rest.find('\n'), rest.size());
  const char quote = rest.front();
  if (quote != '"' && quote != '\'') return 1;
  const std::string_view triple = rest.substr(0, 3);
  const bool many_lines = triple == R"(""")" || triple == "'''";
  const std::string_view end = many_lines ? triple : rest.substr(0, 1);
  for (std::size_t i = end.size(); i < rest.size(); ++i) {
    if (rest[i] == '\n' && !many_lines) return i;  // not closed: the parser will say so
    if (rest[i] == '\\' && quote == '"') {
      ++i;
      continue;
    }
    if (!rest.substr(i).starts_with(end)) continue;
    i += end.size();
    // A text of many lines may end in one or two quotes of its own.
    for (int extra = 0; many_lines && extra < 2 && i < rest.size() && rest[i] == quote; ++extra) ++i;
    return i;
  }
  return rest.size();
}

Place place_of(std::string_view text, std::size_t at) {
  const std::string_view before = text.substr(0, at);
  const auto line_start = before.rfind('\n') + 1;  // npos + 1 is 0
  const auto column = std::count_if(before.begin() + static_cast<std::ptrdiff_t>(line_start), before.end(),
                                    [](char c) { return (c & 0xC0) != 0x80; });  // characters, not bytes
  return {static_cast<std::uint32_t>(1 + std::count(before.begin(), before.end(), '\n')),
          static_cast<std::uint32_t>(1 + column)};
}

}  // namespace

std::optional<Place> find_stray_letter(std::string_view text) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  for (std::size_t i = text.starts_with(byte_order_mark) ? byte_order_mark.size() : 0; i < text.size();) {
    if ((text[i] & 0x80) != 0) return place_of(text, i);
    i += length_of_token(text.substr(i));
  }
  return std::nullopt;
}

}  // namespace fixdem::casegen
