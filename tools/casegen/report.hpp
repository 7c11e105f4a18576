// Errors and warnings of one case file, collected so that a single pass names everything there is to correct.
//
// Printed in the order of the file as `file:line:column: error: message`, with advice on a second, indented line. Of
// many with the same advice the first few are kept and the others counted, so that a report is short however long the
// file.
#pragma once

#include <cstdint>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

namespace fixdem::casegen {

/// A place in the file; both count from 1.
struct Place {
  std::uint32_t line = 1;
  std::uint32_t column = 1;
};

class Report {
 public:
  explicit Report(std::string file) : file_(std::move(file)) {}

  void error(Place place, std::string message, std::string advice) {
    add(place, true, std::move(message), std::move(advice));
  }
  void warning(Place place, std::string message, std::string advice) {
    add(place, false, std::move(message), std::move(advice));
  }

  int errors() const { return errors_; }
  std::string first_error() const;  ///< without its advice; empty when there is none
  std::string text() const;
  void print(std::FILE* stream) const;

 private:
  struct Entry {
    Place place;
    bool is_error;
    std::string message, advice;
    int others = 0;  ///< with the same advice, which are not kept
  };
  void add(Place place, bool is_error, std::string message, std::string advice);
  std::vector<Entry> sorted() const;

  std::string file_;
  std::vector<Entry> entries_;
  struct Kind {
    int count = 0;
    std::size_t last_kept = 0;
  };
  std::map<std::string, Kind> kinds_;  // by advice
  int errors_ = 0;
};

}  // namespace fixdem::casegen
