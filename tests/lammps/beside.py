"""What the checks of test-lammps share: where programs and states are, runs of both sides, and how far two states are apart."""

import math
import shutil
import subprocess
import sys
from pathlib import Path

root = Path(__file__).resolve().parent.parent.parent
for part in ("lammps", "peers", "report"):
    sys.path.insert(0, str(root / "tools" / part))

import run_lammps  # noqa: E402
import scene_files  # noqa: E402
from case_values import kinds_of, read_header  # noqa: E402
from impact_cases import LAWS  # noqa: E402
from states import read_dump, read_final  # noqa: E402

STEPS = 1000
ROUNDING = 1e-9  # in diameters after STEPS steps: a difference of 1e-16 grows tenfold in some ms, and contacts add their own


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
        for name, text in scene_files.files(values, read_final(state), "a test", repeat).items():
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
    length, diameter = case["pipe_length"] * repeat, kinds_of(case)[0].diameter
    found = []
    for x, y in zip(a.positions, b.positions):
        along = x[2] - y[2]
        if case["ends"] == "periodic":
            along -= length * round(along / length)
        found.append(math.hypot(x[0] - y[0], x[1] - y[1], along) / diameter)
    return found


def rms(values):
    return math.sqrt(math.fsum(v * v for v in values) / len(values))
