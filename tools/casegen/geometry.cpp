// Whether the particles fit: pipe, slices, solids fraction; and whether tiles fit the pipe.
//
// The limits are 0.60 of the pipe's volume for any start (random close packing is 0.64, less near walls) and 0.45 for a
// random arrangement; a denser start is the final state of a case that fills the pipe. Lengths in metres.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "checks.hpp"
#include "kernel/capacity.hpp"

namespace fixdem::casegen {
namespace {

constexpr double densest = 0.60, densest_random = 0.45;
constexpr double longest_pipe = 1e6;  // in particle diameters, one slice each

void check_pipe(const Reading& reading, Report& report) {
  const CaseValues& v = reading.values;
  if (!reading.usable({"particles.diameter", "pipe.diameter", "pipe.length", "pipe.ends"})) return;
  if (v.diameter >= v.pipe_diameter)
    report.error(reading.place("particles.diameter"),
                 fmt::format("{} is wider than the pipe; allowed: below [pipe] diameter = {}",
                             reading.quote("particles.diameter"), v.pipe_diameter),
                 "lower [particles] diameter or raise [pipe] diameter");
  const double shortest = (v.ends == "periodic" ? 4 : 2) * v.diameter;
  if (v.pipe_length < shortest) {
    report.error(reading.place("pipe.length"),
                 fmt::format("{} is too short; allowed with ends = \"{}\": at least {} particle diameters = {:.6g}",
                             reading.quote("pipe.length"), v.ends, v.ends == "periodic" ? 4 : 2, shortest),
                 "raise [pipe] length or lower [particles] diameter");
    return;
  }
  if (v.pipe_length > longest_pipe * v.diameter)
    report.error(reading.place("pipe.length"),
                 fmt::format("{} is too long; allowed: at most {:.0e} particle diameters = {:.6g}",
                             reading.quote("pipe.length"), longest_pipe, longest_pipe * v.diameter),
                 "every diameter of the pipe is a slice with arrays of its own: lower [pipe] length");
  if (!v.has_gas || !reading.usable({"gas.slice_length"})) return;
  if (v.gas_slice_length < v.diameter || v.gas_slice_length > v.pipe_length / 4)
    report.error(reading.place("gas.slice_length"),
                 fmt::format("{}: slices of {:.6g} m; allowed: from one particle diameter = {:.6g} to a quarter of the "
                             "pipe = {:.6g}",
                             reading.quote("gas.slice_length"), v.gas_slice_length, v.diameter, v.pipe_length / 4),
                 "leave slice_length out for one diameter; the gas needs at least four slices");
}

void check_solids_fraction(const Reading& reading, Report& report) {
  const CaseValues& v = reading.values;
  if (!reading.usable({"particles.count", "particles.diameter", "pipe.diameter", "pipe.length"})) return;
  if (v.diameter >= v.pipe_diameter) return;  // reported already
  const double particle = std::numbers::pi / 6 * std::pow(v.diameter, 3);
  const double pipe = std::numbers::pi / 4 * v.pipe_diameter * v.pipe_diameter * v.pipe_length;
  const double fraction = static_cast<double>(v.count) * particle / pipe;
  const auto fitting = [&](double limit) {  // rounding must not turn a whole number away
    const double most = limit * pipe / particle * (1 + 1e-12);
    return most < 9e18 ? static_cast<std::int64_t>(most) : std::numeric_limits<std::int64_t>::max();
  };
  if (v.count > fitting(densest))
    report.error(reading.place("particles.count"),
                 fmt::format("{}: they would fill {:.3f} of the pipe; allowed: at most {:.2f}, that is {} particles",
                             reading.quote("particles.count"), fraction, densest, fitting(densest)),
                 "lower count or raise [pipe] length or diameter");
  else if (v.arrangement == "random" && v.count > fitting(densest_random))
    report.error(
        reading.place("start.arrangement"),
        fmt::format("{} of count = {} fills {:.3f} of the pipe; allowed: at most {:.2f}, that is {} particles",
                    reading.quote("start.arrangement"), v.count, fraction, densest_random, fitting(densest_random)),
        "let them settle in a longer pipe first (as fill_1000.toml does) and start with from = \"that case\"");
}

/// The kernel works on slices of the pipe a little longer than a particle, and their size is limited.
void check_slice(const Reading& reading, Report& report) {
  const CaseValues& v = reading.values;
  if (!reading.usable({"particles.count", "particles.diameter", "pipe.diameter"})) return;
  if (particles_per_chunk(static_cast<int>(v.count), v.pipe_diameter, v.diameter) <= largest_chunk) return;
  double widest = v.pipe_diameter;
  while (particles_per_chunk(static_cast<int>(v.count), widest, v.diameter) > largest_chunk) widest *= 0.99;
  report.error(
      reading.place("pipe.diameter"),
      fmt::format("{} is {:.0f} particles wide, and a slice of it may hold more than {} of them; allowed with "
                  "more than {} particles: at most {:.3g} m",
                  reading.quote("pipe.diameter"), v.pipe_diameter / v.diameter, largest_chunk, largest_chunk, widest),
      fmt::format("lower [pipe] diameter, or [particles] count to {} or less", largest_chunk));
}

/// A tile needs a pipe of many chunks (kernel/tiles.hpp).
void check_tiles(const Reading& reading, Report& report) {
  const CaseValues& v = reading.values;
  if (!reading.has("capacity.tile_steps") || v.tile_steps <= 1) return;
  if (!reading.usable({"capacity.tile_steps", "particles.count", "particles.diameter", "pipe.diameter"})) return;
  if (v.diameter >= v.pipe_diameter) return;  // reported already
  const auto count = static_cast<int>(v.count);
  const int size = particles_per_chunk(count, v.pipe_diameter, v.diameter), chunks = (count + size - 1) / size;
  auto maximum = v.tile_steps;
  while (chunks < chunks_for_tile(static_cast<int>(maximum))) --maximum;
  if (maximum < v.tile_steps)
    report.error(reading.place("capacity.tile_steps"),
                 fmt::format("{} needs {} chunks of {} particles, and {} particles fill {}; allowed: {}",
                             reading.quote("capacity.tile_steps"), chunks_for_tile(static_cast<int>(v.tile_steps)),
                             size, v.count, chunks, maximum == 1 ? "1" : fmt::format("1 to {}", maximum)),
                 "leave tile_steps out, and the kernel chooses: tiles are for pipes that the cache does not hold");
}

}  // namespace

void check_geometry(const Reading& reading, Report& report) {
  check_pipe(reading, report);
  check_solids_fraction(reading, report);
  check_slice(reading, report);
  check_tiles(reading, report);
}

}  // namespace fixdem::casegen
