"""Runs the programs of tools/frontier and gathers what they print.

A curve is named INTEGRATOR.SLIDER.PRECISION[.LAW], as its programs are; a setting is (curve, factor, gas factor), both
factors in thousandths of the case's time step and gas interval.
"""

import math
import shutil
import subprocess
import tempfile
import time
from collections import defaultdict
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

PAIR, WALL = 0, 1  # kinds of impact; the others are oblique
ANGLES = [0, 0, 5, 20, 35, 50, 65, 80]
REPEATS = 24


def lines(*command):
    done = subprocess.run(list(map(str, command)), check=False, capture_output=True, text=True)
    if done.returncode != 0:
        raise SystemExit(f"{' '.join(map(str, command))}: exit code {done.returncode}\n{done.stderr}")
    return [line.split(",") for line in done.stdout.splitlines()]


def speed_of(number):
    """Impact speed; the formula is that of impacts.hpp."""
    return 0.7 * 2 ** ((0.5 + number % REPEATS * 0.7548776662466927) % 1)


class Exact:
    """Exact outcomes, by law: [normal, tangential, surface spin, contact time, maximum overlap] of each impact."""

    def __init__(self, program):
        self.outcomes, self.doubt = defaultdict(dict), {}
        for kind, law, *rest in lines(program):
            if kind == "exact":
                self.outcomes[law][int(rest[0])] = list(map(float, rest[1:]))
            else:
                self.doubt[law] = float(rest[0])


def rms(values):
    values = list(values)
    return math.sqrt(sum(v * v for v in values) / len(values)) if values else math.nan


def impact_errors(program, exact):
    """Root mean square errors by factor and kind: velocity, spin (both over the impact speed), contact time, overlap
    (relative); kind None: all kinds. A factor whose run was stopped maps to the reason."""
    found, stopped, spins = defaultdict(dict), {}, defaultdict(dict)
    for what, factor, *rest in lines(program):
        if what == "stopped":
            stopped[int(factor)] = rest[0]
            continue
        number, values = int(rest[0]), list(map(float, rest[1:]))
        true, speed = exact[number], speed_of(number)
        error = (math.hypot(values[0] - true[0], values[1] - true[1]) / speed, (values[2] - true[2]) / speed,
                 values[3] / true[3] - 1, values[4] / true[4] - 1)
        found[int(factor)][number] = error
        spins[int(factor)][number] = values[2] / speed
    errors = {}
    for factor, by_number in found.items():
        kinds = {kind: [e for n, e in by_number.items() if n // REPEATS == kind] for kind in range(len(ANGLES))}
        kinds[None] = list(by_number.values())
        errors[factor] = {kind: [rms(e[k] for e in of_kind) for k in range(4)] for kind, of_kind in kinds.items()}
    return errors, stopped, spins


def trajectory_errors(program, state, truth):
    """{(factor, gas): {moment: (rms, maximum, path)}}, and reasons of runs that were stopped."""
    errors, stopped = defaultdict(dict), {}
    for what, factor, gas, *rest in lines(program, "errors", state, truth):
        setting = int(factor), int(gas)
        if what == "stopped":
            stopped[setting] = rest[1]
        else:
            errors[setting][int(rest[0])] = tuple(map(float, rest[1:]))
    return errors, stopped


def run_times(programs, state, rounds):
    """Least processor time of a step by curve and setting; the programs take turns, so that a disturbance of the machine
    meets all of them. Each time a fresh copy runs: the places of its pages in the machine's memory, which a file keeps as
    long as it is cached, make up to a third of the time (36 and 49 ms for copies of one program)."""
    best = defaultdict(dict)
    beside = Path(next(iter(programs.values()))).parent  # may be executed there
    with tempfile.TemporaryDirectory(dir=beside) as folder:
        for k in range(rounds):
            for curve, program in programs.items():
                copy = shutil.copy(program, Path(folder) / f"{k}.{Path(program).name}")
                for what, factor, gas, *rest in lines(copy, "time", state):
                    if what == "time":
                        setting, seconds = (int(factor), int(gas)), float(rest[0]) / int(rest[1])
                        best[curve][setting] = min(seconds, best[curve].get(setting, seconds))
    return best


def still_speeds(program, state):
    return {int(factor): float(rest[0]) for what, factor, _, *rest in lines(program, "still", state) if what == "still"}


def separation(program, state, factor):
    """Separation of two runs that differ by rounding: [(time, rms)] at one time step."""
    rows = [row for row in lines(program, "chaos", state) if row[0] == "chaos" and int(row[1]) == factor]
    return [(float(row[3]), float(row[4])) for row in rows]


def lyapunov_time(points, limit):
    """Time of growth by e, from the straight part of the logarithm: separations from ten times the first to `limit`."""
    kept = [(t, math.log(s)) for t, s in points if 10 * points[0][1] < s < limit]
    if len(kept) < 4:
        return math.nan
    mean_t, mean_y = sum(t for t, _ in kept) / len(kept), sum(y for _, y in kept) / len(kept)
    slope = sum((t - mean_t) * (y - mean_y) for t, y in kept) / sum((t - mean_t) ** 2 for t, _ in kept)
    return 1 / slope if slope > 0 else math.nan


def long_runs(programs, seeds, seconds, states, jobs):
    """{curve: {(factor, gas): {seed: [height, coordination, decay time, front velocity, layer ratio]}}}"""
    found = defaultdict(lambda: defaultdict(dict))

    def run(task):
        curve, program, seed = task
        return curve, seed, lines(program, "long", seed, seconds, *([states[seed]] if states else []))

    with ThreadPoolExecutor(jobs) as pool:
        for curve, seed, rows in pool.map(run, [(c, p, s) for s in seeds for c, p in programs.items()]):
            for what, factor, gas, *rest in rows:
                if what == "long":
                    found[curve][int(factor), int(gas)][seed] = list(map(float, rest[1:]))
    return found


def fill_states(program, seeds, out, jobs):
    """Final states of the case that the scene starts from, one for each seed."""

    def fill(seed):
        folder = out / f"fill-seed{seed}"
        lines(program, "--out", folder, "--replace", "--quiet", "--no-frames", "--seed", seed)
        return folder / "final.fixdem"

    with ThreadPoolExecutor(jobs) as pool:
        return dict(zip(seeds, pool.map(fill, seeds)))


def now():
    return time.monotonic()
