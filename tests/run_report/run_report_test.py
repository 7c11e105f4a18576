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
import tempfile
import tomllib
import zlib
from pathlib import Path

import numpy as np

root = Path(__file__).parent.parent.parent
for part in ("tools/report", "tools/run_report", "tools/python", "tests"):
    sys.path.insert(0, str(root / part))
import line_content
import line_folder
import line_frames
import page_content
import page_parts
import player_data
import run_folder
from columns import FixdemError, read_columns
from frames import frame_list, read_frame

passed = failed = 0


def check(what, right, found=""):
    global passed, failed
    passed, failed = passed + bool(right), failed + (not right)
    print(f"{'passed' if right else 'FAILED'}  {what}" + (f": {found}" if found != "" else ""))


def unpacked(about, text):
    """The stream of player_data.py undone, plainly: positions and values as floats; of a line serial numbers, -1 where a row is empty."""
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
    if "last_serial" in about:
        numbers = sum(stream[len(stream) - (4 - k) * count :][:count].astype(np.uint32) << 8 * k for k in range(4))
        arrays["serial"] = np.cumsum(numbers.reshape(shape), axis=0, dtype=np.uint32).astype(int) - 1
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
    fractions = run_folder.solids_fraction(pipe, frames["position"][:, :, 2], [frames["radius"]], run_folder.slices_of(pipe, frames))
    check("solids by volume: an eighth of it for half the diameter", fractions.shape == (1, 40) and abs(fractions[0, 5] / fractions[0, 35] - 8) < 1e-9)
    case = {"particles": {"density": 1e3, "species": [{"name": "large", "count": 2}, {"name": "small", "count": 3}]}, "start": {"particle": []}}
    summary = {"features": [], "precision": "double", "final": {"state_hash": "0"}}
    rows = page_content.facts(summary, case)
    check("the case has a row for each species", rows.count("[[particles.species]]") == 2 and "name = small, count = 3" in rows)
    check("... and its particles are theirs", page_content.particle_count(case) == 5)
    (chart,) = page_content.charts({"mean axial velocity of small [m/s]": [1.0]})
    check("... and its log a line for each", [line["label"] for line in chart["lines"]] == ["mean axial velocity of small"])


def coming_and_going():
    """Particles of a line come out of the packed frames where they were, each under its own number."""
    line = line_folder.Line(length=1.0, duration=3.0, every=0.5)
    made = line_folder.particles(line)
    with tempfile.TemporaryDirectory() as folder:
        run = Path(folder)
        line_folder.write_frames(run, line, made)
        frames = line_frames.LineFrames(run)
        about, text = player_data.pack_line(frames)
        small, small_text = player_data.pack_line(frames, len(text) // 6)
        (run / "frames.pvd").write_text("<VTKFile><Collection></Collection></VTKFile>")
        try:
            line_frames.LineFrames(run)
            check("a list without frames is refused", False)
        except FixdemError as words:
            check("a list without frames is refused", "lists no frames" in str(words))
    last = max(particle[0] for _, frame in made for particle in frame)
    rows = unpacked(about, text)
    off, seen = 0.0, 0
    for k, (_, frame) in enumerate(made):
        places = {number: row for row, number in enumerate(rows["serial"][k]) if number >= 0}
        seen += places.keys() == {number for number, _, _ in frame}
        off = max(off, *(abs(rows["z"][k, places[number]] - position[2]) / about["scale"]["z"]["step"] for number, position, _ in frame))
    check("in each frame those that are there, by number", seen == len(made) and about["last_serial"] == last, seen)
    check("... where they are, to half a step", off < 0.5001, f"{off:.3f}")
    most = max(len(frame) for _, frame in made)
    check("rows are used again", last > 1.2 * most and about["particles"] < most + 20, f"{about['particles']} rows, {last + 1} particles, {most} at once")
    changes = (rows["serial"][1:] != rows["serial"][:-1]) & (rows["serial"][1:] >= 0) & (rows["serial"][:-1] >= 0)
    check("... but never from one frame to the next", not changes.any())
    fewer = unpacked(small, small_text)
    check("less room: a share of the particles, all frames", small["share"] > 1 and small["every"] == 1 and (fewer["serial"][fewer["serial"] >= 0] % small["share"] == 0).all(), small["share"])
    check("... drawn as much larger as fills the pipe", abs(small["drawn"] ** 3 - small["share"]) < 1e-9 and about["drawn"] == 1)

    two = {"times": [0.0, 1.0], "serial": np.array([[1, 2, 0], [1, 0, 3]]), "radius": np.full((2, 3), 0.005), "position": np.zeros((2, 3, 3)), "velocity": np.zeros((2, 3, 3))}
    two["position"][:, :, 2] = [[0.1, 0.8, 0.2], [0.3, 0.8, 0.2]]
    two["velocity"][0, 1, 2] = 0.4
    seen = [line_frames.between(two, time, 1.0)[0][:, 2].tolist() for time in (0.0, 0.25, 0.6, 1.0)]
    check("between frames they move, leave at the end and come in the middle of the time",
          np.allclose(sum(seen, []), [0.1, 0.8, 0.15, 0.9, 0.22, 0.2, 0.3, 0.2]) and [len(z) for z in seen] == [2, 2, 2, 2], seen)  # fmt: skip


def a_line():
    """What the page says of a line, from its files; with slices and without, and of one that has just begun."""
    line = line_folder.Line(duration=6.0)
    case, pipe = line.case(), {"length": line.length, "diameter": line.diameter, "periodic": False}
    with tempfile.TemporaryDirectory() as folder:
        run = line_folder.write_line(Path(folder), line, frames=True)

        def content():
            log = read_columns(run / "log.csv")
            log["kinetic"] = log["kinetic energy translation [J]"]
            return log, line_content.LineContent(run, case, pipe, line_folder.summary(line), log, player_data.BUDGET)

        log, page = content()
        check("masses follow from rates", abs(log["mass fed [kg]"][-1] - 0.2 * line.duration) < 1e-9 and log["mass fed [kg]"][0] == 0)
        said = {row["what"]: row for row in page.verdicts}
        check("verdicts of the line", said["the line"]["word"] == "flows in plugs" and said["particles"]["word"] == "add up" and "0.348 m/s" in said["front against particles"]["found"])
        titles = [chart["title"] for chart in page.data["charts"]]
        check("charts of masses and stations", {"Mass in, out and in the pipe", "Mass flow", "Pressure at the stations"} <= set(titles), len(titles))
        pressure = page.data["probes"]["columns"]
        check("... with the stations' own times", len(pressure["time"]) == 601 and pressure["pressure 0"][3] == 1000 and pressure["pressure 1"][3] is None)
        solids, gas = page.data["maps"]
        check("pictures from the slices", len(solids["values"]) == 301 and len(solids["values"][0]) == 200 and gas["values"][-1][0] == float(f"{line.pressure(line.solids(6.0))[0]:.3g}"))
        tracks = page.data["line"]["tracks"]
        check("... with the tracks of plugs that count", len(tracks) == len([p for p in line.plugs()]) and page.overlay.count('class="track"') == len(tracks) and page.overlay.count("probe") == 2, len(tracks))
        check("... which are tabled", page.plugs.count('scope="row"') == len(tracks) and "1 more are in plugs.csv" in page.plugs)
        html = page_parts.player({"end": 6.0, "directions": "", "pipe": pipe, "line": page.data["line"]}, page.data["frames"])
        check("the player has a window that moves with plugs", 'id="strip"' in html and '<option value="each" selected>' in html and '<option value="0.8" selected>' in html)
        (run / "slices.bin").unlink()
        (run / "plugs.csv").write_text(line_folder.PLUG_HEAD)
        _, page = content()
        solids, gas = page.data["maps"]
        check("without slices pictures come from the frames", len(solids["values"]) == 121 and len(solids["values"][0]) == 200)
        share = sum(solids["values"][-1]) / 200 * np.pi / 4 * line.diameter**2 * line.length / (np.pi / 6 * line.grain**3)
        check("... with the volume of the particles", abs(share / len(line_folder.particles(line)[-1][1]) - 1) < 0.01, share)
        check("... and the pressure of the gas", abs(gas["values"][-1][0] / line.pressure(line.solids(6.0))[0] - 1) < 0.01)
        check("... and no plugs to move with", 'value="each"' not in page_parts.along({"pipe": pipe, "line": page.data["line"]}) and 'scope="row"' not in page.plugs)
        for path in (run / "frames.pvd", *run.glob("frames/*")):
            path.unlink()
        (run / "slices.bin").write_bytes(line_folder.slices_bytes(line).partition(b"\n")[0] + b"\n")
        _, page = content()
        check("a run of neither has no pictures", page.data["maps"] == [] and page.data["frames"] is None and page_parts.maps([], page.overlay) == "")
    check("what a case of a line says of its parts", page_content.facts({"features": [], "precision": "double", "final": {"state_hash": "0"}}, case).count("[[probe]]") == 2)
    other = page_parts.maps([{"id": "m", "title": "t", "length": 1.0}])
    check("maps of other cases have nothing over them", "<svg" not in other and "tall" not in other and "Lines:" not in other)


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
    is_line = case["pipe"]["ends"] == "open"
    position = np.concatenate([frame["position"] for _, frame in frames])
    with (run / "log.csv").open(newline="") as file:
        last = list(csv.DictReader(file))[-1]
    radii = frames[-1][1]["radius"]
    pipe = math.pi / 4 * case["pipe"]["diameter"] ** 2 * case["pipe"]["length"]
    picks = [(frame, int(share * (len(frames[frame][1]["radius"]) - 1))) for frame, share in ((0, 0), (len(frames) // 2, 1 / 3), (len(frames) - 1, 1))]
    return {
        "title": case["title"],
        "status": json.loads((run / "summary.json").read_text())["status"],
        "frames": len(frames),
        "end": float(last["time [s]"]),
        "second_time": frames[1][0],
        "step": list(np.ptp(position, axis=0) / 65535),
        "mean_fraction": sum(4 / 3 * math.pi * radius**3 for radius in radii) / pipe,
        "radius_step": max(radii) - min(radii),
        "pressure_drop": float(last["pressure drop [Pa]"]) if "gas" in case else None,
        "pipe_length": case["pipe"]["length"],
        "charts": None if is_line else 8 if "gas" in case else 5,
        "is_line": is_line,
        "samples": [{"frame": f, "particle": p, "serial": frames[f][1]["serial"][p] if is_line else None, "position": frames[f][1]["position"][p],
                     "contacts": frames[f][1]["contacts"][p], "radius": frames[f][1]["radius"][p]} for f, p in picks],
    }  # fmt: skip


def main(run, page, case_file, node_folder, chromium, *pictures):
    packing()
    sizes()
    rolling()
    coming_and_going()
    a_line()
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
