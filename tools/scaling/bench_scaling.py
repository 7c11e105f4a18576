#!/usr/bin/env python3
"""Throughput of one core, of a sweep on one and two cores and of LAMMPS on one and two ranks; and when to leave one core.

Usage: see --help; make bench-scaling runs all of it. One core: runs of `make bench` for the settled bed. A sweep: what
`make sweep` says of itself. LAMMPS: the same settled bed, repeated along the pipe as make export-lammps does it, with the ranks
in turn; the best run counts. From these follow the constants of cost_model.py and the table of pipes up to 1e9 particles.
"""

import argparse
import json
import sys
from pathlib import Path

tools = Path(__file__).parent.parent
sys.path[:0] = [str(tools / name) for name in ("report", "bench_report", "peers", "lammps")]
from bench_report import read
from case_values import read_header
from cost_model import OneCore, ranks_from
from ending import finish
from export_lammps import write_all
from marked_part import MarkedPart
from report import gnuplot, machine, number, table
from run_lammps import run, summary
from scene_files import files
from states import read_final

REPEATS = (1, 10, 100)  # of a bed of a thousand
PARTICLE_STEPS = 2e7  # of one run of LAMMPS: some seconds
RANKS = (1, 2)
PIPES = [10**power for power in range(3, 10)]
DAY = 86400.0  # s


def one_core(json_files):
    """N -> the best rate of its benchmark, and bytes per particle of the largest."""
    figures, _ = read(json_files)
    beds = {f.particles: f for name, f in figures.items() if name.startswith("step/bed/") and name.endswith("/double")}
    beds.pop(150, None)  # another scene: bench/README.md
    if len(beds) < 2:
        raise SystemExit(f"{', '.join(map(str, json_files))}: step/bed/N/double of two sizes or more are needed; there is {sorted(beds)}")
    return {n: f.best for n, f in sorted(beds.items())}, beds[max(beds)].bytes


def lammps_rates(header, state_file, folder, lmp, mpirun, runs):
    """(N, ranks) -> particle-steps/s of every run."""
    case, state = read_header(header), read_final(state_file)
    rates = {}
    for repeat in REPEATS:
        particles = len(state.positions) * repeat
        place = folder / f"x{repeat}"
        write_all(place, files(case, state, f"the state {state_file}", repeat))
        for number_of_run in range(runs):
            for ranks in RANKS:
                print(f"bench-scaling: LAMMPS, {particles} particles, {ranks} ranks, run {number_of_run + 1} of {runs}", flush=True)
                run(place, lmp, ranks, mpirun, steps=max(20, round(PARTICLE_STEPS / particles)), frames=0, quiet=True)
                outcome = summary(place, case, ranks, repeat)
                rates.setdefault((particles, ranks), []).append(outcome["performance"]["particle_steps_per_second"])
    return rates


def sweep_of(path):
    """The runs of the last call of make sweep."""
    try:
        return json.loads(path.read_text())[-1]
    except (OSError, ValueError, LookupError) as problem:
        raise SystemExit(f"{path}: {problem}: not what make sweep writes") from None


def million(rate):
    return f"{rate * 1e-6:.3g}"


def measured(core, sweeps, lammps):
    rows = [["fixdem, settled bed", whole(n), "1 core", million(rate), ""] for n, rate in core.items()]
    first, second = (sweep["particle_steps_per_second"] for sweep in sweeps)
    rows.append([f"a sweep of {sweeps[0]['runs']} beds that settle", "1000 each", "1 core", million(first), ""])
    rows.append(["the same sweep", "1000 each", "2 cores", million(second), f"{second / first:.2f}"])
    for (particles, ranks), rates in sorted(lammps.items()):
        gain = f"{max(rates) / max(lammps[particles, 1]):.2f}" if ranks > 1 else ""
        rows.append(["LAMMPS, settled bed", whole(particles), f"{ranks} rank{'s' * (ranks > 1)}", million(max(rates)), gain])
    return table(["what", "particles", "on", "million particle-steps/s", "gain over one"], rows)


def duration(seconds):
    for unit, size in (("years", 365.25 * DAY), ("days", DAY), ("h", 3600.0), ("min", 60.0)):
        if seconds >= size:
            return f"{number(seconds / size)} {unit}"
    return f"{number(seconds)} s"


def whole(value):
    """With blanks between thousands, as everywhere in the text."""
    return "none" if value is None else f"{value:,}".replace(",", " ") if value >= 10_000 else str(value)


def estimate(core, ranks, bytes_per_particle, time_step):
    steps = 1 / time_step
    rows = []
    for particles in PIPES:
        equal = ranks.needed(particles, core.step(particles))
        in_a_day = ranks.needed(particles, DAY / steps)
        on_one = core.step(particles) * steps
        efficiency = ranks.per_particle * particles / in_a_day / ranks.step(particles, in_a_day) if in_a_day else None
        rows.append([
            whole(particles), f"{particles * bytes_per_particle / 1e9:.3g} GB", duration(on_one), whole(equal),
            "1 core is enough" if on_one <= DAY else f"{whole(in_a_day)} ranks ({efficiency:.0%} efficient)",
        ])
    head = ["particles", "memory on one core", "one core takes for 1 s", "ranks as fast as one core", "for 1 s in a day"]
    return table(head, rows)


def draw(core, ranks, time_step, path):
    """Time for a simulated second against the number of particles: one core and some numbers of ranks."""
    steps = 1 / time_step
    sizes = [10 ** (k / 4) for k in range(12, 37)]
    counts = (2, 16, 128, 1024)
    blocks = [[(n, core.step(n) * steps / 3600) for n in sizes]]
    blocks += [[(n, ranks.step(n, count) * steps / 3600) for n in sizes if n / count >= 100] for count in counts]
    data = "\n\n\n".join("\n".join(f"{n:.6g} {t:.6g}" for n, t in block) for block in blocks)
    titles = ["fixdem, one core", *(f"LAMMPS, {count} ranks" for count in counts)]
    curves = ", ".join(
        f"$scaling index {k} with lines lw {3 if k == 0 else 1.5} title '{title}'" for k, title in enumerate(titles)
    )
    gnuplot(
        f"$scaling << EOD\n{data}\nEOD\nset logscale xy\nset xrange [1e3:1e9]\nset format '10^{{%T}}'\nset grid\nset key left top\n"
        f"set xlabel 'particles'\nset ylabel 'hours for one simulated second'\n"
        f"set arrow from 1e3,24 to 1e9,24 nohead dashtype 2\nset label 'a day' at 1.2e3,36\nplot {curves}\n", path,
    )


def words(core, ranks):
    equal = ranks.needed(PIPES[-1], core.step(PIPES[-1]))
    longest = DAY / (core.cost(PIPES[-1]) * 5e5)
    return (
        f"Constants: one core {core.cost(1e3) * 1e9:.3g} ns per particle-step at 1000 particles, {core.cost(1e9) * 1e9:.3g} ns from "
        f"{whole(max(core.costs))} on; LAMMPS a = {ranks.per_particle * 1e9:.4g} ns per particle-step, b = {ranks.per_step * 1e6:.3g} us per step.\n\n"
        f"So: many scenes, each of a size for one core, are a sweep. One scene stays on one core up to {longest / 1e6:.2g} million particles if a simulated "
        f"second (500 000 steps) may take a day; beyond, LAMMPS needs {whole(equal)} ranks to be as fast as that core, and pays from there on."
    )


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--bench", type=Path, nargs="+", required=True, help="Google Benchmark's JSON of step/bed/N/double")
    arguments.add_argument("--sweeps", type=Path, nargs=2, required=True, help="sweep.json of one sweep on one core and on two")
    arguments.add_argument("--header", type=Path, required=True, help="of pipe_bed, written by casegen")
    arguments.add_argument("--state", type=Path, required=True, help="final.fixdem of pipe_bed")
    arguments.add_argument("--out", type=Path, required=True, help="folder of the runs of LAMMPS")
    arguments.add_argument("--lmp", default="lmp")
    arguments.add_argument("--mpirun", default="mpirun")
    arguments.add_argument("--runs", type=int, default=3)
    arguments.add_argument("--readme", type=Path, required=True, help="file with the marks of the part about scaling")
    arguments.add_argument("--picture", type=Path, required=True, help="picture to draw, without its ending")
    chosen = arguments.parse_args()
    part = MarkedPart(chosen.readme, "scaling")

    rates, bytes_per_particle = one_core(chosen.bench)
    sweeps = [sweep_of(path) for path in chosen.sweeps]
    lammps = lammps_rates(chosen.header, chosen.state, chosen.out, chosen.lmp, chosen.mpirun, chosen.runs)
    core = OneCore({n: 1 / rate for n, rate in rates.items()})
    alone, together = ({n: n / max(values) for (n, p), values in lammps.items() if p == count} for count in RANKS)
    ranks = ranks_from(alone, together, RANKS[-1])
    time_step = read_header(chosen.header)["time_step"]
    draw(core, ranks, time_step, chosen.picture)
    text = "\n\n".join([
        f"Regenerated by `make bench-scaling`. {machine()}.",
        measured(rates, sweeps, lammps), words(core, ranks), estimate(core, ranks, bytes_per_particle, time_step),
    ])
    print(text)
    part.write(text)


if __name__ == "__main__":
    finish("bench-scaling", main)
