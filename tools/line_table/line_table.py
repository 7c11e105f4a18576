#!/usr/bin/env python3
"""Runs the base case of the open lines from several seeds and rewrites its table in cases/README.md: make line-table.

The runs are cases derived by with_seed.py, each with a program of its own. Figures are those of summary.json (`line`,
`line_scatter`), and of the stations' files: plugs that pass per second from `statistics_from` on.
"""

import argparse
import sys
import tomllib
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

for part in ("report", "python"):
    sys.path.insert(0, str(Path(__file__).parent.parent / part))
from columns import as_command, read_plugs, read_probes
from kept_run import KeptRun
from marked_part import MarkedPart
from report import table

LAYER_OFF = 0.05  # most that the layer may be off eq. (41)


@dataclass
class Figure:
    """A mean, and the standard deviation of what it is the mean of; None for what is not known."""

    mean: float | None
    scatter: float | None = None


@dataclass
class Row:
    """Of the table: name and unit, figure of a run, band of the prototype (none: no figure of its own), digits."""

    name: str
    of: object
    band: tuple | None
    digits: int = 2
    scale: float = 1.0


def of_summary(name):
    return lambda run: Figure(run.summary["line"].get(name), run.summary["line_scatter"].get(name))


def front_over_particles(run):
    """W - 0.967 V_p, which the laws of Konrad and of Lavrinec say is half of sqrt(g D); its scatter is that of single plugs."""
    line = run.summary["line"]
    if line["plug_velocity"] is None:
        return Figure(None)
    single = [p.front_velocity - 0.967 * p.particle_velocity for p in run.plugs if p.counts and p.born >= run.statistics_from]
    mean = sum(single) / len(single) if single else 0.0
    scatter = (sum((v - mean) ** 2 for v in single) / (len(single) - 1)) ** 0.5 if len(single) > 1 else None
    return Figure(line["plug_velocity"] - 0.967 * line["plug_particle_velocity"], scatter)


def passing(position):
    """Plugs per second that pass the station there."""

    def of(run):
        for probe in run.probes:
            if abs(probe.position - position) < 1e-9:
                later = [(t, n) for t, n in zip(probe.time, probe.passages) if t >= run.statistics_from * (1 - 1e-6)]
                if len(later) > 1:
                    return Figure((later[-1][1] - later[0][1]) / (later[-1][0] - later[0][0]))
                return Figure(None)
        raise SystemExit(f"fixdem: {run.folder}: the case has no [[probe]] at {position} m, which the table needs: add one")

    return of


ROWS = (
    Row("plug velocity W, m/s", of_summary("plug_velocity"), (0.75, 0.95)),
    Row("particles in plugs V_p, m/s", of_summary("plug_particle_velocity"), (0.45, 0.60)),
    Row("W - 0.967 V_p, m/s", front_over_particles, (0.30, 0.40), 3),
    Row("plug length, m", of_summary("plug_length"), (0.18, 0.30)),
    Row("layer ratio", of_summary("layer_ratio"), (0.37, 0.46), 3),
    Row("layer ratio by eq. (41)", of_summary("layer_ratio_eq41"), None, 3),
    Row("plugs per second at 1.0 m", passing(1.0), (0.7, 1.4)),
    Row("plugs per second at 1.6 m", passing(1.6), (0.5, 1.4)),
    Row("pressure at the inlet, kPa", of_summary("inlet_pressure"), (1.7, 2.5), 2, 1e-3),
    Row("holdup, kg", of_summary("holdup"), (1.1, 1.4)),
    Row("plugs followed", of_summary("plugs"), None, 0),
)


class LineRun:
    """What is read of one run."""

    def __init__(self, folder, case, summary):
        self.folder, self.summary = folder, summary
        self.plugs, self.probes = read_plugs(folder), read_probes(folder, case)
        self.statistics_from = case.get("output", {}).get("statistics_from", case["run"]["duration"] / 2)


def is_inside(row, mean):
    return mean is not None and row.band[0] <= row.scale * mean <= row.band[1]


def cell(row, figure):
    if figure.mean is None:
        return "-"
    return f"{row.scale * figure.mean:.{row.digits}f}" + ("" if figure.scatter is None else f" ± {row.scale * figure.scatter:.{row.digits}f}")


def table_rows(runs):
    """runs: name of a column -> LineRun."""
    rows = []
    for row in ROWS:
        found = {name: row.of(run) for name, run in runs.items()}
        band, word = "-", "-"
        if row.band:
            band = f"{row.band[0]:g} to {row.band[1]:g}"
            outside = [name for name, figure in found.items() if not is_inside(row, figure.mean)]
            word = f"**outside**: {', '.join(outside)}" if outside else "yes"
        rows.append([row.name, band, *(cell(row, figure) for figure in found.values()), word])
    off = {}
    for name, run in runs.items():
        layer, law = (run.summary["line"].get(key) for key in ("layer_ratio", "layer_ratio_eq41"))
        off[name] = None if layer is None or law is None else layer - law
    outside = [name for name, value in off.items() if value is None or abs(value) > LAYER_OFF]
    at = next(k for k, row in enumerate(ROWS) if row.name.endswith("(41)")) + 1
    cells = ["-" if value is None else f"{value:+.3f}" for value in off.values()]
    rows.insert(at, ["layer ratio less that", f"within {LAYER_OFF:g} of 0", *cells, f"**outside**: {', '.join(outside)}" if outside else "yes"])
    return rows


def text_of(case, runs):
    return (
        f"Regenerated by `make line-table`: `line_10mm` with other seeds of its start and of its feed. Means from {case['output']['statistics_from']:g} s on, ± the standard "
        "deviation within the run, of single plugs or of samples. The bands are those of an independent prototype of the same model, which was run from three seeds, "
        "with storage in the gas, and with stiffer particles.\n\n"
    ) + table(["quantity", "band", *runs, "inside"], table_rows(runs))


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("readme", type=Path, help="file with the marks of the table")
    arguments.add_argument("names", nargs="+", help="of the derived cases, ending with their seeds")
    arguments.add_argument("--cases", type=Path, required=True, help="folder of the derived cases")
    arguments.add_argument("--programs", type=Path, required=True, help="folder of their programs")
    arguments.add_argument("--out", type=Path, required=True, help="folder for the runs")
    arguments.add_argument("--jobs", type=int, default=2, help="programs running at a time")
    chosen = arguments.parse_args()

    part = MarkedPart(chosen.readme, "line table")
    cases = {name: tomllib.loads((chosen.cases / f"{name}.toml").read_text()) for name in chosen.names}
    with ThreadPoolExecutor(chosen.jobs) as pool:
        kept = [KeptRun(chosen.out / name, chosen.programs / name, ("--no-frames",)) for name in chosen.names]
        summaries = dict(zip(chosen.names, pool.map(KeptRun.made, kept)))
    runs = {name.rpartition("_")[2].replace("seed", "seed "): LineRun(chosen.out / name, cases[name], summaries[name]) for name in chosen.names}
    text = text_of(cases[chosen.names[0]], runs)
    print(text)
    part.write(text)


if __name__ == "__main__":
    as_command(main)
