// `casegen --keys`: the table of keys as Markdown, for cases/README.md.
#include <fmt/format.h>

#include <iterator>

#include "schema.hpp"

namespace fixdem::casegen {
namespace {

/// A vertical bar would end the cell.
std::string cell(const std::string& text) {
  std::string result;
  for (const char c : text) result += c == '|' ? std::string("\\|") : std::string(1, c);
  return result;
}

template <class Record>
std::string row(const Rule<Record>& rule) {
  std::string need = rule.required ? "required" : rule.default_value();
  if (rule.required && !rule.default_note.empty()) need += " " + rule.default_note;
  const std::string only = describe(rule.when);
  if (!only.empty()) need += fmt::format("; only with {}", only);
  return fmt::format("| `{}` | {} | {} | {} | {} | {} | {} |\n", rule.name, rule.type(), rule.unit,
                     cell(rule.allowed()), rule.plausible(), cell(need), cell(rule.meaning));
}

template <class Record>
std::string rows(std::span<const Rule<Record>> rules, std::string_view table) {
  std::string text;
  for (const auto& rule : rules)
    if (rule.table == table) text += row(rule);
  return text;
}

constexpr const char* heading =
    "| key | type | unit | allowed | plausible | default | meaning |\n|---|---|---|---|---|---|---|\n";

}  // namespace

std::string key_table_markdown() {
  std::string text = "At the top of the file:\n\n";
  text += heading + rows(case_keys(), "");
  for (const auto& [name, required, meaning, is_list] : tables()) {
    fmt::format_to(std::back_inserter(text), "\n`{}`{}: {}\n\n{}", table_title(name), required ? "" : " (optional)",
                   meaning, heading);
    text += rows(case_keys(), name) + rows(species_keys(), name) + rows(placed_keys(), name) + rows(probe_keys(), name);
  }
  return text;
}

}  // namespace fixdem::casegen
