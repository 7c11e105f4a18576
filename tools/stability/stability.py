#!/usr/bin/env python3
"""How far a case is from instability: make stability CASE=name writes bench/reports/<case>/stability.md and what belongs to it.

Has make build the programs of tools/stability for the case, and runs them: the case's particles at rest, predicted and
measured limits of the time step (limits.cpp), the kernel just below and above them and from the case's own start at many
steps (kernel_runs.cpp), extreme scenes one process each (extremes_*.cpp), and what casegen says to no particles at all.
Ends with exit code 1 when a promise does not hold; the page says which. --quick is the part that belongs to make test.
"""

import argparse
import csv
import math
import re
import shutil
import subprocess
import sys
import tomllib
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import page
import pictures

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "python"))
from columns import as_command, read_columns  # noqa: E402
from fixdem import read_summary  # noqa: E402

TABLE_1_STEPS = [5e-7, 1e-6, 2e-6, 5e-6, 1e-5, 2e-5, 2.5e-5, 3e-5, 3.5e-5, 4e-5, 5e-5]  # s
FEWER_STEPS = [5e-7, 2e-6, 1e-5, 2e-5, 3e-5, 3.5e-5, 5e-5]  # for many particles
REST = "kernel_runs+RESTITUTION@0.2+STILL@1"
EXTREMES = ["extremes_load", "extremes_material+GROUP@1", "extremes_material+GROUP@2", "extremes_material+GROUP@3", "extremes_crowd"]
LONGEST = 120  # s: a scene that takes longer hangs


def rows_of(path):
    with path.open(newline="") as file:
        return list(csv.DictReader(file))


class Report:
    def __init__(self, chosen):
        self.chosen = chosen
        self.broken, self.kept = [], 0

    def promise(self, holds, text):
        if holds:
            self.kept += 1
        else:
            self.broken.append(text)

    def program(self, name):
        return self.chosen.folder / "bin" / name

    def build(self, names):
        if self.chosen.make:
            subprocess.run([*self.chosen.make.split(), *(str(self.program(name)) for name in names)], check=True)

    def run(self, name, *arguments):
        done = subprocess.run([str(self.program(name)), *map(str, arguments)], capture_output=True, text=True, timeout=900)
        if done.returncode != 0:
            raise SystemExit(f"{name} {' '.join(map(str, arguments))}: exit code {done.returncode}\n{done.stdout}{done.stderr}")
        return done.stdout.strip()


def own_run(results):
    """Summary and log of the case's own run."""
    columns = read_columns(results / "log.csv", ["time [s]"])
    return read_summary(results), [dict(zip(columns, row)) for row in zip(*columns.values())]


def limits(report, scratch, speed, quick):
    """Rest state, then prediction and measurement."""
    outcome, seconds, speed_left = report.run(REST, "rest", report.chosen.results / "final.fixdem", scratch / "rest.fixdem").rsplit(",", 2)
    report.run("limits", scratch / "rest.fixdem", report.chosen.out, speed, *(["quick"] if quick else []))
    found = rows_of(report.chosen.out / "limits.csv")
    for row in found:
        predicted, measured, bound = (float(row[k] or "nan") for k in ("predicted step [s]", "measured limit [s]", "watched bound [s]"))
        name = f"{row['scene']}, {row['integrator']}, e = {row['restitution']}"
        if row["scene"] == "settled bed":
            if float(row["restitution"]) >= 0.9 and row["criterion"] == "exact":
                report.promise(abs(measured / predicted - 1) <= 0.10, f"{name}: measured {measured:g} s is not within 10 % of {predicted:g} s")
            report.promise(predicted <= 1.002 * measured, f"{name}: the prediction {predicted:g} s is above the measured {measured:g} s")
            report.promise(0.6 * predicted <= bound, f"{name}: the bound {bound:g} s is below 0.6 of {predicted:g} s")
        if predicted == predicted:
            report.promise(bound <= predicted * (1 + 1e-4), f"{name}: the bound {bound:g} s is above {predicted:g} s")
            report.promise(predicted <= 1.002 * measured, f"{name}: the prediction {predicted:g} s is above the measured {measured:g} s")
    return {"seconds": float(seconds), "speed": float(speed_left), "outcome": outcome, "rows": found}


def confirm(report, scratch, found):
    """The kernel itself, 1 % below and above the measured limits of the settled bed at the case's restitution."""
    wanted = []
    for row in found["rows"]:
        if row["scene"] == "settled bed" and row["criterion"] == "exact" and float(row["restitution"]) == found["restitution"]:
            for factor in (0.99, 1.01):
                step = float(f"{factor * float(row['measured limit [s]']):.4g}")
                wanted.append((row["integrator"], factor, step))
    names = [f"kernel_runs+TIME_STEP@{step:g}+INTEGRATOR@{integrator}+RESTITUTION@{found['restitution']:g}+STILL@1" for integrator, _, step in wanted]
    report.build(names)
    rows = []
    for name, (integrator, factor, step) in zip(names, wanted):
        outcome, growth = report.run(name, "bed", scratch / "rest.fixdem").rsplit(",", 1)
        grows = not float(growth) <= 100 or outcome != "done"
        report.promise(grows == (factor > 1), f"kernel, {integrator} at {step:g} s: kinetic energy times {growth}, {outcome}")
        rows.append({"integrator": integrator, "of the measured limit": factor, "step [s]": step, "kinetic energy grew by": growth, "outcome": outcome})
    return rows


def decays(report, duration, limit, count):
    """Kinetic energy from the case's own start at many steps, by the kernel."""
    scale = 10 ** round(math.log10(limit / 3e-5))
    steps = [float(f"{step * scale:.3g}") for step in (TABLE_1_STEPS if count <= 300 else FEWER_STEPS)]
    names = {step: f"kernel_runs+TIME_STEP@{step:g}" for step in steps}
    report.build(names.values())
    rows, curves = [], {}

    def one(step):
        file = report.chosen.folder / f"decay-{step:g}.csv"
        outcome, energy, deepest = report.run(names[step], "decay", file, duration).rsplit(",", 2)
        return step, outcome, energy, deepest, rows_of(file)

    with ThreadPoolExecutor(report.chosen.jobs) as pool:
        for step, outcome, energy, deepest, curve in pool.map(one, steps):
            tenth = curve[min(10, len(curve) - 1)]
            rows.append({"step [s]": step, "outcome": outcome, "at a tenth [J]": tenth["kinetic energy [J]"], "at the end [J]": energy,
                         "maximum overlap / radius": deepest})
            curves[step] = curve
    with (report.chosen.out / "decay.csv").open("w", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["time step [s]", "time [s]", "kinetic energy [J]"])
        for step, curve in curves.items():
            table.writerows([f"{step:g}", row["time [s]"], row["kinetic energy [J]"]] for row in curve)
    return rows


def extremes(report, quick, has_gas):
    """Every extreme scene in a process of its own: a crash or a hang is a row."""
    programs = ["extremes_load"] if quick else [*EXTREMES, *(["extremes_gas"] if has_gas else [])]
    scenes = [(name, k, title) for name in programs for k, title in enumerate(report.run(name).splitlines())]

    def one(scene):
        name, k, title = scene
        row = dict.fromkeys(("scene", "verdict", "balance error", "maximum overlap / radius", "restitution", "message"), "")
        row["scene"] = title
        try:
            done = subprocess.run([str(report.program(name)), str(k)], capture_output=True, text=True, timeout=LONGEST)
        except subprocess.TimeoutExpired:
            return {**row, "verdict": "DEFECT", "message": f"still running after {LONGEST} s"}
        if done.returncode != 0:
            return {**row, "verdict": "DEFECT", "message": f"crashed with code {done.returncode}"}
        return dict(zip(row, next(csv.reader([done.stdout.strip()]))))

    with ThreadPoolExecutor(report.chosen.jobs) as pool:
        rows = list(pool.map(one, scenes))
    rows.append(no_particles(report))
    for row in rows:
        report.promise(row["verdict"] in ("stable", "warned", "refused", "stopped"), f"{row['scene']}: {row['verdict']} {row['message']}")
    with (report.chosen.out / "extremes.csv").open("w", newline="") as file:
        table = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        table.writeheader()
        table.writerows(rows)
    return rows


def no_particles(report):
    """The case with a count of 0 is for casegen to refuse."""
    text = report.chosen.case_file.read_text()
    file = report.chosen.folder / "none.toml"
    file.write_text(re.sub(r"(?m)^count *= *\d+", "count = 0", text))
    start = tomllib.loads(text)["start"]
    if before := isinstance(start, dict) and start.get("from"):
        shutil.copy(report.chosen.case_file.with_name(f"{before}.toml"), report.chosen.folder)
    done = subprocess.run([str(report.chosen.casegen), str(file), "--output", str(file.with_suffix(".hpp"))], capture_output=True, text=True)
    said = done.stderr.replace(str(file), report.chosen.case_file.name)
    verdict = "refused" if done.returncode == 3 and "count" in said else "DEFECT"
    return {"scene": "no particles", "verdict": verdict, "balance error": "", "maximum overlap / radius": "", "restitution": "",
            "message": f"exit code {done.returncode}: " + " ".join(said.split())}


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--case-file", type=Path, required=True)
    arguments.add_argument("--casegen", type=Path, required=True)
    arguments.add_argument("--folder", type=Path, required=True, help="folder for what is built and computed; programs are in bin/")
    arguments.add_argument("--results", type=Path, required=True, help="folder with the results of the case's own run")
    arguments.add_argument("--out", type=Path, required=True, help="folder for the page")
    arguments.add_argument("--make", help="command that builds a program when its path is appended; without it all are there")
    arguments.add_argument("--jobs", type=int, default=2)
    arguments.add_argument("--quick", action="store_true")
    arguments.add_argument("--count", type=Path, help='file for "PASSED FAILED"')
    chosen = arguments.parse_args()
    case = tomllib.loads(chosen.case_file.read_text())
    if {"species", "sizes"} & case["particles"].keys():
        raise SystemExit(f"{chosen.case_file}: make stability measures scenes of equal spheres only; give it a case with [particles] count and diameter")
    report = Report(chosen)
    chosen.out.mkdir(parents=True, exist_ok=True)

    summary, log = own_run(chosen.results)
    speed = max(float(row["max speed [m/s]"]) for row in log)
    has_gas = summary["plug"] is not None
    report.build([REST, "limits", "extremes_load"] if chosen.quick else [REST, "limits", *EXTREMES, *(["extremes_gas"] if has_gas else [])])

    found = limits(report, chosen.folder, speed, chosen.quick)
    bed = [row for row in found["rows"] if row["scene"] == "settled bed"]
    found["restitution"] = min((float(row["restitution"]) for row in bed), key=lambda e: abs(e - 0.9))
    content = {"case": summary["case"], "summary": summary, "log": log, "speed": speed, "limits": found,
               "rules": rows_of(chosen.out / "rules.csv"), "extremes": extremes(report, chosen.quick, has_gas)}
    grazing = chosen.out / "grazing.csv"
    content["grazing"] = rows_of(grazing) if grazing.exists() else []
    material, count = case["material"], case["particles"]["count"]
    content["own_poisson_ratio"] = f"{material.get('poisson_ratio', 0):.4g}"
    if not chosen.quick:
        own = next(row for row in bed if float(row["restitution"]) == found["restitution"] and row["integrator"] == summary["integrator"])
        content["confirmed"] = confirm(report, chosen.folder, found)
        content["duration"] = min(0.2, float(log[-1]["time [s]"]))
        content["decays"] = decays(report, content["duration"], float(own["predicted step [s]"]), count)
        pictures.draw(content, chosen.out)
    content["broken"] = report.broken
    (chosen.out / "stability.md").write_text(page.text(content, chosen.quick))
    for text in report.broken:
        print(f"stability of {summary['case']}: {text}")
    if chosen.count:
        chosen.count.write_text(f"{report.kept} {len(report.broken)}\n")
    else:
        print(f"{chosen.out / 'stability.md'}: {report.kept} promises kept, {len(report.broken)} broken")
    raise SystemExit(1 if report.broken else 0)


if __name__ == "__main__":
    as_command(main)
