#include "line_result.hpp"

#include <fmt/format.h>

#include <cmath>

namespace fixdem::program {
namespace {

constexpr double steep = 0.17;  // gravity across the axis over all of it, below which there is no layer

/// "0.867 +- 0.05"
std::string with_scatter(const Figure& figure) {
  std::string text = fmt::format("{:.3g}", figure.mean);
  if (std::isfinite(figure.deviation)) text += fmt::format(" +- {:.2g}", figure.deviation);
  return text;
}

}  // namespace

LineResult line_result(const CaseFacts& facts, const LineTotals& totals, const std::vector<LineSample>& samples,
                       const std::vector<PlugTrack>& plugs, double duration) {
  const double asked_from = facts.line.statistics_from;
  // A millionth of slack: sample times are whole numbers of steps.
  const double from = (asked_from >= 0 ? asked_from : 0.5 * duration) * (1 - 1e-6);
  LineResult result;
  result.totals = totals;

  std::vector<double> holdup, pressure;
  const LineSample *first = nullptr, *last = nullptr, *before_last = nullptr;
  for (const LineSample& sample : samples) {
    if (sample.time >= from) {
      if (first == nullptr) first = &sample;
      holdup.push_back(sample.holdup), pressure.push_back(sample.inlet_pressure);
    }
    before_last = last, last = &sample;
  }
  result.holdup = figure_of(holdup), result.inlet_pressure = figure_of(pressure);
  const auto rate = [&](auto LineSample::*so_far) {
    if (first == nullptr || !(last->time > first->time)) return std::numeric_limits<double>::quiet_NaN();
    return (last->*so_far - first->*so_far) / (last->time - first->time);
  };
  result.asked_rate = rate(&LineSample::asked), result.accepted_rate = rate(&LineSample::accepted);
  result.left_rate = rate(&LineSample::left_mass), result.plug_frequency = rate(&LineSample::passages);
  result.is_blocked = before_last != nullptr && last->blocked_time > before_last->blocked_time;

  std::vector<double> fronts, particles, lengths, layers;
  for (const PlugTrack& plug : plugs) {
    if (!plug.counts() || plug.first_time < from) continue;
    ++result.plugs;
    fronts.push_back(plug.front_velocity()), particles.push_back(plug.particle_velocity.value());
    lengths.push_back(plug.length.value()), layers.push_back(plug.layer_ratio.value());
  }
  result.plug_velocity = figure_of(fronts), result.plug_particle_velocity = figure_of(particles);
  result.plug_length = figure_of(lengths), result.layer_ratio = figure_of(layers);
  const double across = std::hypot(facts.gravity[0], facts.gravity[1]), all = std::hypot(across, facts.gravity[2]);
  result.layer_ratio_eq41 =
      layer_ratio_eq41(result.plug_particle_velocity.mean, across < steep * all ? 0 : all, facts.pipe_diameter);
  return result;
}

const char* verdict(const LineResult& result) {
  if (result.is_blocked) return "blocked";
  if (result.plugs > 0) return "flows in plugs";
  if (result.totals.left > 0) return "flows without plugs";
  return result.totals.present > 0 ? "fills" : "empty";
}

std::string describe_line(const LineResult& result) {
  const LineTotals& t = result.totals;
  std::string text =
      fmt::format("line: {}; {} particles were there at the start, {} were fed, {} have left, {} are present\n",
                  verdict(result), t.at_start, t.fed, t.left, t.present);
  if (std::isfinite(result.asked_rate))
    text += fmt::format(
        "      takes {:.3g} of {:.3g} kg/s, {:.3g} kg/s leave, {:.3g} kg wait; holds {} kg at {} kPa above the "
        "outlet\n",
        result.accepted_rate, result.asked_rate, result.left_rate, t.backlog, with_scatter(result.holdup),
        with_scatter({result.inlet_pressure.mean / 1000, result.inlet_pressure.deviation / 1000}));
  if (result.plugs > 0)
    text += fmt::format(
        "      {} plugs: front {} m/s, particles {} m/s, length {} m, layer ratio {} (eq. 41: {:.3g}), {:.3g} per "
        "second\n",
        result.plugs, with_scatter(result.plug_velocity), with_scatter(result.plug_particle_velocity),
        with_scatter(result.plug_length), with_scatter(result.layer_ratio), result.layer_ratio_eq41,
        result.plug_frequency);
  return text;
}

}  // namespace fixdem::program
