// casegen run as a user would run it: the program under test is FIXDEM_CASEGEN. Every bad case is written to a folder
// of its own in FIXDEM_SCRATCH; a failing test prints the file and what casegen said.
#pragma once

#include <doctest/doctest.h>
#include <stdio.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "casegen_bad_cases.hpp"

namespace casegen_test {

namespace fs = std::filesystem;

struct Outcome {
  int exit_code;
  std::string output;  // stdout and stderr
};

inline Outcome casegen(const std::string& arguments) {
  FILE* pipe = popen(("'" FIXDEM_CASEGEN "' " + arguments + " 2>&1").c_str(), "r");
  REQUIRE(pipe != nullptr);
  std::string output;
  for (int c = fgetc(pipe); c != EOF; c = fgetc(pipe)) output += static_cast<char>(c);
  const int status = pclose(pipe);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, output};
}

inline std::string read(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

inline void write(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << text;
}

/// Of this process: files of tests run side by side.
inline const fs::path& scratch() {
  struct Folder {
    fs::path path = fs::path(FIXDEM_SCRATCH) / ("casegen-" + std::to_string(getpid()));
    ~Folder() { fs::remove_all(path); }
  };
  static const Folder folder;
  return folder.path;
}

inline bool contains(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

/// "line:column" of a marked piece of text, both from 1.
inline std::string position_of(const std::string& text, const std::string& piece) {
  const auto at = text.find(piece);
  REQUIRE_MESSAGE(at != std::string::npos, piece);
  std::size_t line = 1, start = 0;
  for (std::size_t i = 0; i < at; ++i)
    if (text[i] == '\n') ++line, start = i + 1;
  return std::to_string(line) + ":" + std::to_string(at - start + 1);
}

inline std::string replaced(std::string text, const std::string& piece, const std::string& by) {
  const auto at = text.find(piece);
  REQUIRE_MESSAGE(at != std::string::npos, piece);
  return text.replace(at, piece.size(), by);
}

/// The good case with one more line in [material].
inline std::string with_material(const std::string& line) {
  return replaced(good_case, "friction = 0.3", "friction = 0.3\n" + line);
}

/// The header that casegen prints, and what it says beside; it must accept the case.
inline std::string printed(const std::string& text) {
  const fs::path file = scratch() / "printed.toml";
  write(file, text);
  const Outcome outcome = casegen("'" + file.string() + "' --print");
  CHECK_MESSAGE(outcome.exit_code == 0, outcome.output);
  return outcome.output;
}

/// The members of a header, without the lines that hold the hash of the file.
inline std::string members(const std::string& header) {
  std::string kept;
  for (std::size_t at = 0; at < header.size();) {
    const std::size_t end = header.find('\n', at) + 1;
    const std::string line = header.substr(at, end - at);
    if (!contains(line, "xxh64") && !contains(line, "source_hash")) kept += line;
    at = end;
  }
  return kept;
}

inline std::string without_gas(std::string text) {
  const auto gas = text.find("[gas]"), start = text.find("[start]");
  return text.erase(gas, start - gas);
}

/// A case without [pipe] wall, ends and gas.
inline std::string bare(const std::string& text) { return replaced(without_gas(text), "wall = true", "wall = false"); }

/// One bad case: its exit code, position and words, and that no header appears or changes.
inline void check_refused(const std::string& text, const std::string& at, const std::vector<const char*>& words) {
  const fs::path folder = scratch() / "bad", file = folder / "mine.toml", header = folder / "mine.hpp";
  write(folder / "filling.toml", replaced(good_case, "count = 2", "count = 7"));
  write(file, text);
  fs::remove(header);
  const std::string command = "'" + file.string() + "' --output '" + header.string() + "'";
  const Outcome outcome = casegen(command);
  CAPTURE(text);
  CAPTURE(outcome.output);
  CHECK(outcome.exit_code == 3);
  CHECK(contains(outcome.output, file.string() + ":" + position_of(text, at) + ": error: "));
  for (const std::string word : words) CHECK_MESSAGE(contains(outcome.output, word), word);
  CHECK_FALSE(fs::exists(header));
  write(header, "an earlier header");
  CHECK(casegen(command).exit_code == 3);
  CHECK(read(header) == "an earlier header");
}

/// Accepted, with a warning at the first place of `at`.
inline void check_warned(const std::string& text, const std::string& at, const std::vector<const char*>& words) {
  const fs::path file = scratch() / "warned.toml";
  write(file, text);
  const Outcome outcome = casegen("'" + file.string() + "' --print");
  CAPTURE(outcome.output);
  CHECK(outcome.exit_code == 0);
  CHECK(contains(outcome.output, file.string() + ":" + position_of(text, at) + ": warning: "));
  CHECK(contains(outcome.output, "struct warned {"));
  for (const std::string word : words) CHECK_MESSAGE(contains(outcome.output, word), word);
}

inline void check_quiet(const std::string& text) {
  const fs::path file = scratch() / "quiet.toml";
  write(file, text);
  const Outcome outcome = casegen("'" + file.string() + "'");
  CHECK_MESSAGE(outcome.exit_code == 0, outcome.output);
  CHECK_MESSAGE(!contains(outcome.output, "warning"), outcome.output);
}

}  // namespace casegen_test
