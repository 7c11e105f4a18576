#!/usr/bin/env python3
"""Kills runs and resumes them until they are done: the files must then be those of a run that nothing has happened to.

Everywhere: each operation on the disk that a short run makes is crashed in (tools/run/disk.hpp), cut short, made to fail,
or finds the disk full from there on; every run is then resumed to its end. At random: runs are ended by
SIGKILL, by signals that ask to stop (once, or twice within a millisecond, as make does), or by such a fault, at random
moments, and resumed, again and again until they are done; half of them are brought to an earlier end first and extended from
there. At the end all files must be equal byte for byte to those of a run of that length, but for `performance` in
summary.json, the one place for figures of the clock, and the checkpoint of the end, which has them too and what no step reads;
it must be there, and nothing else may lie in the folder.

Usage: tests/kill_test.py PROGRAMS SCRATCH [--count FILE] [--kills N | --time SECONDS] [--starts RESULTS] [--seed N]
PROGRAMS: folder of the cases' programs. --time: the long form (`make soak`): runs also larger cases, those that start from
another case from its state in RESULTS. Writes "PASSED FAILED" to FILE; prints the figures. Exit code: 0 when all passed.
"""

import argparse
import json
import math
import os
import random
import resource
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

STOPPING = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGXCPU)


class Wrong(Exception):
    """A promise that was not kept."""


class Scene:
    """A program with the arguments of one run; `out` is the folder that is attacked, `whole` holds the bytes that are right."""

    def __init__(self, programs, scratch, name, arguments, everywhere=False):
        self.program, self.name, self.everywhere = programs / name, name, everywhere
        self.arguments = arguments.split()
        self.out = scratch / name
        shutil.rmtree(self.out, ignore_errors=True)
        begin = time.monotonic()
        done = self.start().wait()
        self.seconds = time.monotonic() - begin
        if done != 0:
            raise Wrong(f"{name}: an undisturbed run ends with {done}: {self.error()}")
        self.whole = self.files()

    def start(self, fault=None, resume=False, duration=None):
        """`duration`: another than that of the whole run."""
        arguments = list(self.arguments)
        if duration is not None:
            arguments += ["--duration", str(duration)]
            if "--duration" in self.arguments:
                del arguments[(at := arguments.index("--duration")) : at + 2]
        environment = {**os.environ, **({"FIXDEM_DISK_FAULT": fault} if fault else {})}
        self.out.parent.mkdir(parents=True, exist_ok=True)
        with open(f"{self.out}.stderr", "w", encoding="utf-8") as error:
            return subprocess.Popen(
                [self.program, "--out", self.out, "--quiet", *arguments, *(["--resume"] if resume else [])],
                env=environment, stdout=subprocess.DEVNULL, stderr=error,
                preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_DFL))  # nohup may have started the tests

    def error(self):
        return Path(f"{self.out}.stderr").read_text(encoding="utf-8")

    def files(self):
        """Bytes of every file, the figures of the clock left out."""
        found = {str(p.relative_to(self.out)): p.read_bytes() for p in self.out.rglob("*") if p.is_file()}
        summary = json.loads(found["summary.json"])
        del summary["performance"]
        found["summary.json"] = json.dumps(summary)
        return {name: b"" if name.startswith("checkpoint-") else bytes for name, bytes in found.items()}

    def last_duration(self):
        """That of the whole run."""
        if "--duration" in self.arguments:
            return float(self.arguments[self.arguments.index("--duration") + 1])
        return json.loads(self.whole["summary.json"])["duration"]

    def compare(self, history):
        found = self.files()
        unequal = sorted(name for name in found.keys() | self.whole.keys() if found.get(name) != self.whole.get(name))
        if unequal:
            raise Wrong(f"{self.name}: {', '.join(unequal)} differ(s) after {history}; see {self.out}")


def attack_everywhere(scene, figures):
    """Every operation of a run, in every way."""
    expected = {"crash": -signal.SIGKILL, "short": 0, "error": 6, "full": 6}
    for kind, right in expected.items():
        number = 0
        while kind != "short" or number < figures["operations"]:
            number += 1
            fault = f"{kind}@{number}"
            shutil.rmtree(scene.out, ignore_errors=True)
            code = scene.start(fault).wait()
            if code == 0 and kind != "short":
                figures["operations"] = number - 1
                break
            if code != right:
                raise Wrong(f"{scene.name}: {fault}: exit code {code}, expected {right}: {scene.error()}")
            if code == 6 and "cannot " not in scene.error():
                raise Wrong(f"{scene.name}: {fault}: no message: {scene.error()}")
            if code != 0:
                code = scene.start(resume=True).wait()
                if code != 0:
                    raise Wrong(f"{scene.name}: {fault}: not resumed: exit code {code}: {scene.error()}")
            scene.compare(fault)
            figures["faults"] += 1


def attack_extension(scene, figures, first):
    """Every operation of the extension of a finished run: whatever it dies in, a longer one comes out."""
    for number in range(1, 1000):
        shutil.rmtree(scene.out, ignore_errors=True)
        if scene.start(duration=first).wait() != 0:
            raise Wrong(f"{scene.name}: {scene.error()}")
        code = scene.start(f"crash@{number}", resume=True).wait()
        if code not in (0, -signal.SIGKILL):
            raise Wrong(f"{scene.name}: extended with crash@{number}: exit code {code}: {scene.error()}")
        if code != 0 and scene.start(resume=True).wait() != 0:
            raise Wrong(f"{scene.name}: not resumed after crash@{number} in an extension: {scene.error()}")
        scene.compare(f"crash@{number} in an extension")
        figures["faults"] += 1
        if code == 0:
            return


def attack_at_random(scene, figures, chance, is_over):
    """Ends a run at random moments and resumes it until it is done; then its files must be right."""
    history, resume = [], False
    ends = [scene.last_duration()]
    if chance.random() < 0.5:
        ends.insert(0, ends[0] * chance.uniform(0.1, 0.9))
        history.append(f"a first end at {ends[0]!r} s")
    shutil.rmtree(scene.out, ignore_errors=True)
    while not is_over():
        fault, way, delay = None, None, chance.uniform(0, 0.6 * scene.seconds)
        dice = chance.random()
        if dice < 0.15:
            fault = f"{chance.choice(('crash', 'crashed', 'error', 'full', 'short'))}@{chance.randint(1, 60)}"
        else:
            way = signal.SIGKILL if dice < 0.85 else chance.choice(STOPPING)
        history.append(fault or f"{way.name} after {1e3 * delay:.1f} ms")
        run = scene.start(fault, resume, ends[0])
        if way is not None:
            time.sleep(delay)
            for _ in range(chance.choice((1, 2)) if way in STOPPING else 1):
                run.send_signal(way)
        code = run.wait()
        resume = True
        figures["attempts"] += 1
        if code == 0 and len(ends) == 1:
            break
        if code == 0:
            del ends[0]
            figures["extended"] += 1
        elif code == -signal.SIGKILL:
            figures["crashes" if fault else "kills"] += 1
        elif code == 6 and fault:
            figures["faults"] += 1
        elif way is not None and code == 128 + way:
            figures["stops"] += 1
        elif way is not None and code == -way:
            figures["stops early"] += 1  # before the program had begun to listen
        else:
            raise Wrong(f"{scene.name}: exit code {code} after {', '.join(history)}: {scene.error()}")
    if is_over():
        code = scene.start(resume=resume, duration=ends[-1]).wait()
        if code != 0:
            raise Wrong(f"{scene.name}: exit code {code} at the end, after {', '.join(history)}: {scene.error()}")
    scene.compare(", ".join(history))
    figures["runs"] += 1


def print_cost(scene):
    """Size of a checkpoint, and how long one takes with all its flushing: run time with and without them, least of five."""
    duration, interval = (float(scene.arguments[scene.arguments.index(name) + 1])
                          for name in ("--duration", "--checkpoint-interval"))
    usual, least = list(scene.arguments), {}
    for chosen in 5 * (str(interval), "inf"):
        scene.arguments[scene.arguments.index("--checkpoint-interval") + 1] = chosen
        begin = time.monotonic()
        scene.start().wait()
        least[chosen] = min(least.get(chosen, 1e9), time.monotonic() - begin)
    scene.arguments = usual
    scene.start("crash@40").wait()
    size = max(p.stat().st_size for p in scene.out.glob("checkpoint-*.fixdem"))
    count = math.ceil(duration / interval) - 1
    print(f"a checkpoint of {scene.name}: {size / 1024:.0f} KiB, {1e3 * (least[str(interval)] - least['inf']) / count:.0f} ms")


def scenes_of(options):
    small = [("settle", "--duration 0.012 --checkpoint-interval 0.0008"),
             ("collide_pair", "--duration 0.0102 --checkpoint-interval 0.00334"),
             ("drag_single", "--duration 0.05 --checkpoint-interval 0.004")]
    if options.time is None:
        return [Scene(options.programs, options.scratch, *scene) for scene in small]
    large = [("settle_mixed", "--duration 0.04 --checkpoint-interval 0.002"),
             ("pipe_bed", "--duration 0.02 --checkpoint-interval 0.001"),
             ("oblique_wall", "--checkpoint-interval 0.00102")]
    start = options.starts / "fill_500" / "final.fixdem"
    large.append(("plug_u24_n500", f"--duration 0.05 --checkpoint-interval 0.0033 --start-state {start}"))
    return [Scene(options.programs, options.scratch, *scene) for scene in small + large]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("programs", type=Path)
    parser.add_argument("scratch", type=Path)
    parser.add_argument("--count", type=Path)
    parser.add_argument("--kills", type=int, default=100, help="by SIGKILL at random moments")
    parser.add_argument("--time", type=float, help="s")
    parser.add_argument("--starts", type=Path)
    parser.add_argument("--seed", type=int, default=int(os.environ.get("FIXDEM_SEED", "1")))
    options = parser.parse_args()

    signal.signal(signal.SIGINT, signal.SIG_DFL)  # a test in the background must not pass on that it ignores it
    begin = time.monotonic()
    chance = random.Random(options.seed)
    figures = dict.fromkeys(("attempts", "extended", "kills", "crashes", "faults", "stops", "stops early", "runs", "operations"), 0)
    failed = 0
    try:
        attack_everywhere(Scene(options.programs, options.scratch, "settle",
                                "--duration 0.0051 --checkpoint-interval 0.0024"), figures)
        attack_extension(Scene(options.programs, options.scratch, "settle", "--duration 0.0051 --checkpoint-interval 0.0024"),
                         figures, 0.0031)
        everywhere, figures["faults"] = figures["faults"], 0
        scenes = scenes_of(options)
        if options.time is None:
            is_over = lambda: figures["kills"] >= options.kills  # noqa: E731
        else:
            is_over = lambda: time.monotonic() - begin >= options.time  # noqa: E731
        if options.time is not None:
            print_cost(scenes[0])
            print_cost(scenes[-1])
        while not is_over():
            for scene in scenes:
                if not is_over():
                    attack_at_random(scene, figures, chance, is_over)
        cpu = resource.getrusage(resource.RUSAGE_CHILDREN)
        print(f"{everywhere} faults at each of {figures['operations']} operations of a run; at random: {figures['kills']} kills, "
              f"{figures['crashes']} crashes in writing, {figures['faults']} failed writes, {figures['stops']} signals to stop, {figures['extended']} extended, "
              f"{figures['runs']} runs resumed to the same bytes; seed {options.seed}, "
              f"{time.monotonic() - begin:.0f} s, {cpu.ru_utime + cpu.ru_stime:.1f} s of processor time")
    except Wrong as wrong:
        failed = 1
        print(f"tests/kill_test.py: {wrong}\n  again: FIXDEM_SEED={options.seed} {' '.join(sys.argv)}")
    if options.count:
        options.count.write_text(f"{1 - failed} {failed}\n", encoding="utf-8")
    return failed


if __name__ == "__main__":
    sys.exit(main())
