// Whether the particles fit: pipe, slices, solids fraction; and whether tiles fit the pipe.
//
// The limits are 0.60 of the pipe's volume for any start (random close packing is 0.64, less near walls), 0.85 with
// several sizes (random mixtures of a large and a small one pack to 0.79), and 0.45 for a random arrangement; a denser
// start is the final state of a case that fills the pipe. Lengths in metres.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "checks.hpp"
#include "kernel/capacity.hpp"
#include "sizes.hpp"

namespace fixdem::casegen {
namespace {

constexpr double densest_of_equal = 0.60, densest_of_several = 0.85, densest_random = 0.45;
constexpr double longest_pipe = 1e6;  // in particle diameters, one slice each

void check_pipe(const Reading& reading, Report& report) {
  const CaseValues& v = reading.values;
  if (!reading.usable({"particles.diameter", "pipe.diameter", "pipe.length", "pipe.ends"})) return;
  const double largest = figures_of(v).largest;
  const char* kind = v.has_sizes() ? "of the largest " : "";
  const std::string lower = v.has_sizes() ? "the largest diameter" : "[particles] diameter";
  if (largest >= v.pipe_diameter)
    report.error(reading.place(reading.largest_key),
                 fmt::format("{} is wider than the pipe; allowed: below [pipe] diameter = {}",
                             reading.quote(reading.largest_key), v.pipe_diameter),
                 fmt::format("lower {} or raise [pipe] diameter", lower));
  const int shortest_in_diameters = v.ends == "closed" ? 2 : 4;
  const double shortest = shortest_in_diameters * largest;
  if (v.pipe_length < shortest) {
    report.error(reading.place("pipe.length"),
                 fmt::format("{} is too short; allowed with ends = \"{}\": at least {} {}particle diameters = {:.6g}",
                             reading.quote("pipe.length"), v.ends, shortest_in_diameters, kind, shortest),
                 fmt::format("raise [pipe] length or lower {}", lower));
    return;
  }
  if (v.pipe_length > longest_pipe * largest)
    report.error(reading.place("pipe.length"),
                 fmt::format("{} is too long; allowed: at most {:.0e} {}particle diameters = {:.6g}",
                             reading.quote("pipe.length"), longest_pipe, kind, longest_pipe * largest),
                 "every diameter of the pipe is a slice with arrays of its own: lower [pipe] length");
  if (!v.has_gas || !reading.usable({"gas.slice_length"})) return;
  if (v.gas_slice_length < largest || v.gas_slice_length > v.pipe_length / 4)
    report.error(
        reading.place("gas.slice_length"),
        fmt::format("{}: slices of {:.6g} m; allowed: from one {}particle diameter{} = {:.6g} to a quarter of the "
                    "pipe = {:.6g}",
                    reading.quote("gas.slice_length"), v.gas_slice_length, kind, v.has_sizes() ? "s" : "", largest,
                    v.pipe_length / 4),
        "leave slice_length out for one diameter; the gas needs at least four slices");
}

void check_solids_fraction(const Reading& reading, Report& report) {
  const CaseValues& v = reading.values;
  if (!reading.usable({"particles.count", "particles.diameter", "pipe.diameter", "pipe.length"})) return;
  const SizeFigures sizes = figures_of(v);
  const double volume = volume_at_start(v);
  if (sizes.largest >= v.pipe_diameter || volume == 0) return;  // reported already; there are none
  const double pipe = std::numbers::pi / 4 * v.pipe_diameter * v.pipe_diameter * v.pipe_length;
  const double fraction = volume / pipe;
  const auto exceeds = [&](double limit) { return fraction > limit * (1 + 1e-12); };  // no whole number by rounding
  const auto allowed = [&](double limit) {
    std::string words = fmt::format("at most {:.2f}", limit);
    if (v.has_sizes()) return words;
    const double most = limit * pipe / volume * static_cast<double>(v.count) * (1 + 1e-12);
    const auto fitting = most < 9e18 ? static_cast<std::int64_t>(most) : std::numeric_limits<std::int64_t>::max();
    return words + fmt::format(", that is {} particles", fitting);
  };
  const double densest = sizes.largest > sizes.smallest ? densest_of_several : densest_of_equal;
  if (exceeds(densest))
    report.error(reading.place(reading.count_key),
                 fmt::format("{}: {} would fill {:.3f} of the pipe; allowed: {}", reading.quote(reading.count_key),
                             v.has_sizes() ? "all particles" : "they", fraction, allowed(densest)),
                 "lower count or raise [pipe] length or diameter");
  else if (v.arrangement == "random" && exceeds(densest_random))
    report.error(reading.place("start.arrangement"),
                 fmt::format("{} of count = {} fills {:.3f} of the pipe; allowed: {}",
                             reading.quote("start.arrangement"), v.count, fraction, allowed(densest_random)),
                 "let them settle in a longer pipe first (as fill_1000.toml does) and start with from = \"that case\"");
}

/// The diameter that the kernel divides the pipe by (kernel/capacity.hpp).
double diameter_for_chunks(const CaseValues& v) {
  const SizeFigures sizes = figures_of(v);
  return v.has_sizes() ? fixdem::diameter_for_chunks(sizes.mean_volume, sizes.largest) : v.diameter;
}

/// The kernel works on slices of the pipe a little longer than a particle, and their size is limited.
void check_slice(const Reading& reading, Report& report) {
  const CaseValues& v = reading.values;
  if (!reading.usable({"particles.count", "particles.capacity", "particles.diameter", "pipe.diameter"})) return;
  const double diameter = diameter_for_chunks(v);
  const auto most = static_cast<int>(v.most_present());
  if (particles_per_chunk(most, v.pipe_diameter, diameter) <= largest_chunk) return;
  double widest = v.pipe_diameter;
  while (particles_per_chunk(most, widest, diameter) > largest_chunk) widest *= 0.99;
  report.error(
      reading.place("pipe.diameter"),
      fmt::format("{} is {:.0f} particles wide, and a slice of it may hold more than {} of them; allowed with "
                  "more than {} particles: at most {:.3g} m",
                  reading.quote("pipe.diameter"), v.pipe_diameter / diameter, largest_chunk, largest_chunk, widest),
      fmt::format("lower [pipe] diameter, or [particles] {} to {} or less", v.is_line() ? "capacity" : "count",
                  largest_chunk));
}

/// A tile needs a pipe of many chunks (kernel/tiles.hpp).
void check_tiles(const Reading& reading, Report& report) {
  const CaseValues& v = reading.values;
  if (!reading.has("capacity.tile_steps") || v.tile_steps <= 1) return;
  if (!reading.usable(
          {"capacity.tile_steps", "particles.count", "particles.capacity", "particles.diameter", "pipe.diameter"}))
    return;
  if (figures_of(v).largest >= v.pipe_diameter) return;  // reported already
  const auto count = static_cast<int>(v.most_present());
  const int size = particles_per_chunk(count, v.pipe_diameter, diameter_for_chunks(v)),
            chunks = (count + size - 1) / size;
  auto maximum = v.tile_steps;
  while (chunks < chunks_for_tile(static_cast<int>(maximum))) --maximum;
  if (maximum < v.tile_steps)
    report.error(reading.place("capacity.tile_steps"),
                 fmt::format("{} needs {} chunks of {} particles, and {} particles fill {}; allowed: {}",
                             reading.quote("capacity.tile_steps"), chunks_for_tile(static_cast<int>(v.tile_steps)),
                             size, count, chunks, maximum == 1 ? "1" : fmt::format("1 to {}", maximum)),
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
