"""What has become of a sweep: points.csv with a line for every point, sweep.json with its speed, sweep.md to read.

Figures are those of summary.json (tools/README.md), SI units. A point that has failed or is missing has its message in place of
figures.
"""

import csv
import io
import json
import sys
from dataclasses import dataclass
from pathlib import Path

root = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(root / "report"))
import report  # noqa: E402
from job import run_of  # noqa: E402
from kept_run import write_whole  # noqa: E402
from plug_verdict import verdict  # noqa: E402

PLUG = (
    "front_velocity",
    "particle_velocity",
    "length",
    "layer_area_ratio",
    "layer_area_ratio_eq41",
    "pressure_gradient",
    "pressure_drop",
    "samples",
    "samples_with_plug",
)
FINAL = (
    "time",
    "kinetic_energy",
    "contacts",
    "coordination_number",
    "max_overlap",
    "max_speed",
    "mean_axial_velocity",
    "mean_height",
)
SHOWN = ("front_velocity", "particle_velocity", "length", "layer_area_ratio", "pressure_gradient")  # in sweep.md
MOST_ROWS = 200  # of the table in sweep.md
RESULTS = ("verdict", *PLUG, *FINAL, "wall_time", "particle_steps_per_second", "steps", "state_hash")


@dataclass
class Point:
    name: str
    values: tuple  # in order of the axes
    case: dict
    record: dict
    summary: dict | None  # only of a run that is done

    @property
    def state(self):
        return self.record.get("state", "missing")

    def figures(self):
        """Name -> value, of a point that is done."""
        s = self.summary
        plug = s["plug"]
        found = {
            "verdict": verdict(plug) if plug else None,
            **{name: plug and plug[name] for name in PLUG},
            **{name: s["final"][name] for name in FINAL},
        }
        speed = s["performance"]
        return {
            **found,
            "wall_time": speed["wall_time"],
            "particle_steps_per_second": speed["particle_steps_per_second"],
            "steps": s["steps"],
            "state_hash": s["final"]["state_hash"],
        }


def points_of(plan, out, jobs):
    by_name = {job["name"]: job for job in jobs}
    points = []
    for values, name in plan.points:
        run = run_of(out, by_name[name])
        record = run.read()
        done = record.get("state") == "done" and run.is_over(record)
        points.append(Point(name, values, plan.jobs[name].checked, record, run.summary() if done else None))
    return points


def rows(axes, points):
    """Head and lines of points.csv."""
    yield ["point", *map(".".join, axes), "status", "exit_code", *RESULTS, "message"]
    for number, point in enumerate(points, 1):
        figures = point.figures() if point.summary else dict.fromkeys(RESULTS)
        message = "" if point.summary else point.record.get("message", "not run")
        values = [json.dumps(v) if isinstance(v, (list, bool)) else v for v in point.values]
        yield [number, *values, point.state, point.record.get("exit_code"), *figures.values(), " / ".join(message.splitlines())]


def write_points(path, axes, points):
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows(rows(axes, points))
    write_whole(path, text.getvalue())


def write_speed(path, entry):
    """Appends what one call of make sweep has done: sweep.json is the list of all that have run something."""
    entries = json.loads(path.read_text()) if path.exists() else []
    write_whole(path, json.dumps([*entries, entry], indent=1) + "\n")


def page(sweep, points, pictures, entries):
    axes = [".".join(key) for key in sweep.axes]
    done = [p for p in points if p.summary]
    lines = [
        f"# {sweep.title}",
        "",
        f"Made by `make sweep SWEEP={sweep.path}` from `{sweep.base.stem}`: {len(done)} of {len(points)} points done. "
        "All figures: [points.csv](points.csv), columns as `summary.json` defines them.",
        "",
    ]
    for caption, picture in pictures:
        lines += [f"![{caption}]({picture}.svg)", "", f"*{caption}*", ""]
    with_gas = any(p.summary["plug"] for p in done)
    columns = ["verdict", *SHOWN] if with_gas else ["kinetic_energy", "contacts", "max_overlap", "mean_height"]

    def cells(point):
        if not point.summary:
            return [point.state, *["-"] * (len(columns) - 1)]
        figures = point.figures()
        return [figures[c] if c == "verdict" else report.number(figures[c], 3) for c in columns]

    shown = [[*map(str, p.values), *cells(p)] for p in points[:MOST_ROWS]]
    lines += [report.table([*axes, *columns], shown), ""]
    if len(points) > MOST_ROWS:
        lines += [f"The first {MOST_ROWS} of {len(points)} points.", ""]
    for point in points:
        if not point.summary:
            lines += [f"- `{point.name}`: {point.state}: {point.record.get('message', 'not run')}".replace("\n", "; ")]
    if entries:
        rates = [
            [e["runs"], e["engine"], e["jobs"], f"{e['seconds']:.1f}", f"{1e-6 * e['particle_steps_per_second']:.3g}"]
            for e in entries
        ]
        lines += [
            "",
            "Speed, all runs together, from the first start to the last end:",
            "",
            report.table(["runs", "engine", "at a time", "s", "million particle-steps/s"], rates),
        ]
    return "\n".join(lines).rstrip() + "\n"
