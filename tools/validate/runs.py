"""Runs that the validation needs, and what is kept of them in cases/validation/results.json.

A run is a shipped case, with other values of some keys where a row asks what they change, from a seed of its start. It is made once
(tools/report/kept_run.py); what is kept of it is bound to the case as it is read, to its start, and to the pinned state of the case
(tests/golden/states.txt), which says that the kernel still computes the same bits. Where one of them differs the run is made again. So
a page of many hours of runs outlives changes that leave results alone, and none that does not.
"""

import fcntl
import hashlib
import json
import os
import subprocess
import sys
import threading
import tomllib
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path

root = Path(__file__).parent.parent
for part in ("report", "peers", "picture", "figures", "python", "validate"):
    sys.path.insert(0, str(root / part))
from derived_cases import with_value
from extract import figures_of
from kept_run import KeptRun, write_whole
from report import machine

OUTPUTS = ("log_interval", "frame_interval", "contact_interval", "checkpoint_interval", "frame_data", "dump")  # change no figure


@dataclass(frozen=True)
class Run:
    """`label` names what `keys` change: (table, key, TOML text of the value)."""

    base: str
    label: str = ""
    keys: tuple = ()
    seed: int = 1
    start: "Run | None" = None
    frames: bool = False

    @property
    def case(self):
        return f"{self.base}-{self.label}" if self.label else self.base

    @property
    def name(self):
        return f"{self.case}-seed{self.seed}"


@dataclass
class Places:
    """Folders: shipped cases, all that is built, runs; and the command make."""

    cases: Path
    build: Path
    out: Path
    make: list
    jobs: int = 2

    def text(self, run):
        """Of the case file of a run."""
        text = (self.cases / f"{run.base}.toml").read_text()
        for table, key, value in run.keys:
            text = with_value(text, table, key, value)
        if run.label and run.start:
            text = with_value(text, "start", "from", json.dumps(os.path.relpath(self.file(run.start), self.out / "cases")[: -len(".toml")]))
        return text

    def file(self, run):
        return self.out / "cases" / f"{run.case}.toml" if run.label else self.cases / f"{run.base}.toml"

    def program(self, run):
        return self.build / "validate" / "bin" / run.case if run.label else self.build / "bin" / run.base

    def folder(self, run):
        return self.out / "runs" / run.name

    def pinned(self, run):
        """The lines of the pinned states that are about the case."""
        lines = (self.cases.parent / "tests" / "golden" / "states.txt").read_text().splitlines()
        return [line for line in lines if line.split(" ")[0] == run.base]

    def identity(self, run):
        case = tomllib.loads(self.text(run))
        case.pop("title", None)
        case["run"].pop("reference_speed", None)
        for key in OUTPUTS:
            case.get("output", {}).pop(key, None)
        case["start"].pop("from", None)
        parts = [case, run.seed, self.identity(run.start) if run.start else None, self.pinned(run)]
        return hashlib.sha256(json.dumps(parts, sort_keys=True).encode()).hexdigest()[:16]


@dataclass
class Results:
    """name of a run -> what is kept of it. Those of another case or kernel than now count as not there."""

    path: Path
    places: Places
    kept: dict = field(default_factory=dict)
    lock: threading.Lock = field(default_factory=threading.Lock)

    def __post_init__(self):
        self.read()

    def read(self):
        if self.path.exists():
            try:
                self.kept = json.loads(self.path.read_text())
            except ValueError as error:
                raise SystemExit(f"{self.path}: {error}: restore it, or delete it to make all runs again") from None

    def of(self, run):
        """Its figures, and `run`, its name; None where they are not known."""
        entry = self.kept.get(run.name)
        return entry["figures"] | {"run": run.name} if entry and entry["identity"] == self.places.identity(run) else None

    def put(self, run, figures):
        with self.lock, self.path.with_suffix(".lock").open("w") as alone:
            fcntl.flock(alone, fcntl.LOCK_EX)  # others may be making runs for the same page
            self.read()
            self.kept[run.name] = {"identity": self.places.identity(run), "figures": figures}
            rows = [f"{json.dumps(name)}: {json.dumps(self.kept[name], sort_keys=True)}" for name in sorted(self.kept)]
            write_whole(self.path, "{\n" + ",\n".join(rows) + "\n}\n")

    def make(self, runs):
        """Those that are not known, fills first."""
        missing = [run for run in dict.fromkeys(runs) if self.of(run) is None]
        if not missing:
            return
        starts = [run.start for run in missing if run.start]
        self.build([*missing, *starts])
        with ThreadPoolExecutor(self.places.jobs) as pool:
            list(pool.map(self.start_state, dict.fromkeys(starts)))
            list(pool.map(self.make_one, missing))

    def build(self, runs):
        """Case files of those with keys of their own, and all programs."""
        for run in dict.fromkeys(runs):
            file = self.places.file(run)
            if run.label and not (file.exists() and file.read_text() == self.places.text(run)):
                write_whole(file, self.places.text(run))
        programs = sorted({str(self.places.program(run)) for run in runs})
        subprocess.run([*self.places.make, *programs], check=True)

    def kept_run(self, run):
        options = () if run.frames else ("--no-frames",)
        if "seed" in tomllib.loads(self.places.text(run))["start"]:
            options = ("--seed", str(run.seed), *options)
        return KeptRun(self.places.folder(run), self.places.program(run), options, self.start_state(run.start) if run.start else None)

    def start_state(self, run):
        """The final state of a run, which is made when it is not there."""
        self.kept_run(run).made()
        return self.places.folder(run) / "final.fixdem"

    def make_one(self, run):
        kept = self.kept_run(run)
        print(f"{run.name}: runs", flush=True)
        record = kept.complete()
        if record["state"] not in ("done", "failed"):
            raise SystemExit(f"{kept.program}, results in {kept.folder}: exit code {record['exit_code']}\n{record['message']}")
        figures = figures_of(kept.folder, tomllib.loads(self.places.text(run)))
        self.put(run, figures | {"machine": machine(), "state": record["state"]})
        print(f"{run.name}: done", flush=True)
