"""Runs one program once, pinned to one core, and says how long its time steps took and which state they led to.

Time is processor time. Of a peer: what the operating system had counted for it before and after the timed part, written
by the peer itself (peer_inputs.py). Of fixdem: that of the whole program, less that of the same program asked for no
steps, which leaves a few outputs in. So work of others on the machine changes a figure only through caches and clock.
"""

import os
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path

from peer_inputs import data_file, script
from states import State, read_dump, read_final


@dataclass(frozen=True)
class Run:
    seconds: float  # processor time of the timed steps
    state: State  # at the end


def pinned(core, command, folder):
    """Runs to the end on one core, in this folder; returns its processor time in s."""
    log = folder / "output.txt"
    command = ["taskset", "-c", str(core), *map(str, command)]
    environment = {**os.environ, "OMP_NUM_THREADS": "1"}
    with open(log, "wb") as output:
        process = subprocess.Popen(command, cwd=folder, env=environment, stdin=subprocess.DEVNULL, stdout=output, stderr=subprocess.STDOUT)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        said = "\n".join(log.read_text(errors="replace").splitlines()[-8:])
        raise SystemExit(f"{' '.join(command)} in {folder}: exit code {process.returncode}\n{said}")
    return usage.ru_utime + usage.ru_stime


def counted_seconds(file):
    """Processor time from what was /proc/PID/schedstat: the first number, in ns."""
    try:
        return int(Path(file).read_text().split()[0]) * 1e-9
    except (OSError, ValueError, IndexError):
        raise SystemExit(f"{file}: no processor time in it; the system must have /proc/PID/schedstat (Linux)") from None


class Peer:
    """LAMMPS or LIGGGHTS."""

    def __init__(self, program, command, core, folder):
        self.name, self.command, self.core, self.folder = program, command, core, Path(folder)

    def run(self, case, law, start, stretch, skin):
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir(parents=True)
        (self.folder / "data").write_text(data_file(case, start))
        (self.folder / "in").write_text(script(self.name, case, law, stretch, skin))
        pinned(self.core, [self.command, "-in", "in", "-log", "log"], self.folder)
        seconds = counted_seconds(self.folder / "after") - counted_seconds(self.folder / "before")
        return Run(seconds, read_dump(self.folder / "dump"))


class Fixdem:
    """The program of one of the derived cases."""

    name = "fixdem"

    def __init__(self, programs, core, folder):
        self.programs, self.core, self.folder = Path(programs).resolve(), core, Path(folder).resolve()

    def out(self, case_name):
        return self.folder / case_name

    def final(self, case_name):
        return self.out(case_name) / "final.fixdem"

    def run(self, case_name, steps, time_step, start_state=None):
        """A run of so many steps; the state is that of the end."""
        options = ["--out", self.out(case_name), "--quiet", "--no-frames", "--replace", "--drop-checkpoint"]
        if start_state:
            options += ["--start-state", Path(start_state).resolve()]
        self.folder.mkdir(parents=True, exist_ok=True)

        def of_duration(duration):
            return pinned(self.core, [self.programs / case_name, *options, "--duration", repr(duration)], self.folder)

        idle = of_duration(0.0)
        whole = of_duration(steps * time_step)
        return Run(whole - idle, read_final(self.final(case_name)))
