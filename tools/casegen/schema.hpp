// The case format as one table: every key with its type, range, unit, default and meaning.
//
// The same rows drive reading, range checks, the advice of every refusal, the suggestions for misspelt keys and
// `casegen --keys`, which prints the table of cases/README.md. A new key is one row in one of keys_*.cpp and one member
// of `CaseValues`. What several keys must satisfy together is not a property of a row: see conditions.cpp and
// geometry.cpp.
#pragma once

#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "case_values.hpp"

namespace fixdem::casegen {

inline constexpr std::size_t longest_text = 500;  // bytes
inline constexpr std::size_t longest_list = 100;  // numbers, or rows of a table in time

/// An interval of numbers. Infinity is never inside, unless a key allows it explicitly.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool includes_low = true;
  bool includes_high = true;

  bool contains(double value) const;
  std::string describe() const;  ///< "above 0 and at most 1"
};
constexpr Range any{};
constexpr Range positive{0, std::numeric_limits<double>::infinity(), false, true};
constexpr Range not_negative{0, std::numeric_limits<double>::infinity(), true, true};
constexpr Range between(double low, double high) { return {low, high, true, true}; }

/// A value outside the plausible range is warned of: a unit may have been mistaken.
template <class Record>
struct Real {
  double Record::*member;
  Range range;
  Range plausible = any;
  bool infinity_allowed = false;
};
template <class Record>
struct Whole {
  std::int64_t Record::*member;
  Range range;
};
template <class Record>
struct Flag {
  bool Record::*member;
};
template <class Record>
struct Text {
  std::string Record::*member;
};
template <class Record>
struct Choice {
  std::string Record::*member;
  std::vector<std::string> options;
};
template <class Record>
struct Vector {
  Vector3 Record::*member;
  Range plausible = any;  ///< of each component
};
/// Letters, digits, _ and -.
template <class Record>
struct Name {
  std::string Record::*member;
};
/// A name, or a whole number from 0 on; kept as text.
template <class Record>
struct NameOrNumber {
  std::string Record::*member;
};
template <class Record>
struct Numbers {
  std::vector<double> Record::*member;
  Range range;  ///< of each
};
/// A number, or [[time, value], ...], s.
template <class Record>
struct InTime {
  TimeTable Record::*member;
  Range range;  ///< of each value
  Range plausible = any;
};
/// A text like "256 KiB", or a whole number of bytes.
template <class Record>
struct Memory {
  std::int64_t Record::*member;
};

// Deduction guides, for compilers that do not deduce the arguments of aggregates (clang before 17).
template <class Record>
Real(double Record::*, Range) -> Real<Record>;
template <class Record>
Real(double Record::*, Range, Range) -> Real<Record>;
template <class Record>
Real(double Record::*, Range, Range, bool) -> Real<Record>;
template <class Record>
Whole(std::int64_t Record::*, Range) -> Whole<Record>;
template <class Record>
Flag(bool Record::*) -> Flag<Record>;
template <class Record>
Text(std::string Record::*) -> Text<Record>;
template <class Record>
Choice(std::string Record::*, std::vector<std::string>) -> Choice<Record>;
template <class Record>
Vector(Vector3 Record::*) -> Vector<Record>;
template <class Record>
Vector(Vector3 Record::*, Range) -> Vector<Record>;
template <class Record>
Name(std::string Record::*) -> Name<Record>;
template <class Record>
NameOrNumber(std::string Record::*) -> NameOrNumber<Record>;
template <class Record>
Numbers(std::vector<double> Record::*, Range) -> Numbers<Record>;
template <class Record>
InTime(TimeTable Record::*, Range, Range) -> InTime<Record>;
template <class Record>
Memory(std::int64_t Record::*) -> Memory<Record>;

/// When a key has a meaning; given elsewhere it is refused, because it would silently do nothing.
enum class When {
  always,
  hertz,
  linear,
  random,
  from,
  no_species,
  one_size,
  species_default,  ///< always; with species it is needed only by those that have none of their own
  size_ends,        ///< with a distribution that is cut, so all but a table
  size_normal,
  size_lognormal,
  size_table,
  line,
  velocity_given,  ///< neither inlet pressure nor blower
  incompressible,
  compressible
};

/// A key without the place its value goes to.
struct Key {
  std::string table;
  std::string name;
  std::string unit;  ///< empty: a pure number or a word
  bool required = false;
  When when = When::always;
  /// For defaults that follow from other keys; otherwise the initialiser is printed. Of a required key: when.
  std::string default_note;
  std::string meaning;
  std::string advice;  ///< second line of a refusal
  /// In the header only where it says something: a header without it is that of the time before there was such a key.
  bool only_if_it_says_something = false;
};

template <class Record>
struct Rule : Key {
  using Binding = std::variant<Real<Record>, Whole<Record>, Flag<Record>, Text<Record>, Choice<Record>, Vector<Record>,
                               Name<Record>, NameOrNumber<Record>, Numbers<Record>, InTime<Record>, Memory<Record>>;
  Binding binding;

  std::string type() const;       ///< "real number", "whole number", ...
  std::string allowed() const;    ///< "above 0 and at most 1", "\"hertz\", \"linear\""
  std::string plausible() const;  ///< "1e-06 to 0.5"; empty when nothing is warned of
  bool is_plausible(const Record& record) const;
  std::string default_value() const;          ///< as written in TOML; empty when the key is required
  std::string value_in(const Record&) const;  ///< as written in TOML
};

struct TableRule {
  std::string name;  ///< with a point in it: a part of the table before the point
  bool required;
  std::string meaning;
  bool is_list = false;  ///< `[[name]]`, once for each entry

  bool is_part_of(std::string_view table) const;
  std::string last_name() const;  ///< behind the point
};

std::span<const TableRule> tables();                  ///< in the order of the documentation
std::vector<Rule<CaseValues>> physics_keys();         ///< title, particles, material, contact, pipe, gas
std::vector<Rule<CaseValues>> size_keys();            ///< particles.sizes
std::vector<Rule<CaseValues>> feed_keys();            ///< feed
std::vector<Rule<CaseValues>> run_keys();             ///< start, run, capacity, output
std::span<const Rule<CaseValues>> case_keys();        ///< all of these; table "" is the top of the file
std::span<const Rule<Species>> species_keys();        ///< of one `[[particles.species]]`
std::span<const Rule<PlacedParticle>> placed_keys();  ///< of one `[[start.particle]]`
std::span<const Rule<Probe>> probe_keys();            ///< of one `[[probe]]`

const Rule<CaseValues>* find_key(std::string_view table, std::string_view name);
const TableRule* find_table(std::string_view name);
bool is_needed(const TableRule& table, const CaseValues& values);  ///< required, and not for nothing
std::string table_title(std::string_view table);                   ///< "[pipe]", "[[start.particle]]"
bool applies(When when, const CaseValues& values);
std::string describe(When when);  ///< "normal = \"hertz\""; empty where `default_note` says it

/// Every key as Markdown, for cases/README.md.
std::string key_table_markdown();

}  // namespace fixdem::casegen
