// Tables of the case format, and how ranges, types and defaults are put into words.
#include "schema.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace fixdem::casegen {
namespace {

template <class... Alternatives>
struct Overloaded : Alternatives... {
  using Alternatives::operator()...;
};
template <class... Alternatives>
Overloaded(Alternatives...) -> Overloaded<Alternatives...>;

std::string quoted(const std::string& word) { return fmt::format("\"{}\"", word); }

/// Whole numbers without an exponent, others in the shortest form that reads back exactly.
std::string number(double value) {
  if (std::abs(value) < 1e15 && value == std::floor(value)) return fmt::format("{:.0f}", value);
  return fmt::format("{}", value);
}

}  // namespace

std::span<const TableRule> tables() {
  static const std::vector<TableRule> all = {
      {"particles", true, "the particles: equal spheres, unless one of the next two tables says otherwise"},
      {"particles.species", false, "one `[[particles.species]]` table for each kind of particles, at most 16", true},
      {"particles.sizes", false, "particles of one material whose diameters follow a continuous distribution"},
      {"material", true, "what they and the walls are made of"},
      {"contact", false, "the contact law"},
      {"pipe", true, "the pipe"},
      {"feed", false, "what is fed into an open pipe; needed with ends = \"open\", and only there"},
      {"gas", false, "the gas that blows through the pipe; without this table there is none"},
      {"start", true,
       "where the particles come from: exactly one of `arrangement`, `from` and `[[start.particle]]`; an open pipe "
       "with "
       "count = 0 needs none"},
      {"start.particle", false, "one `[[start.particle]]` table per particle, as many as `count` or species say", true},
      {"run", true, "time and its step"},
      {"capacity", false, "fixed sizes of the arrays"},
      {"output", false, "what is written, and how often"},
      {"probe", false, "one `[[probe]]` table for each station along an open pipe that has a time series of its own",
       true},
  };
  return all;
}

std::span<const Rule<CaseValues>> case_keys() {
  static const std::vector<Rule<CaseValues>> all = [] {
    std::vector<Rule<CaseValues>> keys = physics_keys();
    for (auto& key : size_keys()) keys.push_back(key);
    for (auto& key : feed_keys()) keys.push_back(key);
    for (auto& key : run_keys()) keys.push_back(key);
    return keys;
  }();
  return all;
}

const Rule<CaseValues>* find_key(std::string_view table, std::string_view name) {
  for (const auto& rule : case_keys())
    if (rule.table == table && rule.name == name) return &rule;
  return nullptr;
}

const TableRule* find_table(std::string_view name) {
  for (const auto& table : tables())
    if (table.name == name) return &table;
  return nullptr;
}

bool is_needed(const TableRule& table, const CaseValues& v) {
  return table.required && !(table.name == "start" && v.starts_empty());
}

std::string table_title(std::string_view name) {
  const TableRule* table = find_table(name);
  return table != nullptr && table->is_list ? fmt::format("[[{}]]", name) : fmt::format("[{}]", name);
}

bool TableRule::is_part_of(std::string_view table) const {
  return name.size() > table.size() && name.starts_with(table) && name[table.size()] == '.';
}

std::string TableRule::last_name() const { return name.substr(name.rfind('.') + 1); }

bool Range::contains(double value) const {
  if (!std::isfinite(value)) return false;
  return (includes_low ? value >= low : value > low) && (includes_high ? value <= high : value < high);
}

std::string Range::describe() const {
  const bool bounded_below = std::isfinite(low), bounded_above = std::isfinite(high);
  if (bounded_below && bounded_above && includes_low && includes_high)
    return fmt::format("{} to {}", number(low), number(high));
  std::string words;
  if (bounded_below) words = fmt::format("{} {}", includes_low ? "at least" : "above", number(low));
  if (bounded_above)
    words += fmt::format("{}{} {}", words.empty() ? "" : " and ", includes_high ? "at most" : "below", number(high));
  return words.empty() ? "any finite number" : words;
}

template <class Record>
std::string Rule<Record>::type() const {
  return std::visit(
      Overloaded{[](const Real<Record>&) { return "number"; }, [](const Whole<Record>&) { return "whole number"; },
                 [](const Flag<Record>&) { return "true or false"; }, [](const Text<Record>&) { return "text"; },
                 [](const Choice<Record>&) { return "word"; }, [](const Vector<Record>&) { return "three numbers"; },
                 [](const Name<Record>&) { return "text"; },
                 [](const NameOrNumber<Record>&) { return "whole number or text"; },
                 [](const Numbers<Record>&) { return "numbers"; },
                 [](const InTime<Record>&) { return "number or table in time"; },
                 [](const Memory<Record>&) { return "text"; }},
      binding);
}

template <class Record>
std::string Rule<Record>::allowed() const {
  return std::visit(
      Overloaded{
          [](const Real<Record>& real) { return real.range.describe() + (real.infinity_allowed ? ", or inf" : ""); },
          [](const Whole<Record>& whole) { return whole.range.describe(); },
          [](const Flag<Record>&) { return std::string("true, false"); },
          [](const Text<Record>&) { return fmt::format("one line in double quotes, at most {} bytes", longest_text); },
          [](const Choice<Record>& choice) {
            std::vector<std::string> words;
            for (const auto& option : choice.options) words.push_back(quoted(option));
            return fmt::format("{}", fmt::join(words, ", "));
          },
          [](const Vector<Record>&) { return std::string("[x, y, z], three finite numbers"); },
          [](const Name<Record>&) { return std::string("letters, digits, _ and -"); },
          [](const NameOrNumber<Record>&) { return std::string("the number of a species, from 0 on, or its name"); },
          [](const Numbers<Record>& numbers) {
            return fmt::format("[a, b, ...], 2 to {} numbers, each {}", longest_list, numbers.range.describe());
          },
          [](const InTime<Record>& own) {
            return fmt::format("{}; in time [[t, value], ...], 1 to {} rows, t at least 0 and increasing",
                               own.range.describe(), longest_list);
          },
          [](const Memory<Record>&) { return std::string("a whole number and B, KiB or MiB"); }},
      binding);
}

template <class Record>
std::string Rule<Record>::plausible() const {
  const Range range = std::visit(
      [](const auto& bound) {
        if constexpr (requires { bound.plausible; })
          return bound.plausible;
        else
          return any;
      },
      binding);
  return std::isfinite(range.low) || std::isfinite(range.high) ? range.describe() : "";
}

template <class Record>
bool Rule<Record>::is_plausible(const Record& record) const {
  if (const auto* real = std::get_if<Real<Record>>(&binding)) {
    const double value = record.*real->member;
    return std::isinf(value) || real->plausible.contains(value);
  }
  if (const auto* own = std::get_if<InTime<Record>>(&binding))
    return std::ranges::all_of(record.*own->member,
                               [&](const TimeValue& row) { return own->plausible.contains(row.value); });
  const auto* vector = std::get_if<Vector<Record>>(&binding);
  return vector == nullptr ||
         std::ranges::all_of(record.*vector->member, [&](double x) { return vector->plausible.contains(x); });
}

template <class Record>
std::string Rule<Record>::default_value() const {
  if (required) return "";
  if (!default_note.empty()) return default_note;
  if (std::holds_alternative<Memory<Record>>(binding)) return "none";
  return value_in(Record{});
}

template <class Record>
std::string Rule<Record>::value_in(const Record& record) const {
  const auto word = [](const std::string& text) { return text.empty() ? std::string("none") : quoted(text); };
  const auto list = [](const auto& values) {
    std::vector<std::string> words;
    words.reserve(values.size());
    for (const double value : values) words.push_back(number(value));
    return fmt::format("[{}]", fmt::join(words, ", "));
  };
  const auto in_time = [](const TimeTable& rows) {
    if (rows.size() == 1) return number(rows[0].value);
    std::vector<std::string> words;
    for (const auto& [time, value] : rows) words.push_back(fmt::format("[{}, {}]", number(time), number(value)));
    return fmt::format("[{}]", fmt::join(words, ", "));
  };
  return std::visit(
      Overloaded{[&](const Real<Record>& real) { return number(record.*real.member); },
                 [&](const Whole<Record>& whole) { return fmt::format("{}", record.*whole.member); },
                 [&](const Flag<Record>& flag) { return std::string(record.*flag.member ? "true" : "false"); },
                 [&](const Text<Record>& text) { return word(record.*text.member); },
                 [&](const Choice<Record>& choice) { return word(record.*choice.member); },
                 [&](const Vector<Record>& vector) { return list(record.*vector.member); },
                 [&](const Name<Record>& own) { return word(record.*own.member); },
                 [&](const NameOrNumber<Record>& own) { return record.*own.member; },
                 [&](const Numbers<Record>& numbers) { return list(record.*numbers.member); },
                 [&](const InTime<Record>& own) { return in_time(record.*own.member); },
                 [&](const Memory<Record>& memory) { return fmt::format("{}", record.*memory.member); }},
      binding);
}

template struct Rule<CaseValues>;
template struct Rule<Species>;
template struct Rule<PlacedParticle>;
template struct Rule<Probe>;

}  // namespace fixdem::casegen
