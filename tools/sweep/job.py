#!/usr/bin/env python3
"""Makes run number N of a sweep, unless it has been made: what an engine starts, on whichever machine.

OUT/jobs.jsonl has one run per line, counted from 1. Results go to OUT/runs/NAME, the record of how it stands to
OUT/runs/NAME.json (tools/report/kept_run.py). Only python3's standard library is needed here.

Usage: tools/sweep/job.py OUT N     Exit code: 0 when it is over, done or failed for good (the record says which); 75 when it
has been stopped and should be started again, here or elsewhere; 2 and 6 wrong usage and no such list.
"""

import json
import signal
import sys
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "report"))
from kept_run import KeptRun  # noqa: E402

AGAIN = 75  # EX_TEMPFAIL


class Stopped(BaseException):
    pass


def read_jobs(out):
    return [json.loads(line) for line in (Path(out) / "jobs.jsonl").read_text().splitlines()]


def run_of(out, job):
    """The run of a job of the list."""
    runs = Path(out) / "runs"
    start = runs / job["start"] / "final.fixdem" if job["start"] else None
    return KeptRun(runs / job["name"], Path(job["program"]), tuple(job["options"]), start, tuple(job["harmless"]))


def complete(out, jobs, number):
    """Makes the run; returns its record."""
    job = jobs[number - 1]
    run = run_of(out, job)
    if job["start"]:
        before = run_of(out, next(other for other in jobs if other["name"] == job["start"]))
        record = before.read()
        if record.get("state") == "failed":
            run.fail(f"starts from {job['start']}, which failed: {record['message']}")
        elif not before.is_over(record):
            return {"state": "stopped", "message": f"starts from {job['start']}, which is not done"}
    return run.complete()


def stop(number, _):
    signal.signal(number, signal.SIG_IGN)
    raise Stopped(128 + number)


def main():
    if len(sys.argv) != 3 or not sys.argv[2].isdigit():
        print(__doc__.split("Usage: ")[1], file=sys.stderr)
        return 2
    out, number = sys.argv[1], int(sys.argv[2])
    for name in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(name, stop)
    try:
        jobs = read_jobs(out)
    except OSError as error:
        print(f"fixdem: {error.filename}: {error.strerror}", file=sys.stderr)
        return 6
    if not 1 <= number <= len(jobs):
        print(f"fixdem: there is no run {number} in {out}/jobs.jsonl; allowed: 1 to {len(jobs)}", file=sys.stderr)
        return 2
    name = jobs[number - 1]["name"]
    try:
        record = complete(out, jobs, number)
    except Stopped as stopped:
        print(f"{name}: stopped", file=sys.stderr)
        return stopped.args[0]
    if record["state"] == "done":
        speed = (
            f", {1e-6 * record['particle_steps'] / record['seconds']:.3g} million particle-steps/s"
            if record["particle_steps"]
            else ""
        )
        print(f"{name}: done in {record['seconds']:.1f} s{speed}", flush=True)
    else:
        print(f"{name}: {record['state']}: {record['message']}", file=sys.stderr)
    return 0 if record["state"] in ("done", "failed") else AGAIN


if __name__ == "__main__":
    sys.exit(main())
