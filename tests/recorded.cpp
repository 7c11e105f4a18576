// The file of recorded.hpp.
#include "recorded.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace fixdem::tests {
namespace {

std::string digits(double number) {
  char text[40];
  std::snprintf(text, sizeof text, "%.10g", number);
  return text;
}

std::string cell(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

void record(const Table& table, const std::string& row, const Quantity& quantity, double expected, double found,
            const std::string& allowed) {
  const char* path = std::getenv("FIXDEM_RECORD");
  if (path == nullptr || *table.name == '\0') return;
  std::FILE* file = std::fopen(path, "ab");
  if (file == nullptr) {
    FAIL_CHECK("cannot write ", path);
    return;
  }
  std::string line;
  std::fseek(file, 0, SEEK_END);
  if (std::ftell(file) == 0) line = "table,row,quantity,unit,expected,found,allowed,source\n";
  line += cell(table.name) + ',' + cell(row) + ',' + cell(quantity.name) + ',' + cell(quantity.unit) + ',' +
          digits(expected) + ',' + digits(found) + ',' + allowed + ',' + cell(table.source) + '\n';
  const bool written = std::fwrite(line.data(), 1, line.size(), file) == line.size();
  CHECK_MESSAGE((std::fclose(file) == 0 && written), "cannot write ", path);
}

void check(const std::string& what, const Quantity& quantity, double expected, double found, double allowed) {
  const std::string said = what + ", " + quantity.name + ": " + digits(found) + " " + quantity.unit + " instead of " +
                           digits(expected) + ", allowed are " + digits(allowed);
  CHECK_MESSAGE(std::abs(found - expected) <= allowed, said);
}

}  // namespace

void check_figure(const Table& table, const std::string& row, const Quantity& quantity, double expected, double found,
                  double allowed) {
  check(row, quantity, expected, found, allowed);
  record(table, row, quantity, expected, found, digits(allowed));
}

void check_share(const Table& table, const std::string& row, const Quantity& quantity, double expected, double found,
                 double allowed) {
  check_figure(table, row, quantity, expected, found, allowed * std::abs(expected));
}

void report_figure(const Table& table, const std::string& row, const Quantity& quantity, double expected,
                   double found) {
  record(table, row, quantity, expected, found, "");
}

void WorstFigures::check(const std::string& which, const Quantity& quantity, double expected, double found,
                         double allowed) {
  tests::check(row_ + ", " + which, quantity, expected, found, allowed);
  const Worst now{quantity, which, expected, found, allowed, std::abs(found - expected) / allowed, 1};
  for (Worst& worst : worst_) {
    if (std::string_view(worst.quantity.name) != quantity.name) continue;
    const int count = worst.count + 1;
    if (!std::isnan(worst.nearness) && !(now.nearness <= worst.nearness))
      worst = now;  // what is no number is the worst
    worst.count = count;
    return;
  }
  worst_.push_back(now);
}

WorstFigures::~WorstFigures() {
  for (const Worst& worst : worst_) {
    record(table_, row_ + ", worst of " + std::to_string(worst.count) + ": " + worst.which, worst.quantity,
           worst.expected, worst.found, digits(worst.allowed));
  }
}

std::string in_words(double number) {
  char text[40];
  std::snprintf(text, sizeof text, "%g", number);
  return text;
}

}  // namespace fixdem::tests
