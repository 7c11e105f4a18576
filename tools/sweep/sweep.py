#!/usr/bin/env python3
"""Many runs of one case with values that vary: make sweep.

Reads the sweep file, derives the cases, has them checked by casegen and compiled by make, starts the runs that are missing
through an engine, and collects all of them (tools/sweep/README.md). Called again, it makes only what is missing.

Exit codes: 0 every point is done, 1 some points failed or are missing, 2 wrong usage, 3 a sweep file or case that makes no
sense, 6 a file that cannot be read or written, 130 stopped by Ctrl-C.
"""

import argparse
import contextlib
import fcntl
import json
import os
import shlex
import signal
import socket
import subprocess
import sys
import time
from pathlib import Path

sys.dont_write_bytecode = True
from collect import page, points_of, write_points, write_speed  # noqa: E402
from engines import Parallel, Slurm  # noqa: E402
from job import run_of  # noqa: E402
from kept_run import write_whole  # noqa: E402
from pictures import draw  # noqa: E402
from plan_files import job_list, write_cases  # noqa: E402
from points import RUN_TIME, plan_of  # noqa: E402
from sweep_file import Refused, read_sweep  # noqa: E402


def say(text):
    print(f"fixdem: {text}", flush=True)


def missing(out, jobs):
    """Numbers of the runs that are not over, one list per stage. What starts from a missing one is missing, too."""
    stages = [[] for _ in range(1 + max(job["stage"] for job in jobs))]
    absent = set()
    for number, job in enumerate(jobs, 1):
        run = run_of(out, job)
        if job["start"] in absent or not run.is_over(run.read()):
            stages[job["stage"]].append(number)
            absent.add(job["name"])
    return stages


def run_missing(out, jobs, engine, rounds):
    """Particle-steps and seconds of what was run now, and how many runs that was."""
    begin, worked, touched = time.monotonic(), 0.0, set()
    records = {job["name"]: run_of(out, job) for job in jobs}
    before = {name: run.read() for name, run in records.items()}
    stopped = None
    for _ in range(rounds):
        stages = missing(out, jobs)
        if not any(stages):
            break
        try:
            engine.run(stages)
        except KeyboardInterrupt as interrupt:
            stopped = interrupt
        for name, run in records.items():
            record = run.read()
            if record.get("owner") != before[name].get("owner") and record.get("state") != "running":
                worked += record.get("particle_steps", 0.0)
                before[name] = record
                touched.add(name)
        if stopped:
            break
    return {"runs": len(touched), "seconds": time.monotonic() - begin, "particle_steps": worked}, stopped


@contextlib.contextmanager
def alone_in(out):
    """One sweep at a time in a folder. The lock is the operating system's and ends with the process, however that ends."""
    with (out / "sweep.lock").open("a+") as lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            lock.seek(0)
            raise Refused(f"{out}: a sweep is under way there ({lock.read().strip()}); wait for it, or choose another OUT", 6) from None
        lock.truncate(0)
        lock.write(f"process {os.getpid()} on {socket.gethostname()}\n")
        lock.flush()
        yield


def make_sweep(chosen):
    sweep = read_sweep(chosen.sweep, chosen.cases)
    plan = plan_of(sweep)
    out = chosen.out.resolve()
    out.mkdir(parents=True, exist_ok=True)
    with alone_in(out):
        return make_alone(chosen, sweep, plan, out)


def make_alone(chosen, sweep, plan, out):
    write_cases(plan, out / "cases", chosen.casegen)
    jobs = job_list(sweep, plan, chosen.programs.resolve())
    write_whole(out / "jobs.jsonl", "".join(json.dumps(job) + "\n" for job in jobs))
    say(
        f"{sweep.title}: {len(plan.points)} points, {len(plan.cases)} programs, "
        f"{len(jobs)} runs in {1 + max(j['stage'] for j in jobs)} stage(s)"
    )
    say(f"run-time values, options of a program: {', '.join('.'.join(key) for key in RUN_TIME)}; all others are compiled in")
    if subprocess.run([*shlex.split(chosen.make), "build-sweep"], check=False).returncode != 0:
        raise Refused("the programs of the sweep cannot be built (see above)", 1)

    count = sum(map(len, missing(out, jobs)))
    say(f"{len(jobs) - count} of {len(jobs)} runs are there, {count} are missing; results in {chosen.out}")
    engine = (
        Slurm(out, chosen.jobs)
        if chosen.engine == "slurm"
        else Parallel(out, chosen.jobs, chosen.hosts, *([chosen.ssh] if chosen.ssh else []))
    )
    stopped, speed_file = None, out / "sweep.json"
    if count:
        entry, stopped = run_missing(out, jobs, engine, engine.ROUNDS)
        entry |= {
            "particle_steps_per_second": entry["particle_steps"] / entry["seconds"],
            "engine": chosen.engine,
            "jobs": chosen.jobs or os.cpu_count(),
            "hosts": str(chosen.hosts) if chosen.hosts else None,
        }
        write_speed(speed_file, entry)
        say(
            f"{entry['runs']} runs in {entry['seconds']:.1f} s, "
            f"{1e-6 * entry['particle_steps_per_second']:.3g} million particle-steps/s together"
        )
    return collect(sweep, plan, out, jobs, speed_file, stopped)


def collect(sweep, plan, out, jobs, speed_file, stopped):
    points = points_of(plan, out, jobs)
    write_points(out / "points.csv", sweep.axes, points)
    pictures = draw(sweep, points, out)
    entries = json.loads(speed_file.read_text()) if speed_file.exists() else []
    write_whole(out / "sweep.md", page(sweep, points, pictures, entries))
    bad = [point for point in points if not point.summary]
    failed = sum(point.state == "failed" for point in bad)
    for point in bad[:20]:
        print(f"fixdem: {point.name}: {point.state}: {point.record.get('message', 'not run')}", file=sys.stderr)
    say(
        f"{len(points) - len(bad)} points done, {failed} failed, {len(bad) - failed} missing: "
        f"{out}/points.csv, sweep.md, sweep.json"
    )
    if stopped:
        say("stopped; the same command goes on from the checkpoints")
        return 130
    return 1 if bad else 0


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("sweep", type=Path, help="the sweep file")
    arguments.add_argument("--out", type=Path, required=True, help="folder of everything that the sweep makes")
    arguments.add_argument("--cases", type=Path, default=Path("cases"), help="folder of the base cases")
    arguments.add_argument("--casegen", type=Path, required=True)
    arguments.add_argument("--programs", type=Path, required=True, help="folder of the programs that --make builds")
    arguments.add_argument("--make", required=True, help="command whose target build-sweep compiles OUT/cases/*.toml")
    arguments.add_argument("--engine", choices=("parallel", "slurm"), default="parallel")
    arguments.add_argument(
        "--jobs", type=int, help="runs at a time, on each host; default: one per core; with Slurm as many as it likes"
    )
    arguments.add_argument("--hosts", type=Path, help="GNU parallel's --sshloginfile; the hosts share this folder")
    arguments.add_argument("--ssh", help="another command in place of ssh and its options")
    chosen = arguments.parse_args()
    if chosen.hosts and chosen.engine != "parallel":
        arguments.error("--hosts: only with the engine parallel; Slurm knows its nodes")
    if chosen.jobs is not None and chosen.jobs < 1:
        arguments.error("--jobs: a number of runs at a time, one or more, is needed")
    if chosen.hosts and not chosen.hosts.is_file():
        print(
            f"fixdem: {chosen.hosts}: no such file; HOSTS is a list of hosts, one per line (GNU parallel's --sshloginfile)",
            file=sys.stderr,
        )
        return 6
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        return make_sweep(chosen)
    except Refused as refused:
        print(f"fixdem: {refused}", file=sys.stderr)
        return refused.code
    except OSError as error:
        print(f"fixdem: {error}", file=sys.stderr)
        return 6
    except KeyboardInterrupt:
        return 130


if __name__ == "__main__":
    sys.exit(main())
