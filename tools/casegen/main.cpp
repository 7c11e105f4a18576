// casegen: a case file (TOML) to the header that the kernel is instantiated with.
//
// Reads and checks the case, reports everything wrong with it as file:line:column, and writes nothing unless all is
// right. Exit codes: 0 done, 2 wrong usage, 3 bad case, 6 input or output. Data goes to stdout, the rest to stderr.
#define XXH_INLINE_ALL
#include <fmt/format.h>
#include <xxhash.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <system_error>

#include "advice.hpp"
#include "checks.hpp"
#include "header_writer.hpp"
#include "output_file.hpp"
#include "schema.hpp"

#ifndef FIXDEM_VERSION
#define FIXDEM_VERSION "0.1.0"
#endif

namespace {

using namespace fixdem::casegen;

enum ExitCode { done = 0, wrong_usage = 2, bad_case = 3, input_output = 6 };

struct Options {
  std::string file, output, label;
  bool print = false, name = false, start_from = false, hash = false, advice = false, keys = false;
};

ExitCode run(const Options& options) {
  if (options.keys) {
    fmt::print("{}", key_table_markdown());
    return done;
  }
  const std::string stem = std::filesystem::path(options.file).stem().string();
  if (options.name) {
    fmt::print("{}\n", struct_name(stem));
    return done;
  }
  const std::string text = read_file(options.file);
  if (options.hash) {
    fmt::print("{:016x}\n", XXH64(text.data(), text.size(), 0));
    return done;
  }
  Report report(options.file);
  const Reading reading = load_case(text, options.file, report);
  check_predecessor(reading, options.file, report);
  if (report.errors() > 0) {
    report.print(stderr);
    fmt::print(stderr, "casegen: {} error{} in {}; nothing written\n", report.errors(), report.errors() == 1 ? "" : "s",
               options.file);
    return bad_case;
  }
  if (options.start_from) {
    const std::string& from = reading.values.start_from;
    if (!from.empty()) fmt::print("{}\n", predecessor_path(options.file, from));
    return done;
  }
  const std::string advice = advise_time_step(reading, stem, report);
  advise_precision(reading, report);
  advise_gas(reading, report);
  advise_feed(reading, report);
  fmt::print(options.advice ? stdout : stderr, "{}", advice);
  report.print(stderr);
  const Source source{options.label.empty() ? options.file : options.label, stem, XXH64(text.data(), text.size(), 0)};
  const std::string header = write_header(reading.values, source);
  if (options.print) fmt::print("{}", header);
  if (!options.output.empty()) write_if_changed(options.output, header);
  return done;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app{
      "Checks a case file (TOML) and writes the C++ header that the kernel is instantiated with.\n"
      "Without --output or --print it only checks. The case format: cases/README.md."};
  app.set_version_flag("--version", "casegen " FIXDEM_VERSION);
  app.footer("Exit codes: 0 done, 2 wrong usage, 3 bad case, 6 input or output.");
  auto* file = app.add_option("case", options.file, "the case file")->type_name("CASE.toml");
  app.add_option("-o,--output", options.output, "write the header here; untouched when nothing changes or on error");
  app.add_flag("--print", options.print, "write the header to stdout");
  app.add_flag("--advice", options.advice, "write the advice on the time step to stdout instead of stderr");
  app.add_option("--source-label", options.label, "path of the case to write into the header (default: as given)");
  auto* from = app.add_flag("--start-from", options.start_from, "print the path of the case it starts from, if any");
  auto* name = app.add_flag("--name", options.name, "print the name of the generated struct");
  auto* hash =
      app.add_flag("--hash", options.hash, "print the XXH64 of the case file, as the header and the program have it");
  auto* keys = app.add_flag("--keys", options.keys, "print every key of the case format as Markdown");
  from->excludes(name)->excludes(keys);
  name->excludes(keys);
  hash->excludes(from)->excludes(name)->excludes(keys);
  try {
    app.parse(argc, argv);
    if (!options.keys && file->empty()) throw CLI::RequiredError("CASE.toml");
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? done : wrong_usage;
  }
  try {
    return run(options);
  } catch (const std::system_error& error) {
    fmt::print(stderr, "casegen: {}\n", error.what());
    return input_output;
  } catch (const std::exception& error) {
    fmt::print(stderr, "casegen: {}: {}\n", options.file, error.what());
    return input_output;
  }
}
