// One row for each slip: what the line looks like, and what to write instead. Lines are cut before they are matched,
// because std::regex needs stack for every letter.
#include "syntax_hint.hpp"

#include <array>
#include <regex>

namespace fixdem::casegen {
namespace {

struct Slip {
  const char* looks_like;
  const char* advice;
};

#define FIXDEM_NUMBER "[-+]?[0-9]+(\\.[0-9]*)?([eE][-+]?[0-9]+)?"
constexpr std::array slips = {
    Slip{"=\\s*[-+]?[0-9]+,[0-9]+\\s*(#.*)?$", "write a decimal point, not a comma: 0.010, not 0,010"},
    Slip{"=\\s*" FIXDEM_NUMBER "\\s*[*x]\\s*10", "write a power of ten with e: 2.0e-6"},
    Slip{"=\\s*" FIXDEM_NUMBER "\\s*[*/+^-]\\s*[0-9]", "there is no arithmetic: write the result as one number"},
    Slip{"=\\s*[-+]?([0-9]+\\.|\\.[0-9]+)\\s*([eE#,].*)?$", "write digits on both sides of the point: 0.5 and 5.0"},
    Slip{"=\\s*" FIXDEM_NUMBER "\\s*[a-zA-Z%]",
         "write the number alone, without a unit: each key has its own, all SI; a remark goes behind a #"},
    Slip{"=\\s*[-+]?0[0-9]", "write numbers without leading zeros"},
    Slip{"=\\s*[-+]?[0-9]{19,}\\s*(#.*)?$", "the number is too long: write it with an exponent, as 1.0e20"},
    Slip{"=\\s*(True|False|TRUE|FALSE|[Yy]es|[Nn]o|[Oo]n|[Oo]ff)\\s*(#.*)?$",
         "write true or false, without quotes, in small letters"},
    Slip{"=\\s*[a-zA-Z_]", "write texts and words in double quotes: ends = \"periodic\""},
    Slip{"=\\s*(#.*)?$", "the value is missing: write one behind the ="},
    Slip{"^\\s*[A-Za-z0-9_.-]+\\s*:", "write an equals sign between key and value: key = value"},
    Slip{"^\\s*[A-Za-z0-9_.-]+\\s+[^=\\s]", "write an equals sign between key and value: key = value"},
    Slip{"^\\s*\\[[^\\]]*(#.*)?$", "close the brackets: [particles], or a list in one pair of [ ]"},
};

std::string line_at(std::string_view text, Place place) {
  std::size_t start = 0;
  for (std::uint32_t line = 1; line < place.line && start < text.size(); ++line) {
    const auto end = text.find('\n', start);
    if (end == std::string_view::npos) return "";
    start = end + 1;
  }
  std::string_view line = text.substr(start, text.find_first_of("\r\n", start) - start);
  constexpr std::size_t longest = 200;
  return std::string(line.substr(0, longest));
}

}  // namespace

std::string syntax_hint(std::string_view text, Place place, std::string_view description) {
  if (description.find("redefine") != std::string_view::npos || description.find("duplicate") != std::string_view::npos)
    return "this key or table stands in the file twice: keep one of the two";
  const std::string line = line_at(text, place);
  for (const auto& [looks_like, advice] : slips)
    if (std::regex_search(line, std::regex(looks_like))) return advice;
  return "this is not TOML: one key = value to a line, texts in double quotes, tables as [name]";
}

}  // namespace fixdem::casegen
