// Cases of particles of several sizes for the tests of casegen, and what a header says of them.
#pragma once

#include <cstdio>

#include "casegen_run.hpp"

namespace casegen_test {

/// The good case with these lines instead of count, diameter and density.
inline std::string with_particles(const std::string& lines) {
  const std::string equal = "count = 2\ndiameter = 0.010\ndensity = 1000.0\n";
  return std::string(good_case).replace(good_case.find(equal), equal.size(), lines);
}

inline std::string species(const std::string& lines) { return "[[particles.species]]\n" + lines; }

inline const std::string large = species("name = \"large\"\ncount = 3\ndiameter = 0.010\n");
inline const std::string small = species("name = \"small\"\ncount = 5\ndiameter = 0.005\ndensity = 2000\n");
/// Two species, of which one has the density of [particles].
inline const std::string mixed_case = with_particles("density = 1000.0\n" + large + small);

inline std::string distributed(const std::string& lines, int count = 5) {
  return with_particles("count = " + std::to_string(count) + "\ndensity = 1000.0\n[particles.sizes]\n" + lines);
}

/// The same case, but its particles placed by these lines of [[start.particle]].
inline std::string placed(const std::string& text, const std::vector<std::string>& particles) {
  std::string list;
  for (const auto& lines : particles) list += "[[start.particle]]\n" + lines + "\n";
  return replaced(text, random_start, "") + list;
}

/// What the header says of a case, but for the hash of its file.
inline std::string members_of(const std::string& text) {
  const std::string said = printed(text);
  return members(said.substr(said.find("struct ")));
}

struct Run {
  int count;
  double diameter, density;
  int species;
};

/// `sizes` of a header; empty where it has none.
inline std::vector<Run> sizes_of(const std::string& header) {
  std::vector<Run> runs;
  auto at = header.find("static constexpr SizeRun sizes[] = {");
  if (at == std::string::npos) return runs;
  const auto end = header.find("};", at);
  for (at = header.find("\n      {", at); at < end; at = header.find("\n      {", at + 1)) {
    Run run{};
    REQUIRE(std::sscanf(header.c_str() + at, "\n      {%d, %lf, %lf, %d}", &run.count, &run.diameter, &run.density,
                        &run.species) == 4);
    runs.push_back(run);
  }
  return runs;
}

}  // namespace casegen_test
