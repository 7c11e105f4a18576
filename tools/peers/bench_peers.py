#!/usr/bin/env python3
"""Runs fixdem, LAMMPS and LIGGGHTS on the same scenes in turn, on one core, and compares speed and result.

First the law alone, then for each peer and scene the skin of its neighbour list that is fastest here, then the runs that
count, each program in turn. Exit code 1 when a peer did not simulate the same thing; nothing is written then.
"""

import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

sys.path.append(str(Path(__file__).parent.parent / "report"))
import rates
from case_values import law_of, read_case
from checking import check_agitated, check_bed, check_law
from marked_part import KeptTable, MarkedPart
from peer_inputs import Stretch
from running import Fixdem, Peer
from states import State, observe, read_final

SKINS = (0.01, 0.02, 0.05, 0.1, 0.2)  # in diameters
IMPACT_TIME = 1.5e-4  # s: every collision of the scene is over
SETTLE_STEPS, BED_STEPS, AGITATED_STEPS = 20000, 40000, 25000


@dataclass
class Scene:
    name: str
    case: dict
    start: State
    stretch: Stretch
    trial: Stretch  # shorter, to choose the skin by
    runs_per_round: int  # more than one where a run is short
    run_fixdem: object  # () -> Run
    check: object


def found(command):
    """The full path of a program, because runs have folders of their own."""
    path = shutil.which(command)
    if not path:
        raise SystemExit(f"bench-peers: no program {command}; give LMP=/path/to/lmp, or install the package (make does)")
    return Path(path).resolve()


def version_of(command):
    with tempfile.TemporaryDirectory() as folder:  # LIGGGHTS leaves a log where it is asked
        said = subprocess.run([command, "-h"], cwd=folder, capture_output=True, text=True, check=False).stdout
    version = re.search(r"Simulator - (.+)|\(Version LIGGGHTS-([^,]+)", said)
    if not version:
        raise SystemExit(f"{command} -h: neither LAMMPS nor LIGGGHTS answers")
    return next(group for group in version.groups() if group).strip()


def say(words):
    print(f"bench-peers: {words}", file=sys.stderr, flush=True)


def at_rest(state):
    still = [(0.0, 0.0, 0.0)] * len(state.positions)
    return State(state.positions, still, still)


def scenes_of(fixdem, headers, settled):
    """Fixdem's untimed part of both scenes is run here: the start of one, the settling of the other."""
    case = read_case(headers / "bed.hpp")
    step = case["time_step"]
    fixdem.run("bed_settle", SETTLE_STEPS, step, settled)
    bed = Scene(
        "bed", case, at_rest(read_final(settled)), Stretch(SETTLE_STEPS, BED_STEPS, step), Stretch(1000, 5000, step), 1,
        lambda: fixdem.run("bed", BED_STEPS, step, fixdem.final("bed_settle")), check_bed,
    )  # fmt: skip
    case = read_case(headers / "agitated.hpp")
    start = fixdem.run("agitated", 0, step).state
    whole = Stretch(0, AGITATED_STEPS, step)
    agitated = Scene("agitated", case, start, whole, whole, 3, lambda: fixdem.run("agitated", AGITATED_STEPS, step), check_agitated)
    return [bed, agitated]


def disagreements(title, checks):
    for check in checks:
        print(f"  {title:<20} {check.line()}", flush=True)
    return sum(not check.holds for check in checks)


def compare_laws(fixdem, peers, headers):
    case = read_case(headers / "impacts.hpp")
    law, step = law_of(case), case["time_step"]
    start = fixdem.run("impacts", 0, step).state
    steps = round(IMPACT_TIME / step)
    ours = fixdem.run("impacts", steps, step).state
    wrong = 0
    for peer in peers:
        theirs = peer.run(case, law, start, Stretch(0, steps, step), SKINS[-1] * case["diameter"]).state
        wrong += disagreements(f"law, {peer.name}", check_law(peer.name, case, ours, theirs))
    return wrong


def fastest_skin(peer, scene, law):
    """The best of three interleaved runs with each."""
    times = {}
    for skin in SKINS * 3:
        seconds = peer.run(scene.case, law, scene.start, scene.trial, skin * scene.case["diameter"]).seconds
        times[skin] = min(seconds, times.get(skin, seconds))
    return min(times, key=times.get)


def compare_scene(scene, fixdem, peers, runs):
    """Rows of the table, and the number of disagreements."""
    law = law_of(scene.case)
    say(f"{scene.name}: choosing skins")
    skins = {peer.name: fastest_skin(peer, scene, law) for peer in peers}
    seconds = {name: [] for name in (fixdem.name, *skins)}
    runs *= scene.runs_per_round
    for number in range(1, runs + 1):
        say(f"{scene.name}: run {number} of {runs}")
        ours = scene.run_fixdem()
        seconds[fixdem.name].append(ours.seconds)
        final = {}
        for peer in peers:
            theirs = peer.run(scene.case, law, scene.start, scene.stretch, skins[peer.name] * scene.case["diameter"])
            seconds[peer.name].append(theirs.seconds)
            final[peer.name] = observe(scene.case, theirs.state)
    observed = observe(scene.case, ours.state)
    wrong = sum(disagreements(f"{scene.name}, {name}", scene.check(scene.case, law, observed, theirs)) for name, theirs in final.items())
    remarks = {fixdem.name: "", **{name: f"skin {skin:g} d" for name, skin in skins.items()}}
    return rates.rows_of(scene.name, seconds, scene.stretch.timed * scene.case["particle_count"], remarks), wrong


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--programs", type=Path, required=True, help="folder of the derived cases' programs")
    arguments.add_argument("--headers", type=Path, required=True, help="folder of their headers")
    arguments.add_argument("--settled", type=Path, required=True, help="final.fixdem of the settled bed")
    arguments.add_argument("--out", type=Path, required=True, help="folder for the runs")
    arguments.add_argument("--lmp", default="lmp", help="LAMMPS (default: the one of the package)")
    arguments.add_argument("--liggghts", default="liggghts")
    arguments.add_argument("--runs", type=int, default=5, help="runs of the bed (default 5); three times as many of the agitated scene")
    arguments.add_argument("--core", type=int, default=max(os.sched_getaffinity(0)), help="the core all run on (default: the last)")
    arguments.add_argument("--json", type=Path, help="write {scene, program, particle_steps_per_second, ratio} there")
    arguments.add_argument("--readme", type=Path, help="rewrite the table there")
    arguments.add_argument("--head", type=Path, help="write this machine's row of the table of processors there")
    chosen = arguments.parse_args()
    if chosen.runs < 1:
        arguments.error("--runs: one or more")
    part = MarkedPart(chosen.readme, "peers") if chosen.readme else None
    expected = KeptTable(chosen.head, "processors", rates.EXPECTED, 2) if chosen.head else None

    fixdem = Fixdem(chosen.programs, chosen.core, chosen.out / "fixdem")
    commands = {"lammps": found(chosen.lmp), "liggghts": found(chosen.liggghts)}
    versions = {name: version_of(command) for name, command in commands.items()}
    peers = [Peer(name, command, chosen.core, chosen.out / name) for name, command in commands.items()]
    wrong, rows = compare_laws(fixdem, peers, chosen.headers), []
    for scene in scenes_of(fixdem, chosen.headers, chosen.settled):
        scene_rows, scene_wrong = compare_scene(scene, fixdem, peers, chosen.runs)
        rows += scene_rows
        wrong += scene_wrong

    origin = "the Debian package" if chosen.lmp == "lmp" else "a build of its own"
    text = (
        f"Machine: {rates.machine()}. LAMMPS {versions['lammps']} ({origin}), LIGGGHTS {versions['liggghts']}. "
        "Regenerated by `make bench-peers`.\n\n" + rates.table(rows)
    )
    print("\n" + text)
    if wrong:
        raise SystemExit(f"bench-peers: {wrong} of the comparisons disagree (see DISAGREES above): the speeds mean nothing")
    print("\nall comparisons of law and result agree within their bounds")
    if chosen.json:
        rates.write_json(chosen.json, rows)
    if part:
        part.write(text)
    if expected:
        expected.put([rates.expected_row(rows)])


if __name__ == "__main__":
    main()
