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
import page_parts
import player_data
import run_folder
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


def sizes():
    """What particles differ in comes once and is there for colours."""
    random = np.random.default_rng(2)
    position, velocity = random.random((5, 40, 3)), random.random((5, 40, 3))
    contacts = np.zeros((5, 40), int)
    own = {"diameter": 0.004 + 0.006 * random.random(40), "species": np.arange(40) % 3, "names": ["a", "b", "c"]}
    about, text = player_data.pack(list(range(5)), position, velocity, contacts, own=own)
    data = zlib.decompress(base64.b64decode(text))[-3 * 40 :]
    found = about["own"]["diameter"]["low"] + about["own"]["diameter"]["step"] * (np.frombuffer(data[:40], np.uint8) + 256.0 * np.frombuffer(data[40:80], np.uint8))
    check("own diameters come back to half a step", np.abs(found - own["diameter"]).max() < 0.5001 * about["own"]["diameter"]["step"])
    check("... and species with their names", data[80:] == bytes(own["species"].astype(np.uint8)) and about["own"]["species"]["names"] == ["a", "b", "c"])
    run = {"end": 1.0, "directions": ""}
    page = page_parts.player(run, about)
    check("... and are what particles are coloured by at first", 'id="colour"><option value="species">' in page)
    about, _ = player_data.pack(list(range(5)), position, velocity, contacts)
    equal = page_parts.player(run, about)
    check("equal particles have neither", "own" not in about and 'id="colour"><option value="axial">' in equal and "diameter" not in equal)

    frames = {"radius": np.array([0.005, 0.0025]), "species": None, "pressure_gradient": None, "position": np.array([[[0, 0, 0.055], [0, 0, 0.355]]])}
    pipe = {"diameter": 0.05, "length": 0.4}
    fractions = run_folder.solids_fraction(pipe, frames, run_folder.slices_of(pipe, frames))
    check("solids by volume: an eighth of it for half the diameter", fractions.shape == (1, 40) and abs(fractions[0, 5] / fractions[0, 35] - 8) < 1e-9)
    case = {"particles": {"density": 1e3, "species": [{"name": "large", "count": 2}, {"name": "small", "count": 3}]}, "start": {"particle": []}}
    summary = {"features": [], "precision": "double", "final": {"state_hash": "0"}}
    rows = page_content.facts(summary, case)
    check("the case has a row for each species", rows.count("[[particles.species]]") == 2 and "name = small, count = 3" in rows)
    check("... and its particles are theirs", page_content.particle_count(case) == 5)
    (chart,) = page_content.charts({"mean axial velocity of small [m/s]": [1.0]})
    check("... and its log a line for each", [line["label"] for line in chart["lines"]] == ["mean axial velocity of small"])


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
    radii = frames[0][1]["radius"]
    pipe = math.pi / 4 * case["pipe"]["diameter"] ** 2 * case["pipe"]["length"]
    picks = [(0, 0), (len(frames) // 2, len(radii) // 3), (len(frames) - 1, len(radii) - 1)]
    return {
        "title": case["title"],
        "status": json.loads((run / "summary.json").read_text())["status"],
        "frames": len(frames),
        "end": float(last["time [s]"]),
        "second_time": frames[1][0],
        "step": list(np.ptp(position, axis=(0, 1)) / 65535),
        "mean_fraction": sum(4 / 3 * math.pi * radius**3 for radius in radii) / pipe,
        "radius_step": max(radii) - min(radii),
        "pressure_drop": float(last["pressure drop [Pa]"]) if "gas" in case else None,
        "pipe_length": case["pipe"]["length"],
        "charts": 8 if "gas" in case else 5,
        "samples": [{"frame": f, "particle": p, "position": frames[f][1]["position"][p], "contacts": frames[f][1]["contacts"][p],
                     "radius": radii[p]} for f, p in picks],
    }  # fmt: skip


def main(run, page, case_file, node_folder, chromium, *pictures):
    packing()
    sizes()
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
