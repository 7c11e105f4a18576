#!/usr/bin/env python3
"""Does LAMMPS do what fixdem does, given what make export-lammps writes? Named checks; make test-lammps.

- impacts: single collisions (impact_cases.py) at several speeds and angles, for every form of the law that is exported:
  against the kernel's leapfrog, which integrates as LAMMPS does, with a step so small that the laws are compared.
- trajectories: settle and pipe_bed in motion, 1000 steps from the same state, histories empty on both sides. LAMMPS is to lie
  no further from the kernel's leapfrog than the kernel's Euler does, root mean square over particles; and from Euler no
  further than twice that. So what differs in the law counts for less than the choice of the integrator.
- ranks: the same on 1 and 2 ranks, to rounding.
- gas: slices and the force on every particle of one update, against the kernel's.
- cases: LAMMPS takes the script of every shipped case.
- plug: plug_u24 from its start, 1.2 s with gas: front velocity and layer ratio as those of cases/README.md's seeds.
- size: a plug repeated a hundred times along the pipe, 1 and 2 ranks, and what speed that is.

Exit code: 0 when all passed. Writes its figures to agreement.md in the output folder.
"""

import argparse
import math
import re
import shutil
import subprocess
import sys
from pathlib import Path

root = Path(__file__).resolve().parent.parent.parent
for part in ("lammps", "peers", "report"):
    sys.path.insert(0, str(root / "tools" / part))
sys.dont_write_bytecode = True

import run_lammps  # noqa: E402
import scene_files  # noqa: E402
from case_values import law_of, read_header  # noqa: E402
from impact_cases import LAWS, impacts  # noqa: E402
from marked_part import MarkedPart  # noqa: E402
from states import read_dump, read_final  # noqa: E402

STEPS = 1000
ROUNDING = 1e-9  # in diameters after STEPS steps: a difference of 1e-16 grows tenfold in some ms, and contacts add their own
HEAD_ON_BOUND = 5e-4  # of the impact speed: the same normal force, damped at half a step's distance
# Oblique: sliders differ. LAMMPS' spring is not capped by itself, so the stronger the damping is, the less it slides like
# the kernel's; and its force acts at the middle of the overlap instead of the radius.
OBLIQUE_BOUND, STRONGLY_DAMPED_BOUND = 0.012, 0.1
STRONGLY_DAMPED = ("impacts_e05", "impacts_critical")
RESTITUTION_BOUND = 1e-3
GAS_BOUND = 1e-12  # of the greatest value
BIG = 100  # copies of the plug


class Checks:
    def __init__(self):
        self.passed = self.failed = 0
        self.lines = []

    def at_most(self, name, value, bound):
        self.note(name, value <= bound, f"{value:.3g} (at most {bound:.3g})")

    def between(self, name, value, low, high):
        shown = "none" if value is None else f"{value:.4g}"
        self.note(name, value is not None and low <= value <= high, f"{shown} ({low:.3g} to {high:.3g})")

    def note(self, name, holds, figures=""):
        self.passed, self.failed = self.passed + holds, self.failed + (not holds)
        self.say(f"{'passed' if holds else 'FAILED'}  {name}: {figures}")

    def say(self, line):
        self.lines.append(line)
        print(line, flush=True)


class Bench:
    """Where programs and states are, and runs of both sides."""

    def __init__(self, chosen):
        self.build, self.headers, self.impact_build, self.out, self.states = (
            chosen.build, chosen.headers, chosen.impact_build, chosen.out, chosen.states,
        )  # fmt: skip

    def header(self, case):
        return (self.impact_build if case in LAWS else self.headers) / "cases" / f"{case}.hpp"

    def kernel(self, case, *arguments):
        program = (self.impact_build if case in LAWS else self.build) / "lammps" / "kernel_beside" / case
        done = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise SystemExit(f"{program} {' '.join(map(str, arguments))}: {done.stderr}")
        return done.stdout

    def kernel_state(self, case, state, steps, integrator):
        dump = self.out / f"{case}.{integrator}.lammpstrj"
        dump.write_text(self.kernel(case, "run", state, steps, integrator))
        return read_dump(dump)

    def lammps(self, case, state, steps, ranks=1, repeat=1, change=lambda name, text: text, frames=0):
        """Exports and runs; the folder and summary. `change` may alter a file's text."""
        values = read_header(self.header(case))
        folder = self.out / f"{case}{f'-x{repeat}' if repeat > 1 else ''}-{ranks}"
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        for name, text in scene_files.files(values, law_of(values), read_final(state), "a test", repeat).items():
            (folder / name).write_text(change(name, text))
        copies = f"-x{repeat}" if repeat > 1 else ""
        program = self.build / "lammps" / "gas_beside" / f"{case}{copies}" if values["has_gas"] else "lmp"
        run_lammps.run(folder, program, ranks, steps=steps, frames=frames, quiet=True)
        return folder, run_lammps.summary(folder, values, ranks, repeat)

    def lammps_state(self, *arguments, **options):
        return read_dump(self.lammps(*arguments, **options)[0] / "final.lammpstrj")

    def state(self, case):
        return self.states / case / "final.fixdem"


def distances(case, a, b, repeat=1):
    """In diameters, of every particle, to the nearest image along a periodic pipe."""
    length = case["pipe_length"] * repeat
    found = []
    for x, y in zip(a.positions, b.positions):
        along = x[2] - y[2]
        if case["ends"] == "periodic":
            along -= length * round(along / length)
        found.append(math.hypot(x[0] - y[0], x[1] - y[1], along) / case["diameter"])
    return found


def rms(values):
    return math.sqrt(math.fsum(v * v for v in values) / len(values))


def after_impact(state, impact, radius):
    """Speeds along the normal and the slip relative to what was hit, and of the surface by rotation."""
    still = (0.0, 0.0, 0.0)
    other = state.velocities[impact.number - 1] if impact.kind == "pair" else still
    spin_axis = 3 - impact.normal - impact.slip
    velocity = state.velocities[impact.number]
    return (
        velocity[impact.normal] - other[impact.normal],
        velocity[impact.slip] - other[impact.slip],
        radius * state.spins[impact.number][spin_axis],
    )


def greatest_difference(ours, theirs, found, radius):
    """Of all speeds after these impacts, in impact speeds."""
    return max(
        abs(p - q) / impact.speed for impact in found for p, q in zip(*(after_impact(s, impact, radius) for s in (ours, theirs)))
    )


def less_damped(text, share):
    return re.sub(r"(tangential mindlin \S+) 1\.0", rf"\1 {share!r}", text)


def check_impacts(bench, checks):
    rows = []
    for name in LAWS:
        case = read_header(bench.header(name))
        start = bench.out / f"{name}.fixdem"
        bench.kernel(name, "start", start)
        steps = round(case["duration"] / case["time_step"])
        ours = bench.kernel_state(name, start, steps, "leapfrog")
        theirs = bench.lammps_state(name, start, steps)
        found, _ = impacts(case["diameter"], case["pipe_diameter"], case["pipe_length"])
        head_on = [impact for impact in found if impact.angle == 0]
        straight, oblique = (greatest_difference(ours, theirs, some, case["diameter"] / 2) for some in (head_on, found))
        checks.at_most(f"{name}: {len(head_on)} head-on impacts, of the impact speed", straight, HEAD_ON_BOUND)
        bound = STRONGLY_DAMPED_BOUND if name in STRONGLY_DAMPED else OBLIQUE_BOUND
        checks.at_most(f"{name}: all {len(found)} impacts, speeds and spin", oblique, bound)
        if case["damping"] == "restitution" and case["damping_mass"] == "reduced":
            rebounds = [after_impact(theirs, impact, 0)[0] / impact.speed for impact in head_on]
            apart = max(abs(rebound - case["restitution"]) for rebound in rebounds)
            checks.at_most(f"{name}: restitution {case['restitution']:g}", apart, RESTITUTION_BOUND)
        restitution = "-" if case["damping"] == "critical" else f"{case['restitution']:g}"
        rows.append(f"| `{name}` | {restitution} | {straight:.1e} | {oblique:.1e} |")
        if name == "impacts":
            for share in (0.5, 0.0):
                less = bench.lammps_state(name, start, steps, change=lambda file, text: less_damped(text, share))
                apart = greatest_difference(ours, less, found, case["diameter"] / 2)
                checks.note(f"{name}: {share:g} of the tangential damping would be further off", apart > oblique, f"{apart:.2g}")
    return ["| impacts | e | head-on | all |", "|---|---|---|---|", *rows]


def check_trajectories(bench, checks):
    rows = []
    for name in ("settle", "pipe_bed"):
        case, state = read_header(bench.header(name)), bench.state(name)
        euler, leapfrog = (bench.kernel_state(name, state, STEPS, integrator) for integrator in ("euler", "leapfrog"))
        one, two = (bench.lammps_state(name, state, STEPS, ranks) for ranks in (1, 2))
        integrators = rms(distances(case, euler, leapfrog))
        from_leapfrog, from_euler = (rms(distances(case, one, ours)) for ours in (leapfrog, euler))
        path = rms(distances(case, one, read_final(state)))
        checks.at_most(f"{name}: {STEPS} steps, from leapfrog, rms in d; euler is as far from it", from_leapfrog, integrators)
        checks.at_most(f"{name}: {STEPS} steps, from euler, rms in d", from_euler, 2 * integrators)
        checks.at_most(f"{name}: {STEPS} steps on 2 ranks, greatest, in d", max(distances(case, one, two)), ROUNDING)
        checks.note(f"{name}: the scene moves", path > 100 * integrators, f"{path:.3g} d in that time")
        rows.append(f"| `{name}` | {path:.2g} | {integrators:.2g} | {from_leapfrog:.2g} | {from_euler:.2g} |")
    return ["| scene | way | euler - leapfrog | LAMMPS - leapfrog | LAMMPS - euler |", "|---|---|---|---|---|", *rows]


def with_stored_forces(name, text):
    """Forces as they are before and after those of the gas, into the final dump."""
    if name == "scene.in":
        return re.sub(r"(?m)^(fix gas .*)$", r"fix before all store/force\n\1\nfix after all store/force", text)
    if name == "steps.in":
        forces = " ".join(f"f_{fix}[{k}]" for fix in ("before", "after") for k in (1, 2, 3))
        return text.replace("final.lammpstrj " + scene_files.COLUMNS, f"final.lammpstrj {scene_files.COLUMNS} {forces}")
    return text


def gas_forces(dump):
    """number -> force of the gas, N."""
    lines = dump.read_text().splitlines()
    start = next(k for k, line in enumerate(lines) if line.startswith("ITEM: ATOMS"))
    rows = [list(map(float, line.split())) for line in lines[start + 1 :]]
    return {int(row[0]): [row[13 + k] - row[10 + k] for k in range(3)] for row in rows}


def check_gas(bench, checks):
    name = "plug_u24"
    lines = [line.split(",") for line in bench.kernel(name, "gas", bench.state(name)).splitlines()]
    slices = [list(map(float, line[2:])) for line in lines if line[0] == "slice"]
    forces = {int(line[1]): list(map(float, line[3:])) for line in lines if line[0] == "force"}
    floaters = sum(int(line[2]) for line in lines if line[0] == "force")
    checks.note("gas: the state has floaters, a bed and slices of both", 0 < floaters < len(forces) / 2, f"{floaters} float")
    for ranks in (1, 2):
        folder, _ = bench.lammps(name, bench.state(name), 0, ranks, change=with_stored_forces)
        found = [list(map(float, line.split(",")[1:])) for line in (folder / "slices.csv").read_text().splitlines()[1:]]
        worst = 0.0
        for ours, theirs in zip(zip(*slices), zip(*found)):
            worst = max(worst, max(abs(a - b) for a, b in zip(ours, theirs)) / max(map(abs, ours)))
        checks.note(f"gas, {ranks} ranks: number of slices", len(found) == len(slices), f"{len(found)}")
        checks.at_most(f"gas, {ranks} ranks: numbers, velocities, heights, areas, voids, gradients, flows", worst, GAS_BOUND)
        theirs = gas_forces(folder / "final.lammpstrj")
        greatest = max(abs(f) for force in forces.values() for f in force)
        worst = max(abs(a - b) for number, force in forces.items() for a, b in zip(force, theirs[number]))
        checks.at_most(f"gas, {ranks} ranks: force on each of {len(forces)} particles", worst / greatest, GAS_BOUND)
    check_falling(bench, checks)
    case = read_header(bench.header(name))
    one, two = (bench.lammps_state(name, bench.state(name), STEPS, ranks) for ranks in (1, 2))
    checks.at_most(f"gas: {STEPS} steps on 1 and 2 ranks, greatest, in d", max(distances(case, one, two)), ROUNDING)


def check_falling(bench, checks):
    """A single particle in the gas, against the kernel's leapfrog and its Euler as trajectories are."""
    name, steps = "drag_single", 10 * STEPS
    case, start = read_header(bench.header(name)), bench.states / "drag_single-start" / "final.fixdem"
    euler, leapfrog = (bench.kernel_state(name, start, steps, integrator) for integrator in ("euler", "leapfrog"))
    theirs = bench.lammps_state(name, start, steps)
    apart, integrators = (rms(distances(case, leapfrog, other)) for other in (theirs, euler))
    checks.at_most(f"{name}: {steps} steps, from leapfrog, in d; euler is as far from it", apart, integrators)


def check_cases(bench, checks):
    """Every shipped case from its own start; those with gas whose program is not built as far as scene.in goes."""
    for header in sorted((bench.headers / "cases").glob("*.hpp")):
        case = read_header(header)
        state = bench.states / f"{case['name']}-start" / "final.fixdem"
        if case["has_gas"] and not (bench.build / "lammps" / "gas_beside" / case["name"]).exists():
            folder = bench.out / case["name"]
            folder.mkdir(parents=True, exist_ok=True)
            texts = scene_files.files(case, law_of(case), read_final(state), "a test")
            for name, text in texts.items():
                (folder / name).write_text(text)
            done = subprocess.run(["lmp", "-in", "scene.in", "-screen", "none"], cwd=folder, check=False)
            checks.note(f"case {case['name']}: LAMMPS takes the scene", done.returncode == 0, f"exit code {done.returncode}")
        else:
            _, outcome = bench.lammps(case["name"], state, 10, frames=5)
            checks.note(f"case {case['name']}: LAMMPS runs it", outcome["steps"] == 10, f"{outcome['particles']} particles")


def seeds_of(name):
    """(front velocity, layer ratio) of every seed in the table of cases/README.md."""
    rows = re.findall(rf"(?m)^\| `{name}` \| \d+ \| (\S+) \| \S+ \| \S+ \| (\S+) \|", (root / "cases" / "README.md").read_text())
    return [tuple(map(float, row)) for row in rows]


def widened(values):
    """From the least to the greatest, and as much again on either side: three seeds do not show all the scatter."""
    low, high = min(values), max(values)
    return low - (high - low), high + (high - low)


def check_plug(bench, checks):
    name = "plug_u24"
    _, outcome = bench.lammps(name, bench.states / f"{name}-start" / "final.fixdem", None)
    seeds = seeds_of(name)
    checks.between(f"{name}: front velocity, m/s", outcome["plug"]["front_velocity"], *widened([s[0] for s in seeds]))
    checks.between(f"{name}: layer area ratio", outcome["plug"]["layer_area_ratio"], *widened([s[1] for s in seeds]))
    plug = outcome["plug"]
    if plug["front_velocity"] is None:
        return []
    return [
        f"`{name}` over {outcome['final']['time']:g} s with gas: front {plug['front_velocity']:.2f} m/s, layer area ratio "
        f"{plug['layer_area_ratio']:.2f}; seeds of the kernel: {', '.join(f'{front:g} m/s and {ratio:g}' for front, ratio in seeds)}."
    ]


def check_size(bench, checks):
    name, states = "plug_u24", []
    case = read_header(bench.header(name))
    for ranks in (1, 2):
        folder, outcome = bench.lammps(name, bench.state(name), 200, ranks, BIG)
        states.append(read_dump(folder / "final.lammpstrj"))
        checks.say(run_lammps.describe(outcome))
    checks.note("size: particles", len(states[0].positions) == BIG * case["particle_count"], f"{len(states[0].positions)}")
    checks.at_most("size: 1 and 2 ranks, greatest, in d", max(distances(case, *states, BIG)), ROUNDING)
    small = bench.lammps_state(name, bench.state(name), 200)
    count = case["particle_count"]
    for copy in (0, BIG - 1):
        part = states[1]
        part = type(part)(part.positions[copy * count : (copy + 1) * count], [], [])
        checks.at_most(f"size: copy {copy + 1} moves as the plug alone, greatest, in d", max(distances(case, part, small)), 1e-6)


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--build", type=Path, required=True, help="folder with lammps/ of the shipped cases")
    arguments.add_argument("--headers", type=Path, required=True, help="folder with cases/ of their headers")
    arguments.add_argument("--impact-build", type=Path, required=True, help="the same of the cases of impact_cases.py")
    arguments.add_argument("--states", type=Path, required=True, help="CASE/final.fixdem in motion, CASE-start/final.fixdem")
    arguments.add_argument("--out", type=Path, required=True)
    arguments.add_argument("--only", help="one of the parts, by name")
    arguments.add_argument("--readme", type=Path, help="rewrite the tables there, when all parts have been run and passed")
    chosen = arguments.parse_args()
    chosen.build, chosen.impact_build = chosen.build.resolve(), chosen.impact_build.resolve()
    part_of_readme = MarkedPart(chosen.readme, "agreement") if chosen.readme else None
    chosen.out.mkdir(parents=True, exist_ok=True)
    bench, checks = Bench(chosen), Checks()
    parts = {"impacts": check_impacts, "trajectories": check_trajectories, "gas": check_gas, "cases": check_cases,
             "size": check_size, "plug": check_plug}  # fmt: skip
    page = []
    for name, part in parts.items():
        if chosen.only in (None, name):
            figures = part(bench, checks)
            page += ["", *figures] if figures else []
    if part_of_readme and not chosen.only and checks.failed == 0:
        part_of_readme.write("\n".join(["Regenerated by `make test-lammps README=1`.", *page]))
    (chosen.out / "agreement.md").write_text("\n".join([*page, "", "```", *checks.lines, "```"]) + "\n")
    print(f"{checks.passed} passed, {checks.failed} failed")
    return checks.passed == 0 or checks.failed > 0


if __name__ == "__main__":
    sys.exit(main())
