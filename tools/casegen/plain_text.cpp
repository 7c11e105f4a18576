// Skips comments and the four kinds of TOML texts; looks at each sign of the rest.
#include "plain_text.hpp"

#include <fmt/format.h>

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

/// Follows brackets and dotted names from sign to sign; an array of numbers has as many dots as it likes.
class Nesting {
 public:
  /// False at the sign that goes too deep.
  bool take(char sign) {
    if (sign == '[' || sign == '{') ++depth_;
    if ((sign == ']' || sign == '}') && depth_ > 0) --depth_;
    if (sign == '.') ++parts_;
    if (sign == '\n' || sign == '=' || sign == ',' || sign == '[' || sign == ']' || sign == '{' || sign == '}')
      parts_ = 1;
    return depth_ <= deepest_nesting && parts_ <= deepest_nesting;
  }

 private:
  int depth_ = 0, parts_ = 1;
};

}  // namespace

std::optional<Objection> objection_to(std::string_view text) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (text.size() > longest_file)
    return Objection{{},
                     fmt::format("the file is longer than {} MiB; allowed: at most that", longest_file >> 20),
                     "start many particles at random, or from another case's final state, instead of placing each"};
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
    return Objection{{}, "the file is UTF-16; allowed: UTF-8 or plain ASCII", "save it again as UTF-8"};
  Nesting nesting;
  for (std::size_t i = text.starts_with(byte_order_mark) ? byte_order_mark.size() : 0; i < text.size();) {
    if ((text[i] & 0x80) != 0)
      return Objection{place_of(text, i),
                       "a character that is not ASCII outside texts and comments; allowed: plain letters and signs",
                       "type it anew: it may be a dash, blank or quotation mark copied from a document"};
    if (!nesting.take(text[i]))
      return Objection{place_of(text, i), fmt::format("nested too deeply; allowed: at most {} levels", deepest_nesting),
                       "the case format has tables and keys in them, as in [particles] and count = 1000; no more"};
    i += length_of_token(text.substr(i));
  }
  return std::nullopt;
}

}  // namespace fixdem::casegen
