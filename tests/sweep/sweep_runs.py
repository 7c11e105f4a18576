"""What the tests of sweeps share: make sweep with its own folder of results, watched, disturbed and compared."""

import json
import os
import shutil
import signal
import subprocess
import time
from pathlib import Path

root = Path(__file__).resolve().parent.parent.parent
SMALL = root / "cases" / "sweeps" / "small.toml"


class SweepRuns:
    """One sweep in the folder `out`; `variables` are given to make."""

    def __init__(self, out, sweep=SMALL, variables=()):
        self.out, self.sweep, self.variables = Path(out), sweep, tuple(variables)

    def start(self, *variables):
        """make sweep in a session of its own, so that it can be stopped as by Ctrl-C."""
        command = ["make", "sweep", f"SWEEP={self.sweep}", f"OUT={self.out}", *self.variables, *variables]
        self.out.parent.mkdir(parents=True, exist_ok=True)
        with open(f"{self.out}.txt", "a") as said:
            return subprocess.Popen(command, cwd=root, stdout=said, stderr=subprocess.STDOUT, start_new_session=True)

    def call(self, *variables):
        """Exit code and all that was said."""
        Path(f"{self.out}.txt").unlink(missing_ok=True)
        return self.start(*variables).wait(), self.said()

    def said(self):
        return Path(f"{self.out}.txt").read_text()

    def begin_anew(self):
        """Cases and programs stay."""
        shutil.rmtree(self.out / "runs", ignore_errors=True)
        (self.out / "sweep.json").unlink(missing_ok=True)

    def records(self):
        found = {}
        for path in (self.out / "runs").glob("[!.]*.json"):
            found[path.stem] = json.loads(path.read_text())
        return found

    def running(self, prefix=""):
        """(name, machine, process) of runs that have written a checkpoint and go on."""
        found = []
        for name, record in self.records().items():
            if record["state"] == "running" and name.startswith(prefix) and any((self.out / "runs" / name).glob("checkpoint-*")):
                machine, process, _ = record["owner"].split()
                found.append((name, machine, int(process)))
        return found

    def results(self):
        """Bytes of every file of every run, figures of the clock left out."""
        found = {}
        for path in sorted((self.out / "runs").glob("*/*")):
            content = path.read_bytes()
            if path.name == "summary.json":
                summary = json.loads(content)
                del summary["performance"]
                content = json.dumps(summary).encode()
            found[str(path.relative_to(self.out))] = content
        return found


def wait_for(found, seconds=120):
    """What `found()` returns once that is something; AssertionError when it takes too long."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        what = found()
        if what:
            return what
        time.sleep(0.02)
    raise AssertionError(f"waited {seconds} s in vain")


def interrupt(process):
    """Ctrl-C: SIGINT for all that were started together."""
    os.killpg(process.pid, signal.SIGINT)
    return process.wait()


def different(found, expected):
    return sorted(name for name in found.keys() | expected.keys() if found.get(name) != expected.get(name))


def kill_tree(process):
    """SIGKILL for a process and all that it has started, those first that could start more."""
    children = subprocess.run(
        ["ps", "-o", "pid=", "--ppid", str(process)], capture_output=True, text=True, check=False
    ).stdout.split()
    try:
        os.kill(process, signal.SIGKILL)
    except ProcessLookupError:
        pass
    for child in children:
        kill_tree(int(child))
