// Sorting and printing of what was found in a case file.
#include "report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace fixdem::casegen {

void Report::add(Place place, bool is_error, std::string message, std::string advice) {
  entries_.push_back({place, is_error, std::move(message), std::move(advice)});
  errors_ += is_error;
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

void Report::print(std::FILE* stream) const {
  for (const auto& [place, is_error, message, advice] : sorted())
    fmt::print(stream, "{}:{}:{}: {}: {}\n  {}\n", file_, place.line, place.column, is_error ? "error" : "warning",
               message, advice);
}

}  // namespace fixdem::casegen
