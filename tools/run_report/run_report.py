#!/usr/bin/env python3
"""One page (HTML, self-contained) about one run, built from what it left in its folder: make report CASE=...

run_folder.py reads, page_content.py words, page_parts.py lays out, player_data.py packs the frames; run_content.py brings together what
differs between an open line (line_content.py, line_frames.py) and all other cases; source/ is bundled into page.js and page.css (tools/make/run_report.mk). The page opens from disk and asks no network for anything, which its own
content security policy enforces.
"""

import argparse
import json
import os
import re
import subprocess
import sys
import tomllib
from html import escape
from pathlib import Path
from string import Template

for part in ("report", "python"):
    sys.path.insert(0, str(Path(__file__).parent.parent / part))

import page_content
import page_parts
import player_data
import run_folder
from columns import as_command, read_columns
from fixdem import read_summary
from line_content import LineContent
from run_content import RunContent

LARGEST = 15_000_000  # bytes
OTHER_REPORTS = {"stability.md": "how far the scene is from instability", "frontier.md": "error against run time"}


def about_program(program):
    """What `--version` says, as a dictionary; nothing if there is no program."""
    if not program or not program.exists():
        return {}
    text = subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout
    return dict(re.findall(r"^([\w ]+):\s+(.*)$", text, re.M))


def directions(case):
    gravity = case.get("run", {}).get("gravity", [0, -9.81, 0])
    down = max(range(3), key=lambda k: abs(gravity[k]))
    words = (("towards the viewer", "away from the viewer"), ("downwards", "upwards"), ("to the left", "to the right"))[down][gravity[down] > 0]
    text = f"Seen from the side, gravity points {words}" if any(gravity) else "There is no gravity"
    if raised := case["pipe"].get("inclination"):
        text = f"The pipe rises to the right by {raised:g} degrees, which the picture does not show"
    if "gas" in case:
        velocity = case["gas"].get("bulk_velocity", 1)
        first = velocity[0][1] if isinstance(velocity, list) else velocity
        text += f"; the gas flows to the {'right' if first >= 0 else 'left'}"
    return text + "."


def links(run, page, case_name, reports):
    here = page.parent
    files = [("summary.json", "the figures of this page"), ("log.csv", "every row of the charts"), ("frames.pvd", "for ParaView"),
             ("contacts.pvd", "the contact forces, for ParaView"), ("plugs.csv", "every plug"), ("slices.bin", "slices along the pipe, for tools/python/slices.py")]
    files += [(path.name, "a station") for path in sorted(run.glob("probe_*.csv"))]
    found = [(run / name, text) for name, text in files] + [(reports / case_name / name, text) for name, text in OTHER_REPORTS.items()]
    items = [f'<li><a href="{escape(os.path.relpath(path, here))}">{path.name}</a>: {text}</li>' for path, text in found if path.exists()]
    return f"<ul>{''.join(items)}</ul>"


def build(arguments):
    run = arguments.run
    summary, log = read_summary(run), read_columns(run / "log.csv")
    case = tomllib.loads(arguments.case.read_text())
    version = about_program(arguments.program)
    log["kinetic"] = [a + b for a, b in zip(log["kinetic energy translation [J]"], log["kinetic energy rotation [J]"])]
    pipe = {"diameter": case["pipe"]["diameter"], "length": case["pipe"]["length"], "periodic": case["pipe"]["ends"] == "periodic"}
    content = (LineContent if case["pipe"]["ends"] == "open" else RunContent)(run, case, pipe, summary, log, arguments.budget)
    data = {"end": log["time [s]"][-1], "pipe": pipe, "directions": directions(case), "log": {"time": "time [s]", "columns": log}} | content.data
    player = "<h2>The particles</h2><p>The run wrote no frames: set frame_interval in [output] of the case.</p>"
    if data["frames"]:
        player = page_parts.player(data, data["frames"])
    stale = summary["case_hash"] not in version.get("case", summary["case_hash"])
    about = f"Case {summary['case']}, {summary['integrator']} at {summary['time_step']:g} s"
    about += "; the case file has been changed since this run" if stale else ""
    page = Template((Path(__file__).parent / "source" / "page.html").read_text()).substitute(
        case=escape(summary["case"]),
        title=escape(case.get("title", summary["case"])),
        about=about + ".",
        style=(arguments.bundle / "page.css").read_text(),
        verdicts=page_parts.verdict_table(content.verdicts),
        player=player,
        charts=page_parts.charts(data["charts"]),
        maps=page_parts.maps(data["maps"], content.overlay) + content.plugs,
        ledger="<h2>Energy</h2>" + page_content.ledger(summary, log),
        performance=page_content.performance(summary, version),
        capacity=page_content.capacity(summary),
        facts=page_content.facts(summary, case),
        links=links(run, arguments.page, summary["case"], arguments.reports),
        data=json.dumps(data, separators=(",", ":"), allow_nan=False).replace("<", "\\u003c"),
        frames=content.packed,
        script=(arguments.bundle / "page.js").read_text(),
    )
    size = len(page.encode())
    if size > LARGEST:
        raise SystemExit(f"fixdem: the page would be {size / 1e6:.1f} MB, more than {LARGEST / 1e6:.0f}: write the log less often")
    arguments.page.write_text(page)
    print(f"{arguments.page}: {size / 1e6:.2f} MB" + (f", {len(data['frames']['times'])} frames of {data['frames']['particles']} particles" if data["frames"] else ""))


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("run", type=Path, help="folder of a run")
    arguments.add_argument("page", type=Path, help="where to write")
    arguments.add_argument("--case", type=Path, required=True, help="the case file")
    arguments.add_argument("--program", type=Path, help="the program of the case, for what was compiled into it")
    arguments.add_argument("--bundle", type=Path, required=True, help="folder of page.js and page.css")
    arguments.add_argument("--reports", type=Path, default=Path("bench/reports"), help="folder of other reports, to be linked")
    arguments.add_argument("--budget", type=int, default=player_data.BUDGET, help="bytes for the frames, packed")
    build(arguments.parse_args())


if __name__ == "__main__":
    as_command(main)
