#!/usr/bin/env python3
"""Error against run time for one case: make frontier. Writes frontier.md, .csv, .svg and .png into the folder --out.

Runs the programs that tools/make/frontier.mk has compiled (measure.py), works out errors, orders and the Pareto set, and
writes the page (page.py). Every number in the page comes from this run.
"""

import argparse
import re
import sys
from pathlib import Path

sys.path[:0] = [str(Path(__file__).parent.parent / part) for part in ("report", "peers")]
import measure
import page
import report
from case_values import read_header

LONG_BUDGET = 1.5e8  # particle-steps of one long run at the case's own step
SEEDS = [1, 2, 3, 4, 5]


class Facts:
    """What the page says of the case, from its generated header."""

    def __init__(self, header):
        text = header.read_text()

        def value(name):
            return float.fromhex(re.search(rf" {name} = (0x[^;]*);", text).group(1))

        if "SizeRun sizes[]" in text:
            raise SystemExit(f"{header}: make frontier measures scenes of equal spheres only; give it a case with [particles] count and diameter")
        self.title = re.search(r' title = "(.*)";', text).group(1)
        self.count = int(re.search(r" particle_count = (\d+);", text).group(1))
        self.time_step, self.duration, self.diameter = value("time_step"), value("duration"), value("diameter")
        self.has_gas = " has_gas = true;" in text
        self.gas_interval = int(re.search(r" gas_update_interval = (\d+);", text).group(1))
        self.tangential = re.search(r"TangentialLaw::(\w+);", text).group(1)
        case = read_header(header)
        self.restitution, self.wall_restitution = case["restitution"], case["wall_restitution"]
        self.rolling_friction = case["wall_rolling_friction"]  # at walls; a head-on pair does not turn
        self.instruction_set = ""


def programs_of(folder, what):
    """Curve: program; plain curves first."""
    found = {f.name[len(what) + 1 :]: f for f in sorted(folder.glob(f"{what}.*")) if f.suffix != ".d"}
    return dict(sorted(found.items(), key=lambda item: (item[0].count("."), item[0])))


def law_of(curve, usual):
    words = curve.split(".")
    return words[3] if len(words) > 3 else usual


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--programs", type=Path, required=True, help="folder of the compiled programs and of truth.csv")
    arguments.add_argument("--case", required=True)
    arguments.add_argument("--header", type=Path, required=True, help="the case's generated header")
    arguments.add_argument("--state", type=Path, required=True, help="final state of the case")
    arguments.add_argument("--fill", type=Path, help="program of the case that this one starts from")
    arguments.add_argument("--out", type=Path, required=True)
    arguments.add_argument("--quick", action="store_true", help="two seeds, short runs, one round of timing")
    arguments.add_argument("--jobs", type=int, default=2, help="programs running at a time where nothing is timed")
    chosen = arguments.parse_args()
    chosen.out.mkdir(parents=True, exist_ok=True)

    def say(text):
        print(f"  frontier: {text}", file=sys.stderr, flush=True)

    begin = measure.now()
    facts = Facts(chosen.header)
    result = page.Result(chosen.case, facts, chosen.quick)

    say("impacts")
    exact = measure.Exact(chosen.programs / "exact")
    result.doubt = exact.doubt
    for curve, program in programs_of(chosen.programs, "collide").items():
        law = law_of(curve, facts.tangential)
        result.impacts[curve] = measure.impact_errors(program, exact.outcomes[law])
    result.exact_spin = exact.outcomes[facts.tangential]

    bodies = programs_of(chosen.programs, "bodies")
    plain = {curve: program for curve, program in bodies.items() if not curve.startswith("gas.")}
    say("run times")
    result.times = measure.run_times(bodies, chosen.state, 1 if chosen.quick else 7)
    say("trajectories")
    truth = chosen.programs / "truth.csv"
    for curve, program in bodies.items():
        result.errors[curve], result.stopped[curve] = measure.trajectory_errors(program, chosen.state, truth)
    first = next(iter(plain))
    result.separation = measure.separation(plain[first], chosen.state, 1000)
    if not facts.has_gas:
        result.still = {curve: measure.still_speeds(program, chosen.state) for curve, program in plain.items()}

    say("long runs")
    seeds = SEEDS[:2] if chosen.quick else SEEDS
    result.long_seconds = min(facts.duration, LONG_BUDGET * facts.time_step / facts.count) * (0.1 if chosen.quick else 1)
    states = measure.fill_states(chosen.fill, seeds, chosen.programs, chosen.jobs) if chosen.fill else None
    result.long = measure.long_runs(plain, seeds, result.long_seconds, states, chosen.jobs)
    result.seeds = seeds

    result.seconds = measure.now() - begin
    result.write(chosen.out)
    print(result.last_line())
    say(f"wrote {chosen.out / 'frontier.md'} after {result.seconds:.0f} s")


if __name__ == "__main__":
    main()
