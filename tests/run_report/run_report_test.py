#!/usr/bin/env python3
"""Tests of the page of a run (make test-report): what is packed comes out again, what does not fit is left out as it says;
then the page itself in a browser (page_test.mjs), against values read from the files of the run here.

Usage: run_report_test.py RUN PAGE CASE NODE_FOLDER CHROMIUM [PICTURES_FOLDER]; ends with "N passed, M failed".
"""

import base64
import csv
import json
import math
import subprocess
import sys
import tomllib
import zlib
from pathlib import Path

import numpy as np

root = Path(__file__).parent.parent.parent
for part in ("report", "run_report"):
    sys.path.insert(0, str(root / "tools" / part))
import page_content
import player_data
from frames import frame_list, read_frame

passed = failed = 0


def check(what, right, found=""):
    global passed, failed
    passed, failed = passed + bool(right), failed + (not right)
    print(f"{'passed' if right else 'FAILED'}  {what}" + (f": {found}" if found != "" else ""))


def unpacked(about, text):
    """The stream of player_data.py undone, plainly: positions and values as floats."""
    stream = np.frombuffer(zlib.decompress(base64.b64decode(text)), np.uint8)
    shape = (len(about["times"]), about["particles"])
    count, at, arrays = shape[0] * shape[1], 0, {}
    for name in ("x", "y", "z", "axial", "speed", "contacts"):
        wide = name in "xyz"
        low = stream[at : at + count].astype(np.uint16 if wide else np.uint8)
        numbers = low + (stream[at + count : at + 2 * count].astype(np.uint16) << 8) if wide else low
        at += count * (2 if wide else 1)
        numbers = np.cumsum(numbers.reshape(shape), axis=0, dtype=numbers.dtype)
        arrays[name] = about["scale"][name]["low"] + about["scale"][name]["step"] * numbers
    return arrays


def packing():
    random = np.random.default_rng(1)
    position = random.uniform(-1, 1, (100, 50, 3)).cumsum(axis=0)
    velocity, contacts = random.normal(size=(100, 50, 3)), random.integers(0, 12, (100, 50))
    times = np.arange(100) * 0.01
    about, text = player_data.pack(times, position, velocity, contacts)
    found = unpacked(about, text)
    for axis, name in enumerate("xyz"):
        step = np.ptp(position[:, :, axis]) / 65535
        check(f"{name} comes back to half a step", np.abs(found[name] - position[:, :, axis]).max() < 0.5001 * step)
    check("axial velocity comes back to half a step", np.abs(found["axial"] - velocity[:, :, 2]).max() < 0.5001 * np.ptp(velocity[:, :, 2]) / 255)
    check("contacts come back", (found["contacts"] == contacts).all())
    about, text = player_data.pack(times, position, velocity, contacts, budget=20_000)
    found = unpacked(about, text)
    check("less room: fewer frames, then fewer particles", about["every"] > 1 and about["share"] > 1 and len(text) < 1.34 * 20_000, f"{about['every']}, {about['share']}")
    left = position[:: about["every"], :: about["share"], 2]
    check("... and those that are left are right", found["z"].shape == left.shape and np.abs(found["z"] - left).max() < np.ptp(left) / 65535)


def rolling():
    """The ledger and its chart have what is lost by rolling where a run has it."""
    energy = {"kinetic": 1.0, "elastic": 0.5, "dissipated_damping": 2.0, "dissipated_sliding": 1.0, "made_by_law": 0.0, "gravity_work": 3.0,
              "gas_work": None, "balance_error": 0.0}  # fmt: skip
    log = {"kinetic": [2.0, 1.0], "elastic energy [J]": [0.0, 0.5]}
    without, with_it = (page_content.ledger({"energy": some}, log) for some in (energy, energy | {"rolling": 0.5}))
    check("the ledger says nothing of rolling where none is resisted", "rolling" not in without and "-0.5" in without)
    check("... and counts it where it is", "lost by rolling" in with_it and "-0.5" not in with_it)
    (chart,) = page_content.charts(log | {"dissipated by rolling [J]": [0.0, 0.5]})
    check("... in the chart, too", "lost by rolling" in [line["label"] for line in chart["lines"]])


def expectations(run, case):
    frames = [(time, read_frame(path)) for time, path in frame_list(run / "frames.pvd")]
    position = np.array([frame["position"] for _, frame in frames])
    with (run / "log.csv").open(newline="") as file:
        last = list(csv.DictReader(file))[-1]
    particles = case["particles"]
    pipe = math.pi / 4 * case["pipe"]["diameter"] ** 2 * case["pipe"]["length"]
    picks = [(0, 0), (len(frames) // 2, particles["count"] // 3), (len(frames) - 1, particles["count"] - 1)]
    return {
        "title": case["title"],
        "status": json.loads((run / "summary.json").read_text())["status"],
        "frames": len(frames),
        "end": float(last["time [s]"]),
        "second_time": frames[1][0],
        "step": list(np.ptp(position, axis=(0, 1)) / 65535),
        "mean_fraction": particles["count"] * math.pi / 6 * particles["diameter"] ** 3 / pipe,
        "pressure_drop": float(last["pressure drop [Pa]"]) if "gas" in case else None,
        "pipe_length": case["pipe"]["length"],
        "charts": 8 if "gas" in case else 5,
        "samples": [{"frame": f, "particle": p, "position": frames[f][1]["position"][p], "contacts": frames[f][1]["contacts"][p]} for f, p in picks],
    }  # fmt: skip


def main(run, page, case_file, node_folder, chromium, *pictures):
    packing()
    rolling()
    check("the page is below 15 MB", Path(page).stat().st_size < 15e6, f"{Path(page).stat().st_size / 1e6:.2f} MB")
    text = Path(page).read_text()
    check("... and refers to nothing outside", 'src="http' not in text and "@import" not in text and "<link" not in text)
    expected = json.dumps(expectations(Path(run), tomllib.loads(Path(case_file).read_text())))
    script = Path(__file__).parent / "page_test.mjs"
    done = subprocess.run(["node", script, node_folder, page, chromium, *pictures], input=expected, stdout=subprocess.PIPE, text=True)
    *lines, last = done.stdout.splitlines() or ["0 passed, 1 failed"]
    print("\n".join(lines))
    words = last.split()
    if len(words) != 4 or words[1] != "passed,":
        print(last)
        words = ["0", "", "1"]
    total = passed + int(words[0]), failed + int(words[2])
    print(f"{total[0]} passed, {total[1]} failed")
    return 1 if total[1] or done.returncode else 0


sys.exit(main(*sys.argv[1:]))
