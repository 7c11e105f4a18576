// Any text as a case file.
#include <exception>

#include "targets.hpp"
#include "tools/casegen/advice.hpp"
#include "tools/casegen/checks.hpp"
#include "tools/casegen/header_writer.hpp"

namespace fixdem::tests {
namespace {

/// However many errors there are, they are few of each kind (tools/casegen/report.hpp).
constexpr std::size_t longest_report = 128 << 10;

/// The header, with the advice behind it; empty when the case is refused.
std::string header_of(const std::string& text) {
  casegen::Report report("fuzz.toml");
  const casegen::Reading reading = casegen::load_case(text, "fuzz.toml", report);
  if (report.text().size() > longest_report) return "a report longer than anybody reads";
  if (report.errors() > 0) return report.first_error().empty() ? "an error without a message" : "";
  const std::string advice = casegen::advise_time_step(reading, "fuzz", report);
  casegen::advise_gas(reading, report);
  casegen::advise_feed(reading, report);
  return casegen::write_header(reading.values, {"fuzz.toml", "fuzz", 0}) + advice;
}

}  // namespace

std::string fuzz_case(std::string_view bytes) {
  const std::string text(bytes);
  try {
    const std::string header = header_of(text);
    if (header.empty()) return "";
    if (header.find("struct fuzz") == std::string::npos) return "a header without its case: " + header;
    if (header.find("nan") != std::string::npos && text.find("nan") == std::string::npos)
      return "a value that is no number";
    if (header != header_of(text)) return "another header the second time";
    return "";
  } catch (const std::exception& error) {
    return std::string("not refused in words, but by an exception: ") + error.what();
  }
}

}  // namespace fixdem::tests
