// Sorting and printing of what was found in a case file.
#include "report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <tuple>

namespace fixdem::casegen {
namespace {

constexpr int kept_of_a_kind = 5;

}  // namespace

void Report::add(Place place, bool is_error, std::string message, std::string advice) {
  errors_ += is_error;
  Kind& kind = kinds_[advice + (is_error ? "" : " ")];  // a warning is no error of the same kind
  if (++kind.count > kept_of_a_kind) {
    ++entries_[kind.last_kept].others;
    return;
  }
  kind.last_kept = entries_.size();
  entries_.push_back({place, is_error, std::move(message), std::move(advice)});
}

std::vector<Report::Entry> Report::sorted() const {
  auto entries = entries_;
  std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return std::tie(a.place.line, a.place.column) < std::tie(b.place.line, b.place.column);
  });
  return entries;
}

std::string Report::first_error() const {
  for (const auto& entry : sorted())
    if (entry.is_error) return fmt::format("{}:{}: {}", entry.place.line, entry.place.column, entry.message);
  return "";
}

std::string Report::text() const {
  std::string text;
  for (const auto& [place, is_error, message, advice, others] : sorted()) {
    const char* word = is_error ? "error" : "warning";
    fmt::format_to(std::back_inserter(text), "{}:{}:{}: {}: {}\n  {}\n", file_, place.line, place.column, word, message,
                   advice);
    if (others > 0) fmt::format_to(std::back_inserter(text), "{}: {}: {} more of the last kind\n", file_, word, others);
  }
  return text;
}

void Report::print(std::FILE* stream) const { fmt::print(stream, "{}", text()); }

}  // namespace fixdem::casegen
