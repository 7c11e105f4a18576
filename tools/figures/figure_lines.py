"""Open lines: solids fraction along the pipe against time, with the fronts of plugs and the stations, and below it what the line does:
pressure at its inlet, gas velocity where it changes, masses in, out and in the pipe."""

from array import array
from itertools import accumulate
from math import floor, log10

from columns import FixdemError, read_columns, read_plugs, read_probes
from drawing import Data, picture_of
from fixdem import read_summary
from picture import STOPS
from slices import Slices, fronts_of, track

CASES = ("line_10mm", "line_blocked", "line_ramp_up", "line_ramp_down", "line_vertical", "line_incline")
FULL = 0.6  # solids fraction at the end of the scale
MOST_MOMENTS = 600  # columns of a picture
WIDTH, HEIGHT = 760, 640
LEFT, RIGHT = 0.10, 0.84  # of the picture's width, where all panels begin and end


def value_at(table, time):
    """Of a number, or of a table in time: linear in between, constant outside."""
    if not isinstance(table, list):
        return table
    for (t, v), (u, w) in zip(table, table[1:]):
        if time < u:
            return v + (w - v) * max(0.0, time - t) / (u - t)
    return table[-1][1]


def gas_velocity(case, time):
    """m/s; None where the case gives a pressure or a blower instead."""
    return value_at(case["gas"].get("bulk_velocity"), time)


def panel(top, bottom, more=""):
    return f"set lmargin at screen {LEFT}\nset rmargin at screen {RIGHT}\nset tmargin at screen {top}\nset bmargin at screen {bottom}\n{more}"


def key(top):
    """In one row above a panel."""
    return f"set key at screen {(LEFT + RIGHT) / 2},{top + 0.02} center center vertical maxrows 1 samplen 2 width -1\n"


def tics(values):
    """Two to five of them above zero."""
    most = max((value for value in values if value is not None), default=0) or 1
    size = 10 ** floor(log10(most / 2))
    return f"set ytics {next(size * step for step in (5, 2, 1) if 2 * size * step <= most):g}\n"


def map_script(run, case, slices, data, end):
    """The upper panel."""
    every = -(-len(slices.times) // MOST_MOMENTS)
    rows, times = slices.values["solids_fraction"][::every], slices.times[::every]
    file = data.binary(array("f", [value for column in zip(*rows) for value in column]))
    step = (times[-1] - times[0]) / max(1, len(times) - 1) or 1.0
    fronts = fronts_of(slices.values["solids_fraction"], slices.length)
    layers = [f"'{file}' binary array=({len(times)},{slices.count}) format='%float' origin=({times[0]:g},{slices.length / 2:g}) dx={step:g} dy={slices.length:g} with image notitle"]
    for plug in read_plugs(run):
        if plug.counts:
            path = data.file(track(plug, slices.times, fronts))
            layers += [f"'{path}' with lines linewidth {width} linecolor '{colour}' notitle" for width, colour in ((3, "#000000"), (1.2, "#ffffff"))]
    layers += [f"{probe.position} with lines linewidth 1 dashtype 2 linecolor '#ffffff' notitle" for probe in read_probes(run, case)]
    colours = ", ".join(f"{k} '#{r:02x}{g:02x}{b:02x}'" for k, (r, g, b) in enumerate(STOPS))
    length = case["pipe"]["length"]
    return panel(0.97, 0.53, f"set palette defined ({colours})\nset cbrange [0:{FULL}]\nset cblabel 'solids fraction'\nset xrange [0:{end:g}]\nset yrange [0:{length:g}]\n"
                 f"unset grid\nset format x ''\nset ylabel 'along the pipe, m' offset 1\nplot {', '.join(layers)}\n")  # fmt: skip


def curves_script(case, log, data):
    """The two lower panels."""
    times = log["time [s]"]
    gas = [(t, gas_velocity(case, t)) for t in times]
    pressure = [(t, p / 1000) for t, p in zip(times, log["pressure drop [Pa]"]) if p is not None]
    plots, axes = [f"'{data.file(pressure)}' with lines linewidth 1.5 linecolor 1 title 'pressure at the inlet'"], "unset y2label\nunset y2tics\n"
    if len({u for _, u in gas}) > 1:
        plots.append(f"'{data.file(gas)}' axes x1y2 with lines linewidth 1.5 linecolor 3 dashtype 2 title 'gas velocity'")
        axes = "set y2label 'm/s'\nset y2tics 1\nset y2range [0:*]\n"
    script = panel(0.46, 0.32, f"set grid\nset ylabel 'kPa' offset 1\nset yrange [0:*]\n{key(0.46)}{tics(p for _, p in pressure)}{axes}plot {', '.join(plots)}\n")
    steps = [0.0, *(b - a for a, b in zip(times, times[1:]))]
    so_far = {words: list(accumulate((flow or 0.0) * step for flow, step in zip(log[rate], steps)))
              for words, rate in (("fed", "accepted rate [kg/s]"), ("left", "leaving rate [kg/s]"))}  # fmt: skip
    so_far |= {"in the pipe": log["holdup [kg]"], "waiting": log["backlog [kg]"]}
    curves = ", ".join(f"'{data.file(zip(times, kg))}' with lines linewidth 1.5 linecolor {k} dashtype {k} title '{words}'" for k, (words, kg) in enumerate(so_far.items(), 1))
    return script + panel(0.26, 0.10, f"{key(0.26)}unset y2label\nunset y2tics\nset format x '%g'\nset xlabel 'time, s'\nset ylabel 'kg' offset 1\n{tics(max(so_far.values(), key=max))}plot {curves}\n")


def words(run, case, summary):
    """What the picture shows, from the summary, and of gas that changes the velocities between which plugs passed a station."""
    line, said = summary["line"], summary["line_verdict"]
    text = f"`{run.name}` {dict(blocked='blocks', empty='is empty').get(said, said)}. "
    text += f"It accepts {line['accepted_rate']:.3g} of {line['asked_rate']:.3g} kg/s and holds {line['holdup']:.3g} kg at {line['inlet_pressure'] / 1000:.3g} kPa above the outlet. "
    if line["blocked_time"]:
        text += f"For {line['blocked_time']:.1f} s more than a second of feed waits for room in the feed section. "
    if line["plugs"]:
        text += (f"{line['plugs']} plug{'s' if line['plugs'] > 1 else ''}: fronts {line['plug_velocity']:.2f} m/s, particles in them {line['plug_particle_velocity']:.2f} m/s, {line['plug_length']:.2f} m long"
                 + (f", {line['plug_frequency']:.2f} per second at the middle" if line["plug_frequency"] else "") + ". ")  # fmt: skip
    for probe in read_probes(run, case)[:1] if isinstance(case["gas"].get("bulk_velocity"), list) else []:
        passed = [time for time, before, now in zip(probe.time[1:], probe.passages, probe.passages[1:]) if now > before]
        if passed:
            text += (f"Plugs pass the station at {probe.position:g} m from {passed[0]:.1f} s on, in gas of {gas_velocity(case, passed[0]):.2f} m/s, to {passed[-1]:.1f} s, "
                     f"in gas of {gas_velocity(case, passed[-1]):.2f} m/s.")  # fmt: skip
    return text.rstrip()


def line(run, case, path):
    """`run`: folder of a run of the case. Draws path.svg and path.png; returns title and text."""
    summary, log = read_summary(run), read_columns(run / "log.csv")
    slices = Slices(run / "slices.bin").at_least("solids_fraction")
    if not slices.times:
        raise FixdemError(f"{slices.path} has no moments: run the case to its end first")
    with Data() as data:
        script = "set multiplot\n" + map_script(run, case, slices, data, log["time [s]"][-1]) + curves_script(case, log, data) + "unset multiplot\n"
        picture_of(script, path, WIDTH, HEIGHT)
    return case["title"], words(run, case, summary)
