"""What the page of a run says of an open line: its verdicts, masses, space-time pictures with the tracks of plugs, stations, plugs.

Pictures are made from slices.bin or, where a run has written none, from its frames: less often, and with straight tracks.
"""

import json
from html import escape

import numpy as np
import page_content
import player_data
from columns import read_plugs, read_probes
from line_frames import LineFrames
from page_content import entry
from page_parts import number, table
from run_content import RunContent, map_data
from run_folder import MOST_SLICES, by_slices, solids_fraction
from slices import Slices, fronts_of, track

MOST_MOMENTS = 800  # rows of a picture
MOST_ROWS = 1000  # of a station's series; of more, means over some
MOST_PROBES = 6  # lines of a chart that can be told apart
MOST_POINTS = 60  # of a track
MOST_PLUGS = 200  # rows of the table
WINDOW = 16  # diameters of the pipe that the player shows at first
VERDICTS = (
    "blocked: particles that are due to be fed wait for room at the end, more than a second brings; flows in plugs: there are some that count; "
    "flows without plugs: particles have left; fills: none has"
)


def scattered(summary, name, scale=1.0, unit=""):
    """A mean of the summary's line with its scatter, or a dash."""
    mean, deviation = summary["line"].get(name), summary.get("line_scatter", {}).get(name)
    if mean is None:
        return "-"
    return f"{scale * mean:.3g}" + (f" ± {scale * deviation:.2g}" if deviation is not None else "") + unit


def verdicts(summary, case):
    line = summary["line"]
    adds_up = line["at_start"] + line["fed"] == line["present"] + line["left"]
    counts = f"{number(line['at_start'])} at the start + {number(line['fed'])} fed = {number(line['present'])} present + {number(line['left'])} left"
    rows = [
        entry("the line", f"accepts {number(line['accepted_rate'])} of {number(line['asked_rate'])} kg/s, {number(line['backlog'])} kg wait, blocked for {number(line['blocked_time'])} s",
              summary.get("line_verdict", "-"), VERDICTS),
        entry("particles", counts, "add up" if adds_up else "do not add up", "in whole numbers, at every row of the log", "good" if adds_up else "bad"),
        entry("holdup", scattered(summary, "holdup", 1, " kg") + ", " + scattered(summary, "inlet_pressure", 1e-3, " kPa") + " at the inlet", "for you to judge",
              "means and scatter from statistics_from on; pressure above the outlet"),
    ]  # fmt: skip
    if line["plugs"]:
        rows.append(
            entry("plugs", f"{line['plugs']}: front {scattered(summary, 'plug_velocity')} m/s, particles {scattered(summary, 'plug_particle_velocity')} m/s, "
                  f"{scattered(summary, 'plug_length')} m long, {number(line['plug_frequency'])} per second at the middle", "for you to judge", "those that were followed for 0.25 m at least")
        )  # fmt: skip
    if line["plugs"] and not case["pipe"].get("inclination"):
        ahead, drift = line["plug_velocity"] - 0.967 * line["plug_particle_velocity"], (9.81 * case["pipe"]["diameter"]) ** 0.5 / 2
        rows += [
            entry("front against particles", f"W − 0.967 V_p = {ahead:.3f} m/s", f"{ahead - drift:+.3f} from the law", f"Konrad; Lavrinec: half of √(gD), {drift:.3f} m/s"),
            entry("layer", f"{scattered(summary, 'layer_ratio')} of a packing", f"eq. (41): {number(line['layer_ratio_eq41'])}", "solids fraction around plugs over 0.52"),
        ]  # fmt: skip
    return rows


def masses(log):
    """Columns of the log for its charts: what has been fed and has left so far, from the rates since the row before."""
    time = log["time [s]"]
    steps = [0.0, *(b - a for a, b in zip(time, time[1:]))]
    for name, rate in (("mass fed [kg]", "accepted rate [kg/s]"), ("mass that has left [kg]", "leaving rate [kg/s]")):
        log[name] = list(np.cumsum([(flow or 0.0) * step for flow, step in zip(log[rate], steps)]))


def profiles(run, pipe, frames):
    """Times, solids fraction and pressure (Pa above the outlet; None without gas): moments x slices, and the slices they are from
    (None where they are from frames); no times where there is neither."""
    if (run / "slices.bin").exists():
        slices = Slices(run / "slices.bin").at_least("solids_fraction", "pressure")
        if slices.times:
            every = -(-len(slices.times) // MOST_MOMENTS)
            count = min(MOST_SLICES, slices.count)
            solids, pressure = (by_slices(np.array(slices.values[name][::every]), count) for name in ("solids_fraction", "pressure"))
            return slices.times[::every], solids, pressure, slices
    if frames is None:
        return [], None, None, None
    gradient = frames.gradients[0]
    count = min(MOST_SLICES, round(pipe["length"] / (2 * max(frames.radii, default=pipe["diameter"] / 20))) if gradient is None else len(gradient))
    solids = frames.share * solids_fraction(pipe, [a["position"][:, 2] for a in frames.arrays], [a["radius"] for a in frames.arrays], count)
    if gradient is None:
        return frames.times, solids, None, None
    drops = np.array(frames.gradients) * pipe["length"] / len(gradient)
    return frames.times, solids, by_slices(np.cumsum(drops[:, ::-1], axis=1)[:, ::-1] - drops / 2, count), None


def tracks(plugs, slices):
    """plug, whether it counts, and its front as points [s, m]."""
    fronts = fronts_of(slices.values["solids_fraction"], slices.length) if slices else []
    found = []
    for plug in plugs:
        points = track(plug, slices.times if slices else [], fronts)
        kept = [*points[: -1 : max(1, len(points) // MOST_POINTS)], points[-1]]
        found.append({"plug": plug.number, "counts": plug.counts, "points": [[round(t, 4), round(z, 4)] for t, z in kept]})
    return found


def overlay(found, probes, length, end):
    """Over a picture, time downwards: tracks, their numbers, and where the stations are."""
    lines = [f'<path class="probe" d="M{p.position:g} 0V{end:g}"/>' for p in probes]
    words = []
    for one in found:
        path = "M" + "L".join(f"{z:g} {t:g}" for t, z in one["points"])
        lines += [f'<path class="{kind}" d="{path}"/>' for kind in (("halo", "track") if one["counts"] else ("minor",))]
        if one["counts"]:
            t, z = one["points"][len(one["points"]) // 2]
            words.append(f'<span class="plug" style="left:{100 * z / length:.1f}%;top:{100 * t / end:.1f}%">{one["plug"]}</span>')
    return f'<svg viewBox="0 0 {length:g} {end:g}" preserveAspectRatio="none" aria-hidden="true">{"".join(lines)}</svg>' + "".join(words)


def mean(values):
    known = [v for v in values if v is not None]
    return round(float(np.mean(known)), 7) if known else None


def blocks(values, size, of=mean):
    return [of(values[at : at + size]) for at in range(0, len(values), size)]


def probe_series(probes):
    """Columns for charts, on the times of all stations together, and those charts."""
    shown = probes[:MOST_PROBES]
    series = []
    for probe in shown:
        size = -(-len(probe.time) // MOST_ROWS) or 1
        series.append({name: blocks(getattr(probe, name), size) for name in ("time", "pressure", "solids", "flow")})
        series[-1]["passages"] = blocks(probe.passages, size, lambda values: values[-1])
    times = sorted({time for one in series for time in one["time"]})
    at = {time: k for k, time in enumerate(times)}
    columns, charts = {"time": times}, []
    note = "" if len(probes) <= MOST_PROBES else f"The first {MOST_PROBES} of {len(probes)} stations."
    for key, title, unit in (("pressure", "Pressure at the stations", "Pa"), ("solids", "Solids fraction at the stations", ""), ("flow", "Mass flow at the stations", "kg/s"),
                             ("passages", "Plugs that have passed the stations", "")):  # fmt: skip
        lines = []
        for k, (probe, one) in enumerate(zip(shown, series)):
            column = [None] * len(times)
            for time, value in zip(one["time"], one[key]):
                column[at[time]] = value
            columns[f"{key} {k}"] = column
            lines.append({"column": f"{key} {k}", "label": f"{probe.position:g} m"})
        charts.append({"id": f"chart-probe-{key}", "title": title, "unit": unit, "log": False, "points": False, "lines": lines, "note": note, "source": "probes"})
    return {"time": "time", "columns": columns}, charts if times else []


def plug_table(plugs):
    rows = []
    for p in [p for p in plugs if p.counts][:MOST_PLUGS]:
        born = f"{p.born:.2f} s, {p.born_at:.2f} m" + ("" if p.parent is None else f", split off from {p.parent}")
        ended = f"{escape(p.fate)}" + ("" if p.into is None else f" into {p.into}") + f": {p.last:.2f} s, {p.last_at:.2f} m"
        rows.append((str(p.number), born, ended, *(number(v) for v in (p.front_velocity, p.particle_velocity, p.length, p.pressure_drop, p.layer_ratio))))
    head = ("plug", "born", "last seen", "front, m/s", "particles, m/s", "length, m", "pressure drop, Pa", "layer ratio")
    others = len(plugs) - len(rows)
    words = f"<p class='faint'>{len(rows)} that were followed for 0.25 m at least; {others} more are in plugs.csv.</p>"
    return "<h2>Plugs</h2>" + words + (table("plugs", head, rows) if rows else "")


def maps(pipe, times, solids, pressure):
    if not len(times):
        return []
    times = [round(float(time), 9) for time in times]
    found = [map_data("map-solids", "solids fraction", "Solids fraction", "", times, solids, pipe["length"])]
    if pressure is not None:
        found.append(map_data("map-pressure", "pressure", "Pressure of the gas above the outlet", "Pa", times, pressure, pipe["length"]))
    return found


class LineContent(RunContent):
    def __init__(self, run, case, pipe, summary, log, budget):
        masses(log)
        self.verdicts = page_content.verdicts(summary, log, case) + verdicts(summary, case)
        frames = LineFrames(run) if (run / "frames.pvd").exists() else None
        plugs, probes = read_plugs(run), read_probes(run, case)
        times, solids, pressure, slices = profiles(run, pipe, frames)
        found = tracks(plugs, slices)
        self.overlay, self.plugs = overlay(found, probes, pipe["length"], log["time [s]"][-1]), plug_table(plugs)
        series, charts = probe_series(probes)
        self.data = {"radius": None, "charts": page_content.charts(log) + charts, "maps": maps(pipe, times, solids, pressure), "probes": series, "frames": None}
        self.data["line"] = {"window": min(WINDOW * pipe["diameter"], pipe["length"]), "tracks": [one for one in found if one["counts"]]}
        if frames:
            names = [species["name"] for species in summary["species"]] if "species" in summary else None
            others = len(json.dumps(self.data, separators=(",", ":")))
            # What is packed grows by a third in the page.
            self.data["frames"], self.packed = player_data.pack_line(frames, max(budget // 2, budget - others * 3 // 4), names)
            self.data["radius"] = float(frames.radii.max(initial=0))
