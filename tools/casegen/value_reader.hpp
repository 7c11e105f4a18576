// One TOML value against one row of the table of keys.
#pragma once

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>

#include "nearest_name.hpp"
#include "report.hpp"
#include "schema.hpp"
#include "shown.hpp"
#include "toml.hpp"

namespace fixdem::casegen {

inline Place place_of(const toml::source_region& source) { return {source.begin.line, source.begin.column}; }

/// The value as TOML would write it, numbers in the shortest form that reads back exactly; cut when it is long.
inline std::string written(const toml::node& node) {
  constexpr std::size_t longest = 60;
  std::string text;
  if (const auto* real = node.as_floating_point()) {
    text = fmt::format("{}", real->get());
  } else if (const auto* string = node.as_string()) {
    text = fmt::format("\"{}\"", shown(string->get(), longest));
  } else if (const auto* list = node.as_array()) {
    for (const auto& entry : *list) {
      if (text.size() > longest) break;
      text += (text.empty() ? "" : ", ") + written(entry);
    }
    text = "[" + text + "]";
  } else if (const auto* table = node.as_table()) {  // toml++ counts its digits beforehand, of 5e-5 minus three
    for (const auto& [key, value] : *table) {
      if (text.size() > longest) break;
      text += (text.empty() ? "" : ", ") + fmt::format("{} = {}", shown(key.str(), longest), written(value));
    }
    text = "{" + text + "}";
  } else {
    std::ostringstream stream;
    node.visit([&](const auto& value) { stream << value; });
    text = stream.str();
  }
  return shown(text, longest);
}

inline std::string written_type(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "a list";
    case toml::node_type::string:
      return "a text";
    case toml::node_type::integer:
      return "a whole number";
    case toml::node_type::floating_point:
      return std::isfinite(node.as_floating_point()->get()) ? "a number with a point" : "no finite number";
    case toml::node_type::boolean:
      return "true or false";
    default:
      return "a date or time";
  }
}

/// A real number; an integer counts as one. False when the node is something else.
inline bool read_real(const toml::node& node, double& value) {
  if (const auto* real = node.as_floating_point())
    value = real->get();
  else if (const auto* whole = node.as_integer())
    value = static_cast<double>(whole->get());
  else
    return false;
  return true;
}

/// Whether products of some such numbers, such as a mass, can be computed with.
inline bool has_usable_size(double value) {
  return value == 0 || std::isinf(value) || (std::abs(value) >= 1e-50 && std::abs(value) <= 1e50);
}
constexpr const char* unusable_size = "cannot be computed with: sizes go from 1e-50 to 1e50";

template <class Record>
std::string assign(const Real<Record>& real, const toml::node& node, Record& record) {
  double value = 0;
  if (!read_real(node, value))
    return fmt::format("is {}, but must be a number{}", written_type(node),
                       node.is_string() ? ", without quotes and unit" : "");
  if (std::isnan(value)) return "is not a number";
  const bool allowed_infinity = real.infinity_allowed && std::isinf(value) && value > 0;
  if (!real.range.contains(value) && !allowed_infinity) return std::isinf(value) ? "must be finite" : "is out of range";
  if (!has_usable_size(value)) return unusable_size;
  record.*real.member = value;
  return "";
}

template <class Record>
std::string assign(const Whole<Record>& whole, const toml::node& node, Record& record) {
  const auto* value = node.as_integer();
  if (value == nullptr) {
    const auto* real = node.as_floating_point();
    const bool is_whole = real != nullptr && std::abs(real->get()) < 1e15 && std::trunc(real->get()) == real->get();
    return is_whole ? fmt::format("is written with a point or an exponent, but must be a whole number: write {:.0f}",
                                  real->get())
                    : fmt::format("is {}, but must be a whole number", written_type(node));
  }
  if (!whole.range.contains(static_cast<double>(value->get()))) return "is out of range";
  record.*whole.member = value->get();
  return "";
}

template <class Record>
std::string assign(const Flag<Record>& flag, const toml::node& node, Record& record) {
  const auto* value = node.as_boolean();
  if (value == nullptr) return fmt::format("is {}, but must be true or false", written_type(node));
  record.*flag.member = value->get();
  return "";
}

template <class Record>
std::string assign(const Text<Record>& text, const toml::node& node, Record& record) {
  const auto* value = node.as_string();
  if (value == nullptr) return fmt::format("is {}, but must be a text", written_type(node));
  if (value->get().empty()) return "is empty";
  if (value->get().size() > longest_text) return fmt::format("has {} bytes", value->get().size());
  if (has_control_characters(value->get())) return "has line breaks or other control characters in it";
  record.*text.member = value->get();
  return "";
}

template <class Record>
std::string assign(const Choice<Record>& choice, const toml::node& node, Record& record) {
  const auto* value = node.as_string();
  if (value == nullptr) return fmt::format("is {}, but must be a text", written_type(node));
  for (const auto& option : choice.options)
    if (option == value->get()) {
      record.*choice.member = option;
      return "";
    }
  const std::string nearest = nearest_name(value->get(), choice.options);
  return nearest.empty() ? "is unknown" : fmt::format("is unknown (did you mean \"{}\"?)", nearest);
}

template <class Record>
std::string assign(const Vector<Record>& vector, const toml::node& node, Record& record) {
  const auto* values = node.as_array();
  if (values == nullptr) return fmt::format("is {}, but must be a list of three numbers", written_type(node));
  if (values->size() != 3) return fmt::format("has {} entries, but must have three", values->size());
  Vector3 result{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!read_real((*values)[axis], result[axis]))
      return fmt::format("has {} in it, but must have three numbers", written_type((*values)[axis]));
    if (!std::isfinite(result[axis])) return "must be finite";
    if (!has_usable_size(result[axis])) return unusable_size;
  }
  record.*vector.member = result;
  return "";
}

inline bool is_name(std::string_view text) {
  return !text.empty() && text.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-") ==
                              std::string_view::npos;
}

template <class Record>
std::string assign(const Name<Record>& name, const toml::node& node, Record& record) {
  const std::string problem = assign(Text<Record>{name.member}, node, record);
  return !problem.empty() || is_name(record.*name.member) ? problem : "has other signs in it";
}

template <class Record>
std::string assign(const NameOrNumber<Record>& name, const toml::node& node, Record& record) {
  if (const auto* number = node.as_integer()) {
    if (number->get() < 0) return "is out of range";
    record.*name.member = fmt::format("{}", number->get());
    return "";
  }
  if (!node.is_string()) return fmt::format("is {}, but must be a whole number or a text", written_type(node));
  return assign(Name<Record>{name.member}, node, record);
}

template <class Record>
std::string assign(const Numbers<Record>& numbers, const toml::node& node, Record& record) {
  const auto* list = node.as_array();
  if (list == nullptr) return fmt::format("is {}, but must be a list of numbers", written_type(node));
  if (list->size() < 2 || list->size() > longest_list) return fmt::format("has {} entries", list->size());
  std::vector<double> values;
  for (const toml::node& entry : *list) {
    double value = 0;
    if (!read_real(entry, value)) return fmt::format("has {} in it, but must have numbers", written_type(entry));
    if (std::isnan(value)) return "has something in it that is not a number";
    if (!numbers.range.contains(value)) return fmt::format("has {} in it, which is out of range", value);
    if (!has_usable_size(value)) return unusable_size;
    values.push_back(value);
  }
  record.*numbers.member = std::move(values);
  return "";
}

/// One row of a table in time into the table; returns what is wrong with it, or "".
inline std::string add_row(const toml::node& node, Range range, TimeTable& rows) {
  const std::string row = fmt::format("row {}", rows.size() + 1);
  const auto* pair = node.as_array();
  if (pair == nullptr || pair->size() != 2)
    return fmt::format("has {} as {}, but must have [t, value]", written(node), row);
  TimeValue own{};
  if (const auto problem = assign(Real<TimeValue>{&TimeValue::time, not_negative}, (*pair)[0], own); !problem.empty())
    return fmt::format("has a time in {} that {}", row, problem);
  if (const auto problem = assign(Real<TimeValue>{&TimeValue::value, range}, (*pair)[1], own); !problem.empty())
    return fmt::format("has a value in {} that {}", row, problem);
  if (!rows.empty() && own.time <= rows.back().time)
    return fmt::format("has times that do not increase: {} in {} after {}", own.time, row, rows.back().time);
  rows.push_back(own);
  return "";
}

template <class Record>
std::string assign(const InTime<Record>& table, const toml::node& node, Record& record) {
  TimeTable rows;
  if (const auto* list = node.as_array()) {
    if (list->empty() || list->size() > longest_list) return fmt::format("has {} rows", list->size());
    for (const toml::node& row : *list)
      if (auto problem = add_row(row, table.range, rows); !problem.empty()) return problem;
  } else {
    rows.resize(1);
    const Real<TimeValue> number{&TimeValue::value, table.range};
    if (auto problem = assign(number, node, rows[0]); !problem.empty()) return problem;
  }
  record.*table.member = std::move(rows);
  return "";
}

template <class Record>
std::string assign(const Memory<Record>& memory, const toml::node& node, Record& record) {
  constexpr std::int64_t maximum = std::int64_t{1} << 40;
  std::int64_t count = 0, unit = 1;
  if (const auto* whole = node.as_integer()) {
    count = whole->get();
  } else if (const auto* text = node.as_string()) {
    const std::string& written = text->get();
    const auto [end, error] = std::from_chars(written.data(), written.data() + written.size(), count);
    const std::string_view name(end, written.data() + written.size());
    if (error != std::errc()) return "does not begin with a whole number";
    if (name == " KiB")
      unit = 1024;
    else if (name == " MiB")
      unit = 1024 * 1024;
    else if (name != " B")
      return "has no unit that is known here";
  } else {
    return fmt::format("is {}, but must be a text or a whole number", written_type(node));
  }
  if (count < 1 || count > maximum / unit) return "is out of range";
  record.*memory.member = count * unit;
  return "";
}

/// Reads the value into the record; returns what is wrong with it, or "".
template <class Record>
std::string assign(const Rule<Record>& rule, const toml::node& node, Record& record) {
  return std::visit([&](const auto& binding) { return assign(binding, node, record); }, rule.binding);
}

}  // namespace fixdem::casegen
