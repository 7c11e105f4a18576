// The lines of a generated header, and how values are written in it.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <string>

#include "case_values.hpp"

namespace fixdem::casegen {

inline std::string exact(double value) { return std::isinf(value) ? "__builtin_inf()" : fmt::format("{:a}", value); }

inline std::string exact(const Vector3& v) {
  return fmt::format("{{{}, {}, {}}}", exact(v[0]), exact(v[1]), exact(v[2]));
}

/// A C++ string literal; UTF-8 passes through, control characters become octal escapes.
inline std::string literal(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      result += fmt::format("\\{}", c);
    else if (static_cast<unsigned char>(c) < 32 || c == 127)
      result += fmt::format("\\{:03o}", static_cast<unsigned>(c));
    else
      result += c;
  }
  return result + '"';
}

/// Collects lines of the form `static constexpr type name = value;  // comment`.
class Members {
 public:
  void real(const char* name, double value, const char* unit) {
    add("double", name, exact(value), fmt::format("{}{}{}", value, *unit != '\0' ? " " : "", unit));
  }
  void vector(const char* name, const Vector3& v, const char* unit) {
    add("double", fmt::format("{}[3]", name), exact(v), fmt::format("{}, {}, {} {}", v[0], v[1], v[2], unit));
  }
  void whole(const char* name, std::int64_t value) { add("int", name, fmt::format("{}", value), ""); }
  /// A number of 64 bits that is not negative.
  void seed(const char* name, std::int64_t value) { add("unsigned long long", name, fmt::format("{}ULL", value), ""); }
  void in_time(const char* name, const TimeTable& rows, const char* unit) {
    std::string list, words;
    for (const auto& [time, value] : rows) {
      list += fmt::format("{}{{{}, {}}}", list.empty() ? "" : ", ", exact(time), exact(value));
      words += fmt::format("{}{} at {} s", words.empty() ? "" : ", ", value, time);
    }
    add("TimeValue", fmt::format("{}[]", name), "{" + list + "}", fmt::format("{}; {}", words, unit));
  }
  void flag(const char* name, bool value) { add("bool", name, value ? "true" : "false", ""); }
  void text(const char* name, const std::string& value) { add("const char*", name, literal(value), ""); }
  void choice(const char* type, const char* name, const std::string& value) {
    add(type, name, fmt::format("{}::{}", type, value), "");
  }
  void add(const char* type, const std::string& name, const std::string& value, const std::string& comment) {
    fmt::format_to(std::back_inserter(text_), "  static constexpr {} {} = {};{}{}\n", type, name, value,
                   comment.empty() ? "" : "  // ", comment);
  }
  void heading(const char* words) { fmt::format_to(std::back_inserter(text_), "\n  // {}\n", words); }
  const std::string& str() const { return text_; }

 private:
  std::string text_;
};

/// What only a line has: how many are there at the start, and its feed.
void write_start_count(Members& members, const CaseValues& values);
void write_feed(Members& members, const CaseValues& values);

/// What of the gas is only in headers of cases that use it.
void write_gas_beyond(Members& members, const CaseValues& values);

/// Intervals and stations of the program that a case uses.
void write_watching(Members& members, const CaseValues& values);

}  // namespace fixdem::casegen
