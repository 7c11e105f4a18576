// One row for each slip: what the line looks like, and what to write instead. Lines are cut before they are matched,
// because std::regex needs stack for every letter.
#include "syntax_hint.hpp"

#include <regex>
#include <vector>

namespace fixdem::casegen {
namespace {

struct Slip {
  std::regex looks_like;
  const char* advice;
};

const std::vector<Slip>& slips() {
  static const std::string number = R"(=\s*[-+]?[0-9]+(\.[0-9]*)?([eE][-+]?[0-9]+)?)", rest = R"(\s*(#.*)?$)";
  static const std::vector<Slip> all = {
      {std::regex(R"(^\s*[A-Za-z0-9_.-]+\s*:)"), "write an equals sign between key and value: key = value"},
      {std::regex(R"(^\s*[A-Za-z0-9_.-]+\s+[^=\s])"), "write an equals sign between key and value: key = value"},
      {std::regex(R"(=\s*=)"), "write one equals sign"},
      {std::regex(R"(=\s*[-+]?[0-9]+,[0-9.,]+)" + rest),
       "write a decimal point, not a comma, and nothing between thousands: 0.010"},
      {std::regex(R"(=\s*[-+]?0[xX][0-9a-fA-F]*[.pP])"), "write a decimal number"},
      {std::regex(number + R"(\s*[*x]\s*10)"), "write a power of ten with e: 2.0e-6"},
      {std::regex(number + R"(\s*[*/+^-]\s*[0-9])"), "there is no arithmetic: write the result as one number"},
      {std::regex(R"(=\s*[-+]?([0-9]+\.|\.[0-9]+)\s*([eE#,].*)?$)"),
       "write digits on both sides of the point: 0.5 and 5.0"},
      {std::regex(number + R"(\s*([a-df-zA-DF-Z%]|[eE](?![-+0-9])))"),
       "write the number alone, without a unit: each key has its own, all SI; a remark goes behind a #"},
      {std::regex(R"(=\s*[-+]?0[0-9])"), "write numbers without leading zeros"},
      {std::regex(R"(=\s*(True|False|TRUE|FALSE|[Yy]es|[Nn]o|[Oo]n|[Oo]ff))" + rest),
       "write true or false, without quotes, in small letters"},
      {std::regex(R"(=\s*[a-zA-Z_])"), "write texts and words in double quotes: ends = \"periodic\""},
      {std::regex("=" + rest), "the value is missing: write one behind the ="},
      {std::regex(R"(^\s*\[[^\]]*(#.*)?$)"), "close the brackets: [particles], or a list in one pair of [ ]"},
  };
  return all;
}

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
  if (description.find("representable") != std::string_view::npos ||
      description.find("interpreted") != std::string_view::npos)
    return "the number is too large: whole ones go to 9223372036854775807, others to 1e50";
  const std::string line = line_at(text, place);
  for (const auto& [looks_like, advice] : slips())
    if (std::regex_search(line, looks_like)) return advice;
  return "this is not TOML: one key = value to a line, texts in double quotes, tables as [name]";
}

}  // namespace fixdem::casegen
