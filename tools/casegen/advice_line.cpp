// Where constant gas is not good enough, and what a feed section can take.
//
// A plug flow loses about 1 kPa per metre with particles of 1000 kg/m3. Constant velocity is right to a few per cent as
// long as that is little against the pressure at the outlet: it scatters more than that over 5 m. Steady pressures,
// without storage of gas in the pipe, are right up to about 10 m: the error in velocity grows as the length to the
// power of 1.5. A feed section takes up to 0.28 rho v L D: density of the particles, velocity of the feed, length,
// diameter of the pipe.
#include <fmt/format.h>

#include <algorithm>

#include "advice.hpp"
#include "sizes.hpp"

namespace fixdem::casegen {
namespace {

constexpr double loss_per_length = 1000, loss_at_density = 1000;  // Pa/m, kg/m3
constexpr double small_share = 0.05;                              // of the pressure at the outlet
constexpr double longest_without_storage = 10;                    // m
constexpr double between_updates = 1e-4;                          // s
constexpr std::int64_t fewest_in_plugs = 100;

double maximum_of(const TimeTable& rows) { return std::ranges::max_element(rows, {}, &TimeValue::value)->value; }

/// Of the heaviest of the largest, which is that of all where they are equal.
double density_of(const CaseValues& v) { return figures_of(v).reference_density; }

}  // namespace

void advise_gas(const Reading& reading, Report& report) {
  const CaseValues& v = reading.values;
  if (!v.has_gas) return;
  if (v.ends == "periodic") {
    if (v.gas_compressible)
      report.warning(
          reading.place("gas.compressible"),
          fmt::format("{} with [pipe] ends = \"periodic\": particles leave at the pressure of the outlet and "
                      "enter at that of the inlet",
                      reading.quote("gas.compressible")),
          "use ends = \"open\" for a line; a periodic pipe is a piece of one, with constant gas");
    return;
  }
  if (v.most_present() < fewest_in_plugs) return;
  const double loss = loss_per_length * density_of(v) / loss_at_density * v.pipe_length;
  const double share = loss / v.gas_outlet_pressure;
  if (!v.gas_compressible && share > small_share)
    report.warning(reading.place("pipe.length"),
                   fmt::format("{} with gas of constant density: plugs lose about {:.2g} kPa over it, {:.0f} % of the "
                               "pressure at the outlet, and the gas expands as much",
                               reading.quote("pipe.length"), loss / 1000, 100 * share),
                   "set [gas] compressible = true; constant velocity is good enough up to about 5 %");
  if (v.gas_compressible && !v.gas_storage && v.pipe_length > longest_without_storage)
    report.warning(
        reading.place("pipe.length"),
        fmt::format("{} without storage: gas takes as long to fill it as a plug to pass", reading.quote("pipe.length")),
        fmt::format("set [gas] storage = true; steady pressures are good enough up to about {:.0f} m",
                    longest_without_storage));
  if (v.gas_storage && v.gas_update_interval == 1)
    report.warning(reading.place("gas.compressible"),
                   "[gas] update_interval = 1 with storage: the gas takes more than 10 % of the time of a plug's step",
                   fmt::format("set it to {}, that is every {:.2g} s: pressures change within milliseconds",
                               std::max(2, static_cast<int>(between_updates / v.time_step)), between_updates));
}

void advise_feed(const Reading& reading, Report& report) {
  const CaseValues& v = reading.values;
  if (!v.is_line()) return;
  const double rate = maximum_of(v.feed_rate);
  if (v.feed_start >= v.duration)
    report.warning(reading.place("feed.start"),
                   fmt::format("{} is not before the end of the run, duration = {}: nothing is fed",
                               reading.quote("feed.start"), v.duration),
                   "lower it, or set rate = 0 if nothing is to be fed");
  else if (rate == 0 && v.count == 0)
    report.warning(reading.place("feed.rate"),
                   fmt::format("{} with count = 0: the line stays empty", reading.quote("feed.rate")),
                   "raise rate, or begin with some particles");
  const double most = 0.28 * density_of(v) * v.feed_velocity * v.feed_length * v.pipe_diameter;
  if (v.feed_velocity > 0 && rate > most)
    report.warning(reading.place("feed.rate"),
                   fmt::format("{} asks for {:.3g} kg/s; a feed section of {:.3g} m takes about {:.2g} kg/s",
                               reading.quote("feed.rate"), rate, v.feed_length, most),
                   "what is not taken waits: raise [feed] length, or lower rate");
}

}  // namespace fixdem::casegen
