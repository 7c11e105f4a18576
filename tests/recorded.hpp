// Figures that are checked and, when asked for, recorded: what a test checks is what cases/VALIDATION.md shows.
//
// `check_figure` is a check like any other: |found - expected| <= allowed. When FIXDEM_RECORD names a file it also
// appends a line of comma-separated values, `table,row,quantity,unit,expected,found,allowed,source`, with ten
// significant digits; tools/validate/contacts.py makes tables of them. A scene that is written once for the kernel and
// for the reference, or runs with several integrators, is recorded for one of them: the others get the table
// `unrecorded`. The file is appended to, so a record is made by one process, into a file that is not there yet.
#pragma once

#include <string>
#include <vector>

namespace fixdem::tests {

/// A table of the page, and where what its figures should be comes from, in words.
struct Table {
  const char *name, *source;
};
inline constexpr Table unrecorded{"", ""};

/// What is measured and its unit; empty for a ratio.
struct Quantity {
  const char *name, *unit;
};

/// Checks a figure to `allowed`, absolute.
void check_figure(const Table& table, const std::string& row, const Quantity& quantity, double expected, double found,
                  double allowed);

/// The same to the share `allowed` of what is expected.
void check_share(const Table& table, const std::string& row, const Quantity& quantity, double expected, double found,
                 double allowed);

/// Records a figure that the model need not return, such as one of an experiment; `allowed` stays empty.
void report_figure(const Table& table, const std::string& row, const Quantity& quantity, double expected, double found);

/// Many figures of a few quantities, each of which is checked; in the end the one of each quantity that is nearest to
/// its limit is recorded.
class WorstFigures {
 public:
  WorstFigures(const Table& table, const std::string& row) : table_(table), row_(row) {}
  WorstFigures(const WorstFigures&) = delete;
  WorstFigures& operator=(const WorstFigures&) = delete;
  ~WorstFigures();

  /// `which`: the figure's own name, such as its angle. `allowed`: absolute, more than none.
  void check(const std::string& which, const Quantity& quantity, double expected, double found, double allowed);

 private:
  struct Worst {
    Quantity quantity;
    std::string which;
    double expected, found, allowed, nearness;
    int count;
  };
  Table table_;
  std::string row_;
  std::vector<Worst> worst_;
};

/// A number as rows are named by it: 15, 0.175.
std::string in_words(double number);

}  // namespace fixdem::tests
