// Runs the program of a case as a subprocess, the way a user does, and collects what it leaves behind.
//
// Each run has a folder of its own under FIXDEM_SCRATCH; the programs are in FIXDEM_BIN_DIR (both given by make).
#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>

namespace fixdem::tests {

inline std::filesystem::path scratch(const std::string& name) {
  const auto folder = std::filesystem::path(FIXDEM_SCRATCH) / "program";
  std::filesystem::create_directories(folder);
  return folder / name;
}

inline std::string program(const std::string& case_name) { return std::string(FIXDEM_BIN_DIR) + "/" + case_name; }

inline std::string read_bytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

inline void write_bytes(const std::filesystem::path& path, const std::string& bytes) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << bytes;
}

inline std::string shell_word(const std::filesystem::path& path) { return "'" + path.string() + "'"; }

struct ProgramRun {
  int exit_code;  ///< -1 if a signal ended it
  std::string standard_output, standard_error;
  std::filesystem::path out;

  std::string file(const char* name) const { return read_bytes(out / name); }
  nlohmann::json summary() const { return nlohmann::json::parse(file("summary.json")); }
};

/// Runs a shell command, keeping its output in files named after `name`.
inline ProgramRun run_command(const std::string& command, const std::string& name, const std::filesystem::path& out) {
  ProgramRun run{-1, {}, {}, out};
  const auto output = scratch(name + ".stdout"), error = scratch(name + ".stderr");
  const int status = std::system((command + " > " + shell_word(output) + " 2> " + shell_word(error)).c_str());
  if (WIFEXITED(status)) run.exit_code = WEXITSTATUS(status);
  run.standard_output = read_bytes(output);
  run.standard_error = read_bytes(error);
  return run;
}

/// Runs `case_name --out <scratch>/<name> arguments`; an earlier run of that name is forgotten first.
inline ProgramRun run_program(const std::string& case_name, const std::string& name, const std::string& arguments) {
  const auto out = scratch(name);
  std::filesystem::remove_all(out);
  return run_command(shell_word(program(case_name)) + " --out " + shell_word(out) + " " + arguments, name, out);
}

inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace fixdem::tests
