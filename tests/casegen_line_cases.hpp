// An open line for the tests of casegen.
#pragma once

#include "casegen_size_cases.hpp"

namespace casegen_test {

/// Also before a test runs, when nothing can be asserted.
inline std::string opened(std::string text) {
  const std::string ends = "ends = \"periodic\"", gas = "[gas]\n";
  text.replace(text.find(ends), ends.size(), "ends = \"open\"");
  return text.insert(text.find(gas), "[feed]\nrate = 0.25\n");
}

/// The good case as a line.
inline const std::string line_case = opened(good_case);

inline std::string line_with(const std::string& piece, const std::string& by) { return replaced(line_case, piece, by); }

/// One more line in [gas].
inline std::string with_gas(const std::string& lines, const std::string& text = good_case) {
  return replaced(text, "[gas]\n", "[gas]\n" + lines + "\n");
}

/// Without particles at the start.
inline std::string empty_line(const std::string& text = line_case) {
  return replaced(replaced(text, "count = 2", "count = 0"), std::string("[start]\n") + random_start + "\n", "");
}

inline void check_contains(const std::string& text, const std::vector<std::string>& pieces) {
  CAPTURE(text);
  for (const std::string& piece : pieces) CHECK_MESSAGE(contains(text, piece), piece);
}

inline void check_lacks(const std::string& text, const std::vector<std::string>& pieces) {
  CAPTURE(text);
  for (const std::string& piece : pieces) CHECK_MESSAGE(!contains(text, piece), piece);
}

}  // namespace casegen_test
